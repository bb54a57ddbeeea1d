use super::lobe::{HIGHLIGHTS, lobe_direction};
use super::registered::entities_of_kind;
use super::{Bsdf, BsdfClass, BsdfSample, Example, Highlight, Lobe, Named, Site, highlight};
use crate::check::{kind_and_name, number, reflectance, triple};
use crate::plan::{Census, Table};
use crate::scene::{Phong, Rgb, SceneError};
use glam::DVec3;
use std::f64::consts::TAU;

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

impl Table for PhongTable {
    const NAME: &'static str = "phong highlights";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let mut table = Self::default();
        for entity in entities_of_kind(scene, Self::KIND) {
            let own = scene.get::<Phong>(entity).copied().unwrap_or_default();
            let who = kind_and_name(scene, Self::WORD, entity);
            table.specular.push(diffuse_and_specular(&who, own.colour, own.specular)?[1]);
            table.exponent.push(exponent_within(&who, own.exponent)?);
            table.peak.push(phong_peak(own.exponent));
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.exponent.len() * size_of::<[f64; 5]>()
    }
}

impl Bsdf for PhongTable {
    type Component = Phong;
    const COMPONENT: &'static str = "Phong";
    const WORD: &'static str = "phong";
    const NOUN: &'static str = "Phong surface";
    const CLASS: BsdfClass = BsdfClass::Diffuse;
    const LAMBERTIAN: bool = true;
    const TEXTURED: bool = true;
    const NARROW: bool = true;

    fn colour(own: &Phong, who: &str) -> Result<[f64; 3], SceneError> {
        exponent_within(who, own.exponent)?;
        Ok(diffuse_and_specular(who, own.colour, own.specular)?[0])
    }

    fn albedo_beside_colour(own: &Phong) -> Option<Rgb> {
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

    fn examples() -> Vec<Example<Phong>> {
        let of = |[colour, specular, exponent]: [f64; 3]| Phong {
            colour: Rgb::grey(colour),
            specular: Rgb::grey(specular),
            exponent,
        };
        HIGHLIGHTS.iter().map(|&own| Example { component: of(own), lossless_to: None }).collect()
    }
}

impl Lobe for PhongTable {
    #[inline(always)]
    fn specular(&self, row: usize) -> [f64; 3] {
        self.specular[row]
    }

    #[inline(always)]
    fn value(&self, row: usize, to_light: DVec3, to_eye: DVec3) -> f64 {
        highlight(self.peak[row], self.exponent[row], mirror_cosine(DVec3::Z, to_light, to_eye))
    }

    #[inline(always)]
    fn pdf(&self, row: usize, to_light: DVec3, to_eye: DVec3) -> f64 {
        let exponent = self.exponent[row];
        highlight((exponent + 1.0) / TAU, exponent, mirror_cosine(DVec3::Z, to_light, to_eye))
    }

    #[inline(always)]
    fn sample(&self, row: usize, to_eye: DVec3, numbers: [f64; 2]) -> DVec3 {
        lobe_direction(DVec3::new(-to_eye.x, -to_eye.y, to_eye.z), self.exponent[row], numbers)
    }
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
