use super::check::kind_and_name;
use super::phong::{exponent_within, shared_light};
use crate::plan::{Census, Table};
use crate::scene::{BlinnPhong, SceneError};
use bevy_ecs::prelude::*;

/// Highlights about the direction half way between light and eye, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BlinnPhongTable {
    /// The largest share of the light that each sends on: red, green, blue, from 0 to 1.
    pub specular: Vec<[f64; 3]>,
    /// How narrow each is.
    pub exponent: Vec<f64>,
    /// What each has at its middle, by [`blinn_phong_peak`].
    pub peak: Vec<f64>,
}

// ANCHOR: blinn_phong_peak
/// The factor N = (n + 2)(n + 4) / (8π(n + 2^(−n/2))) of N cosⁿβ, in 1/sr.
///
/// Light that falls squarely leaves at twice the angle β of the half-way direction, so dω = 4 cos β dω_β, and
/// ∫ N cosⁿβ cos 2β dω over the hemisphere, where β ends at 45°, is exactly 1 (Giesen 2009).
/// The shorter (n + 8) / 8π, often read, is up to 7.5 % more than that.
pub fn blinn_phong_peak(exponent: f64) -> f64 {
    let below = 8.0 * std::f64::consts::PI * (exponent + libm::exp2(-0.5 * exponent));
    (exponent + 2.0) * (exponent + 4.0) / below
}
// ANCHOR_END: blinn_phong_peak

impl Table for BlinnPhongTable {
    const NAME: &'static str = "blinn–phong highlights";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let mut table = Self::default();
        for &entity in scene.entities::<With<BlinnPhong>>().iter() {
            let blinn = scene.get::<BlinnPhong>(entity).copied().unwrap_or_default();
            let who = kind_and_name(scene, "blinn_phong", entity);
            table.specular.push(shared_light(&who, blinn.colour, blinn.specular)?[1]);
            table.exponent.push(exponent_within(&who, blinn.exponent)?);
            table.peak.push(blinn_phong_peak(blinn.exponent));
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.exponent.len() * size_of::<[f64; 5]>()
    }
}

/// The colour of a Blinn–Phong material, all of whose numbers are checked.
pub(super) fn blinn_phong_colour(scene: &Census<'_>, entity: Entity, who: &str) -> Result<[f64; 3], SceneError> {
    let blinn = scene.get::<BlinnPhong>(entity).copied().unwrap_or_default();
    exponent_within(who, blinn.exponent)?;
    Ok(shared_light(who, blinn.colour, blinn.specular)?[0])
}
