use super::lobe::{HIGHLIGHTS, lobe_direction};
use super::phong::{diffuse_and_specular, exponent_within};
use super::registered::entities_of_kind;
use super::{Bsdf, BsdfClass, BsdfSample, Example, Highlight, Lobe, Named, Site, highlight, mirror_direction};
use crate::check::kind_and_name;
use crate::plan::{Census, Table};
use crate::scene::{BlinnPhong, Rgb, SceneError};
use glam::DVec3;
use std::f64::consts::TAU;

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

impl Table for BlinnPhongTable {
    const NAME: &'static str = "blinn–phong highlights";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let mut table = Self::default();
        for entity in entities_of_kind(scene, Self::KIND) {
            let own = scene.get::<BlinnPhong>(entity).copied().unwrap_or_default();
            let who = kind_and_name(scene, Self::WORD, entity);
            table.specular.push(diffuse_and_specular(&who, own.colour, own.specular)?[1]);
            table.exponent.push(exponent_within(&who, own.exponent)?);
            table.peak.push(blinn_phong_peak(own.exponent));
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.exponent.len() * size_of::<[f64; 5]>()
    }
}

impl Bsdf for BlinnPhongTable {
    type Component = BlinnPhong;
    const COMPONENT: &'static str = "BlinnPhong";
    const WORD: &'static str = "blinn_phong";
    const NOUN: &'static str = "Blinn–Phong surface";
    const CLASS: BsdfClass = BsdfClass::Diffuse;
    const LAMBERTIAN: bool = true;
    const TEXTURED: bool = true;
    const NARROW: bool = true;

    fn colour(own: &BlinnPhong, who: &str) -> Result<[f64; 3], SceneError> {
        exponent_within(who, own.exponent)?;
        Ok(diffuse_and_specular(who, own.colour, own.specular)?[0])
    }

    fn albedo_beside_colour(own: &BlinnPhong) -> Option<Rgb> {
        Some(own.specular)
    }

    #[inline(always)]
    fn eval(&self, site: &Site, to_light: DVec3, to_eye: DVec3) -> [f64; 3] {
        Highlight::new(self, site.row, site.colour).brdf(to_light, to_eye)
    }

    #[inline(always)]
    fn lobes(&self, site: &Site, to_light: DVec3, to_eye: DVec3) -> [f64; 3] {
        let height = self.value(site.row, to_light, to_eye);
        self.specular[site.row].map(|part| part * height)
    }

    #[inline(always)]
    fn pdf(&self, site: &Site, to_light: DVec3, to_eye: DVec3) -> f64 {
        Highlight::new(self, site.row, site.colour).pdf(to_light, to_eye)
    }

    #[inline(always)]
    fn sample(&self, site: &Site, to_eye: DVec3, numbers: [f64; 2], choice: f64) -> Option<BsdfSample> {
        Highlight::new(self, site.row, site.colour).sample(to_eye, numbers, choice)
    }

    fn chooses(&self) -> bool {
        true
    }

    fn examples() -> Vec<Example<BlinnPhong>> {
        let of = |[colour, specular, exponent]: [f64; 3]| BlinnPhong {
            colour: Rgb::grey(colour),
            specular: Rgb::grey(specular),
            exponent,
        };
        HIGHLIGHTS.iter().map(|&own| Example { component: of(own), lossless_to: None }).collect()
    }
}

impl Lobe for BlinnPhongTable {
    #[inline(always)]
    fn specular(&self, row: usize) -> [f64; 3] {
        self.specular[row]
    }

    #[inline(always)]
    fn value(&self, row: usize, to_light: DVec3, to_eye: DVec3) -> f64 {
        highlight(self.peak[row], self.exponent[row], half_vector_cosine(DVec3::Z, to_light, to_eye))
    }

    /// Reflection at the half vector h spreads the pdf of h over 4 (ωₒ · h) times the solid angle.
    #[inline(always)]
    fn pdf(&self, row: usize, to_light: DVec3, to_eye: DVec3) -> f64 {
        let exponent = self.exponent[row];
        let facing = to_eye.dot((to_light + to_eye).normalize_or_zero());
        let of_half = highlight((exponent + 1.0) / TAU, exponent, half_vector_cosine(DVec3::Z, to_light, to_eye));
        if facing > 0.0 { of_half / (4.0 * facing) } else { 0.0 }
    }

    #[inline(always)]
    fn sample(&self, row: usize, to_eye: DVec3, numbers: [f64; 2]) -> DVec3 {
        let half = lobe_direction(DVec3::Z, self.exponent[row], numbers);
        // A half vector that faces away from the eye is none of any pair of directions.
        if to_eye.dot(half) > 0.0 { mirror_direction(-to_eye, half) } else { -DVec3::Z }
    }
}
