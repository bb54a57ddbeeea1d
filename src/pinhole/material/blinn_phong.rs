use super::highlight::lobe_direction;
use super::{HighlightTable, Lobe, mirror_direction};
use crate::scene::{BlinnPhong, Rgb};
use glam::DVec3;

/// Blinn–Phong highlights.
pub type BlinnPhongTable = HighlightTable<BlinnPhongLobe>;

/// A lobe of half vectors about the normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlinnPhongLobe;

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

// ANCHOR: half_vector_cosine
/// cos β between the normal and the half vector of the directions to light and eye; no vector need be normalised.
///
/// Where light and eye are opposite each other there is no half vector, and the result is NaN, which gives no
/// highlight.
#[inline(always)]
pub fn half_vector_cosine(normal: DVec3, to_light: DVec3, to_eye: DVec3) -> f64 {
    let half_vector = to_light / to_light.length() + to_eye / to_eye.length();
    normal.dot(half_vector) / (normal.length() * half_vector.length())
}
// ANCHOR_END: half_vector_cosine

impl Lobe for BlinnPhongLobe {
    type Component = BlinnPhong;
    const TABLE: &'static str = "blinn–phong highlights";
    const COMPONENT: &'static str = "BlinnPhong";
    const WORD: &'static str = "blinn_phong";
    const NOUN: &'static str = "Blinn–Phong surface";

    fn albedos(own: &BlinnPhong) -> [Rgb; 2] {
        [own.colour, own.specular]
    }

    fn exponent(own: &BlinnPhong) -> f64 {
        own.exponent
    }

    fn component([colour, specular]: [Rgb; 2], exponent: f64) -> BlinnPhong {
        BlinnPhong { colour, specular, exponent }
    }

    fn peak(exponent: f64) -> f64 {
        blinn_phong_peak(exponent)
    }

    #[inline(always)]
    fn cosine(to_light: DVec3, to_eye: DVec3) -> f64 {
        half_vector_cosine(DVec3::Z, to_light, to_eye)
    }

    /// Reflection at the half vector h spreads the pdf of h over 4 (ωₒ · h) times the solid angle.
    #[inline(always)]
    fn pdf(of_half: f64, to_light: DVec3, to_eye: DVec3) -> f64 {
        let facing = to_eye.dot((to_light + to_eye).normalize_or_zero());
        if facing > 0.0 { of_half / (4.0 * facing) } else { 0.0 }
    }

    #[inline(always)]
    fn sample(exponent: f64, to_eye: DVec3, numbers: [f64; 2]) -> DVec3 {
        let half = lobe_direction(DVec3::Z, exponent, numbers);
        // A half vector that faces away from the eye is none of any pair of directions.
        if to_eye.dot(half) > 0.0 { mirror_direction(-to_eye, half) } else { -DVec3::Z }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_do_not_change_the_angle_to_the_half_vector() {
        let normal = DVec3::new(0.0, 0.6, 0.8);
        for angle in [0.0_f64, 0.3, 1.2] {
            // Light and eye lean as much to either side of a direction at this angle to the normal.
            let half = normal * libm::cos(angle) + DVec3::X * libm::sin(angle);
            let across = half.any_orthonormal_vector() * 0.7;
            for [a, b, c] in [[1.0; 3], [2.0, 1.0, 1.0], [1.0, 3.0, 1.0], [1.0, 1.0, 0.2]] {
                let found = half_vector_cosine(a * normal, b * (half + across), c * (half - across));
                assert!((found - libm::cos(angle)).abs() < 1e-12, "{angle}: {found}");
            }
        }
    }
}
