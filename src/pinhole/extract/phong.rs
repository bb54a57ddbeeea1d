use super::check::kind_and_name;
use super::check::{number, reflectance, triple};
use crate::plan::{Census, Table};
use crate::scene::{BlinnPhong, Phong, Rgb, SceneError};
use bevy_ecs::prelude::*;

/// The largest exponent, whose highlight falls to one half within 0.002°.
const LARGEST_EXPONENT: f64 = 1e9;

/// Phong highlights, lobes about the direction of mirror reflection, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PhongTable {
    /// The specular albedo of each: red, green, blue, from 0 to 1.
    pub specular: Vec<[f64; 3]>,
    /// The exponent n; larger ones give a narrower lobe.
    pub exponent: Vec<f64>,
    /// The value at the centre of the lobe, by [`phong_peak`], in 1/sr.
    pub peak: Vec<f64>,
}

// ANCHOR: phong_peak
/// The factor N = (n + 2) / 2π of N cosⁿα, in 1/sr.
///
/// At normal incidence, the reflection is along the normal, α is also the angle to the normal, and ∫ N cosⁿα cos α dω
/// over the hemisphere is 2πN / (n + 2) = 1: the lobe has an albedo of 1.
/// At oblique incidence, a part of the lobe is below the surface, and the albedo is lower.
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
            table.specular.push(diffuse_and_specular(&who, phong.colour, phong.specular)?[1]);
            table.exponent.push(exponent_within(&who, phong.exponent)?);
            table.peak.push(phong_peak(phong.exponent));
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.exponent.len() * size_of::<[f64; 5]>()
    }
}

/// The diffuse colour of a Phong material, after checking all of its values.
pub(super) fn phong_colour(scene: &Census<'_>, entity: Entity, who: &str) -> Result<[f64; 3], SceneError> {
    let phong = scene.get::<Phong>(entity).copied().unwrap_or_default();
    exponent_within(who, phong.exponent)?;
    Ok(diffuse_and_specular(who, phong.colour, phong.specular)?[0])
}

/// Checks an exponent.
pub(super) fn exponent_within(who: &str, exponent: f64) -> Result<f64, SceneError> {
    if (0.0..=LARGEST_EXPONENT).contains(&exponent) {
        Ok(exponent)
    } else {
        let accepted = format!("it must be a number from 0 to {LARGEST_EXPONENT:e}");
        Err(SceneError::new(who, "exponent", number(exponent), accepted))
    }
}

/// Checks that a texture's colour and the specular albedo of its material add up to at most 1; `largest` is the
/// texture's maximum in each component.
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
        "its parts are at most {largest} and with the material's specular colour {specular} must add up to at most 1, for a \
         surface gives back no more than it gets"
    );
    Err(SceneError::new(who, field, value, accepted))
}

/// Checks that colour and specular albedo add up to at most 1.
pub(super) fn diffuse_and_specular(who: &str, colour: Rgb, specular: Rgb) -> Result<[[f64; 3]; 2], SceneError> {
    reflectance(who, "colour", colour)?;
    reflectance(who, "specular", specular)?;
    if (colour.to_vec() + specular.to_vec()).max_element() <= 1.0 {
        Ok([colour.to_array(), specular.to_array()])
    } else {
        let of_colour = triple(colour.to_vec());
        let accepted = format!(
            "with the colour {of_colour} each part must add up to at most 1, for a surface gives back no more than it gets"
        );
        Err(SceneError::new(who, "specular", triple(specular.to_vec()), accepted))
    }
}
