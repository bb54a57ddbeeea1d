use super::check::kind_and_name;
use super::check::{number, reflectance, triple};
use crate::plan::{Census, Table};
use crate::scene::{BlinnPhong, Phong, Rgb, SceneError};
use bevy_ecs::prelude::*;

/// The largest exponent: its highlight falls to half within 0.002°.
const LARGEST_EXPONENT: f64 = 1e9;

/// Highlights about the mirrored light, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PhongTable {
    /// The largest share of the light that each sends on: red, green, blue, from 0 to 1.
    pub specular: Vec<[f64; 3]>,
    /// How narrow each is.
    pub exponent: Vec<f64>,
    /// What each has at its middle, by [`phong_peak`].
    pub peak: Vec<f64>,
}

// ANCHOR: phong_peak
/// The factor N = (n + 2) / 2π of N cosⁿα, in 1/sr.
///
/// Light that falls squarely has its mirror direction along the normal, α is the angle to the normal too, and
/// ∫ N cosⁿα cos α dω over the hemisphere is 2πN / (n + 2) = 1: nothing is lost and nothing is gained.
/// The more slantingly it falls, the more of the lobe lies below the surface, so the sum is less there.
pub fn phong_peak(exponent: f64) -> f64 {
    (exponent + 2.0) / std::f64::consts::TAU
}
// ANCHOR_END: phong_peak

impl Table for PhongTable {
    const NAME: &'static str = "phong highlights";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let mut table = Self::default();
        for &entity in scene.entities::<With<Phong>>().iter() {
            let phong = scene.get::<Phong>(entity).copied().unwrap_or_default();
            let who = kind_and_name(scene, "phong", entity);
            table.specular.push(shared_light(&who, phong.colour, phong.specular)?[1]);
            table.exponent.push(exponent_within(&who, phong.exponent)?);
            table.peak.push(phong_peak(phong.exponent));
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.exponent.len() * size_of::<[f64; 5]>()
    }
}

/// The colour of a Phong material, all of whose numbers are checked.
pub(super) fn phong_colour(scene: &Census<'_>, entity: Entity, who: &str) -> Result<[f64; 3], SceneError> {
    let phong = scene.get::<Phong>(entity).copied().unwrap_or_default();
    exponent_within(who, phong.exponent)?;
    Ok(shared_light(who, phong.colour, phong.specular)?[0])
}

/// An exponent that a highlight may have.
pub(super) fn exponent_within(who: &str, exponent: f64) -> Result<f64, SceneError> {
    if (0.0..=LARGEST_EXPONENT).contains(&exponent) {
        Ok(exponent)
    } else {
        let accepted = format!("it must be a number from 0 to {LARGEST_EXPONENT:e}");
        Err(SceneError::new(who, "exponent", number(exponent), accepted))
    }
}

/// Checks that a texture leaves room for the highlight of the material that it colours; `largest` is the largest that each
/// part of its colour comes to.
pub(super) fn beside_highlight(
    scene: &Census<'_>,
    material: Entity,
    (who, field, value): (&str, &'static str, String),
    largest: Rgb,
) -> Result<(), SceneError> {
    let phong = scene.get::<Phong>(material).map(|own| own.specular);
    let specular = phong.or_else(|| scene.get::<BlinnPhong>(material).map(|own| own.specular));
    let Some(specular) = specular.filter(|own| (own.to_vec() + largest.to_vec()).max_element() > 1.0) else {
        return Ok(());
    };
    let (specular, largest) = (triple(specular.to_vec()), triple(largest.to_vec()));
    let accepted = format!(
        "its parts come to {largest} and with the material's specular share {specular} must come to at most 1, for a \
         surface gives back no more than it gets"
    );
    Err(SceneError::new(who, field, value, accepted))
}

/// Colour and specular share, which may not come to more than all the light.
pub(super) fn shared_light(who: &str, colour: Rgb, specular: Rgb) -> Result<[[f64; 3]; 2], SceneError> {
    reflectance(who, "colour", colour)?;
    reflectance(who, "specular", specular)?;
    if (colour.to_vec() + specular.to_vec()).max_element() <= 1.0 {
        Ok([colour.to_array(), specular.to_array()])
    } else {
        let of_colour = triple(colour.to_vec());
        let accepted = format!(
            "with the colour {of_colour} each part must come to at most 1, for a surface gives back no more than it gets"
        );
        Err(SceneError::new(who, "specular", triple(specular.to_vec()), accepted))
    }
}
