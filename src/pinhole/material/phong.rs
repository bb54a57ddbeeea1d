use super::highlight::lobe_direction;
use super::{HighlightTable, Lobe};
use crate::scene::{Phong, Rgb};
use glam::DVec3;

/// Phong highlights.
pub type PhongTable = HighlightTable<PhongLobe>;

/// A lobe about the direction of mirror reflection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhongLobe;

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

// ANCHOR: mirror_cosine
/// cos α between the direction to the eye and the mirror reflection of the direction to the light; no vector need be
/// normalised.
///
/// The reflection is 2(n·l)n − l; the formula is symmetric in eye and light.
#[inline(always)]
pub fn mirror_cosine(normal: DVec3, to_light: DVec3, to_eye: DVec3) -> f64 {
    let twice = 2.0 * normal.dot(to_light) * normal.dot(to_eye) / normal.dot(normal);
    (twice - to_light.dot(to_eye)) / (to_light.length() * to_eye.length())
}
// ANCHOR_END: mirror_cosine

impl Lobe for PhongLobe {
    type Component = Phong;
    const TABLE: &'static str = "phong highlights";
    const COMPONENT: &'static str = "Phong";
    const WORD: &'static str = "phong";
    const NOUN: &'static str = "Phong surface";

    fn albedos(own: &Phong) -> [Rgb; 2] {
        [own.colour, own.specular]
    }

    fn exponent(own: &Phong) -> f64 {
        own.exponent
    }

    fn component([colour, specular]: [Rgb; 2], exponent: f64) -> Phong {
        Phong { colour, specular, exponent }
    }

    fn peak(exponent: f64) -> f64 {
        phong_peak(exponent)
    }

    #[inline(always)]
    fn cosine(to_light: DVec3, to_eye: DVec3) -> f64 {
        mirror_cosine(DVec3::Z, to_light, to_eye)
    }

    #[inline(always)]
    fn pdf(of_angle: f64, _to_light: DVec3, _to_eye: DVec3) -> f64 {
        of_angle
    }

    #[inline(always)]
    fn sample(exponent: f64, to_eye: DVec3, numbers: [f64; 2]) -> DVec3 {
        lobe_direction(DVec3::new(-to_eye.x, -to_eye.y, to_eye.z), exponent, numbers)
    }
}
