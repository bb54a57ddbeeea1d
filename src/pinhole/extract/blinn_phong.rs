use super::check::kind_and_name;
use super::phong::{diffuse_and_specular, exponent_within};
use crate::plan::{Census, Table};
use crate::scene::{BlinnPhong, SceneError};
use bevy_ecs::prelude::*;

/// Blinn–Phong highlights, lobes about the half vector, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BlinnPhongTable {
    /// The specular albedo of each: red, green, blue, from 0 to 1.
    pub specular: Vec<[f64; 3]>,
    /// The exponent n; larger ones give a narrower lobe.
    pub exponent: Vec<f64>,
    /// The value at the centre of the lobe, by [`blinn_phong_peak`], in 1/sr.
    pub peak: Vec<f64>,
}

// ANCHOR: blinn_phong_peak
/// The factor N = (n + 2)(n + 4) / (8π(n + 2^(−n/2))) of N cosⁿβ, in 1/sr.
///
/// At normal incidence, light is reflected at twice the angle β of the half vector, so dω = 4 cos β dω_β, and ∫ N cosⁿβ
/// cos 2β dω over the hemisphere, where β ends at 45°, is exactly 1 (Giesen 2009).
/// The often quoted (n + 8) / 8π is up to 7.5 % larger.
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
            table.specular.push(diffuse_and_specular(&who, blinn.colour, blinn.specular)?[1]);
            table.exponent.push(exponent_within(&who, blinn.exponent)?);
            table.peak.push(blinn_phong_peak(blinn.exponent));
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.exponent.len() * size_of::<[f64; 5]>()
    }
}

/// The diffuse colour of a Blinn–Phong material, after checking all of its values.
pub(super) fn blinn_phong_colour(scene: &Census<'_>, entity: Entity, who: &str) -> Result<[f64; 3], SceneError> {
    let blinn = scene.get::<BlinnPhong>(entity).copied().unwrap_or_default();
    exponent_within(who, blinn.exponent)?;
    Ok(diffuse_and_specular(who, blinn.colour, blinn.specular)?[0])
}
