//! Highlights: lobes about a direction.

use super::bsdf::entities_of_kind;
use super::power::power_of_cosine;
use super::{
    Bsdf, BsdfClass, BsdfSample, Example, Named, Parameters, ShadingContext, cosine_direction, cosine_pdf, frame_of,
    lambertian, reverse_pdf,
};
use crate::check::{kind_and_name, number, reflectance, triple};
use crate::each::Each;
use crate::plan::{Census, Table};
use crate::sample::disk_point;
use crate::scene::{Feeds, Rgb, SceneError};
use bevy_ecs::prelude::Component;
use glam::DVec3;
use std::f64::consts::TAU;
use std::marker::PhantomData;

// ANCHOR: highlight
/// The BRDF of a highlight, a lobe of N cosⁿ of the angle from its axis, in 1/sr.
///
/// It is 0 from a right angle on; a cosine above 1 by rounding is clamped, since a large power would amplify it.
#[inline(always)]
pub fn highlight(peak: f64, exponent: f64, cosine: f64) -> f64 {
    peak * lobe_power(exponent, cosine)
}

/// cosⁿ of the angle from a lobe's axis.
#[inline(always)]
fn lobe_power(exponent: f64, cosine: f64) -> f64 {
    if cosine > 0.0 { power_of_cosine(cosine.min(1.0), exponent) } else { 0.0 }
}
// ANCHOR_END: highlight

/// The largest exponent, whose highlight falls to one half within 0.002°.
const LARGEST_EXPONENT: f64 = 1e9;

/// The diffuse albedo, specular albedo and exponent of the materials that tests render.
const EXAMPLES: &[[f64; 3]] = &[[0.4, 0.3, 12.0], [0.05, 0.9, 100.0], [0.0, 1.0, 0.0]];

/// The highlights of one model, in spawn order.
#[derive(Clone, Debug, PartialEq)]
pub struct HighlightTable<L> {
    /// The specular albedo of each: red, green, blue, from 0 to 1.
    pub specular: Vec<[f64; 3]>,
    /// The exponent n; larger ones give a narrower lobe.
    pub exponent: Vec<f64>,
    /// The value at the centre of the lobe, by [`Lobe::peak`], in 1/sr.
    pub peak: Vec<f64>,
    lobe: PhantomData<fn() -> L>,
}

impl<L: Lobe> HighlightTable<L> {
    /// Highlights of these specular albedos and exponents.
    pub fn new(specular: Vec<[f64; 3]>, exponent: Vec<f64>) -> Self {
        let peak = exponent.iter().map(|&exponent| L::peak(exponent)).collect();
        Self { specular, exponent, peak, lobe: PhantomData }
    }
}

impl<L: Lobe> Table for HighlightTable<L>
where
    Self: Named,
{
    const NAME: &'static str = L::TABLE;

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (mut specular, mut exponent) = (Vec::new(), Vec::new());
        for entity in entities_of_kind(scene, Self::KIND) {
            let own = scene.get::<L::Component>(entity).copied().unwrap_or_default();
            specular.push(diffuse_and_specular::<L>(&own, &kind_and_name(scene, L::WORD, entity))?[1]);
            exponent.push(L::exponent(&own));
        }
        Ok(Self::new(specular, exponent))
    }

    fn bytes(&self) -> usize {
        self.exponent.len() * size_of::<[f64; 5]>()
    }
}

impl<L: Lobe> Bsdf for HighlightTable<L>
where
    Self: Named,
{
    type Component = L::Component;
    const COMPONENT: &'static str = L::COMPONENT;
    const WORD: &'static str = L::WORD;
    const NOUN: &'static str = L::NOUN;
    const CLASS: BsdfClass = BsdfClass::Diffuse;
    const TAKES: &'static [Feeds] = &[Feeds::Colour];
    const NARROW: bool = true;

    fn parameters(own: &L::Component, who: &str) -> Result<Parameters, SceneError> {
        Ok(Parameters::coloured(diffuse_and_specular::<L>(own, who)?[0]))
    }

    fn albedo_beside_colour(own: &L::Component) -> Option<Rgb> {
        Some(L::albedos(own)[1])
    }

    #[inline(always)]
    fn eval(&self, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> [f64; 3] {
        Highlight::new(self, context.row, context.parameters.colour).brdf(to_light, to_eye)
    }

    #[inline(always)]
    fn pdf(&self, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> f64 {
        Highlight::new(self, context.row, context.parameters.colour).pdf(to_light, to_eye)
    }

    #[inline(always)]
    fn eval_and_pdfs(&self, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> ([f64; 3], [f64; 2]) {
        let own = Highlight::new(self, context.row, context.parameters.colour);
        let power = own.power(to_light, to_eye);
        (own.brdf_of(power), own.pdfs_of(power, [to_light, to_eye], || reverse_pdf(self, context, to_light, to_eye)))
    }

    #[inline(always)]
    fn pdfs(&self, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> [f64; 2] {
        let own = Highlight::new(self, context.row, context.parameters.colour);
        let power = own.power(to_light, to_eye);
        own.pdfs_of(power, [to_light, to_eye], || reverse_pdf(self, context, to_light, to_eye))
    }

    #[inline(always)]
    fn sample(&self, context: &ShadingContext, to_eye: DVec3, numbers: [f64; 2], choice: f64) -> Option<BsdfSample> {
        Highlight::new(self, context.row, context.parameters.colour).sample(to_eye, numbers, choice)
    }

    fn chooses(&self) -> bool {
        true
    }

    fn examples() -> Vec<Example<L::Component>> {
        let of = |&[colour, specular, exponent]: &[f64; 3]| L::component([colour, specular].each(Rgb::grey), exponent);
        EXAMPLES.iter().map(|own| Example { component: of(own), lossless_to: None }).collect()
    }
}

/// The diffuse and the specular albedo, which add up to at most 1.
///
/// Errors: the first of the component's values that is invalid.
fn diffuse_and_specular<L: Lobe>(own: &L::Component, who: &str) -> Result<[[f64; 3]; 2], SceneError> {
    let ([colour, specular], exponent) = (L::albedos(own), L::exponent(own));
    if !(0.0..=LARGEST_EXPONENT).contains(&exponent) {
        let accepted = format!("it must be a number from 0 to {LARGEST_EXPONENT:e}");
        return Err(SceneError::new(who, "exponent", number(exponent), accepted));
    }
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

/// The specular lobe of a material that has one beside its diffuse reflection; directions are unit vectors in the
/// frame of the surface, whose normal is +z.
pub trait Lobe: Send + Sync + Sized + 'static {
    /// The material's component.
    type Component: Component + Copy + Default;
    /// The name of the table of its parameters.
    const TABLE: &'static str;
    /// The component's name.
    const COMPONENT: &'static str;
    /// The component's word in messages and in scene files.
    const WORD: &'static str;
    /// One such surface, in the reasons of the plan.
    const NOUN: &'static str;

    /// A component's diffuse and specular albedo.
    fn albedos(component: &Self::Component) -> [Rgb; 2];
    /// A component's exponent.
    fn exponent(component: &Self::Component) -> f64;
    /// The component of these.
    fn component(albedos: [Rgb; 2], exponent: f64) -> Self::Component;

    /// The value at the centre of a lobe, in 1/sr.
    fn peak(exponent: f64) -> f64;
    /// The cosine of the angle from its axis; light and eye may change places.
    fn cosine(to_light: DVec3, to_eye: DVec3) -> f64;
    /// The pdf with which [`Self::sample`] chooses `to_light`, in 1/sr, given that of the angle from the axis.
    fn pdf(of_angle: f64, to_light: DVec3, to_eye: DVec3) -> f64;
    /// Samples a direction to the light with two numbers in [0, 1); it may lead below the surface.
    fn sample(exponent: f64, to_eye: DVec3, numbers: [f64; 2]) -> DVec3;
}

// ANCHOR: lobe_direction
/// A direction about an axis with pdf (n + 1) cosⁿ / 2π, for two numbers in [0, 1).
///
/// For a large exponent cos = u^(1/(n+1)) is so close to 1 that 1 − cos² would cancel, so it comes from `expm1`.
#[inline(always)]
pub(super) fn lobe_direction(axis: DVec3, exponent: f64, u: [f64; 2]) -> DVec3 {
    let on_disk = disk_point(u);
    let log = libm::log1p(-on_disk.squared()) / (exponent + 1.0);
    let (cosine, sine) = (libm::exp(log), (-libm::expm1(2.0 * log)).sqrt());
    let [x, y] = on_disk.at(sine);
    frame_of(axis) * DVec3::new(x, y, cosine)
}
// ANCHOR_END: lobe_direction

/// A material of diffuse reflection and a specular lobe, in the frame of a surface.
#[derive(Clone, Copy, Debug)]
pub struct Highlight<'a, L> {
    lobes: &'a HighlightTable<L>,
    row: usize,
    colour: [f64; 3],
    /// The probability with which the lobe is sampled: its part of the albedo.
    of_lobe: f64,
}

impl<'a, L: Lobe> Highlight<'a, L> {
    /// The material of a row of the lobes, with its diffuse colour.
    #[inline(always)]
    pub fn new(lobes: &'a HighlightTable<L>, row: usize, colour: [f64; 3]) -> Self {
        let [specular, diffuse] = [lobes.specular[row], colour].each(|[r, g, b]| r + g + b);
        let whole = specular + diffuse;
        Self { lobes, row, colour, of_lobe: if whole > 0.0 { specular / whole } else { 0.0 } }
    }

    /// The BRDF in 1/sr: red, green, blue.
    #[inline(always)]
    pub fn brdf(&self, to_light: DVec3, to_eye: DVec3) -> [f64; 3] {
        self.brdf_of(self.power(to_light, to_eye))
    }

    /// The pdf with which [`Self::sample`] chooses `to_light`, in 1/sr.
    #[inline(always)]
    pub fn pdf(&self, to_light: DVec3, to_eye: DVec3) -> f64 {
        let power = if self.of_lobe > 0.0 { self.power(to_light, to_eye) } else { 0.0 };
        self.pdf_of(power, [to_light, to_eye])
    }

    /// cosⁿ of the angle from the lobe's axis, which takes most of the time, and which all that follows has in common.
    #[inline(always)]
    fn power(&self, to_light: DVec3, to_eye: DVec3) -> f64 {
        lobe_power(self.lobes.exponent[self.row], L::cosine(to_light, to_eye))
    }

    #[inline(always)]
    fn brdf_of(&self, power: f64) -> [f64; 3] {
        let (value, specular) = (self.lobes.peak[self.row] * power, self.lobes.specular[self.row]);
        let diffuse = lambertian(self.colour);
        [0, 1, 2].each(|part| diffuse[part] + specular[part] * value)
    }

    #[inline(always)]
    fn pdf_of(&self, power: f64, [to_light, to_eye]: [DVec3; 2]) -> f64 {
        let of_angle = (self.lobes.exponent[self.row] + 1.0) / TAU * power;
        let of_lobe = if self.of_lobe > 0.0 { L::pdf(of_angle, to_light, to_eye) } else { 0.0 };
        self.of_lobe * of_lobe + (1.0 - self.of_lobe) * cosine_pdf(to_light.z)
    }

    /// The pdfs of both ways; that of the way back is given where it leads to the other side.
    #[inline(always)]
    fn pdfs_of(&self, power: f64, [to_light, to_eye]: [DVec3; 2], behind: impl FnOnce() -> f64) -> [f64; 2] {
        let back = if to_light.z >= 0.0 { self.pdf_of(power, [to_eye, to_light]) } else { behind() };
        [self.pdf_of(power, [to_light, to_eye]), back]
    }

    /// Samples a direction to the light; none where it leads below the surface.
    ///
    /// `choice`, a number in [0, 1), selects the specular lobe or the diffuse one.
    #[inline(always)]
    pub fn sample(&self, to_eye: DVec3, numbers: [f64; 2], choice: f64) -> Option<BsdfSample> {
        let specular = choice < self.of_lobe;
        let exponent = self.lobes.exponent[self.row];
        let to_light = if specular { L::sample(exponent, to_eye, numbers) } else { cosine_direction(numbers) };
        let power = self.power(to_light, to_eye);
        let pdf = self.pdf_of(power, [to_light, to_eye]);
        let weight = self.brdf_of(power).each(|brdf| brdf * to_light.z / pdf);
        (to_light.z > 0.0 && pdf > 0.0).then_some(BsdfSample { to_light, pdf, weight })
    }
}

#[cfg(test)]
mod highlight_tests {
    use super::*;
    use crate::material::{blinn_phong_peak, half_vector_cosine, mirror_cosine, phong_peak};
    use crate::measure::draws::Draws;
    use glam::DVec3;

    /// The BRDF stays the same when light and eye are exchanged.
    #[test]
    fn highlights_are_reciprocal() {
        for index in 0..20_000 {
            let mut draws = Draws::new(1511, index);
            let exponent = draws.power_of_ten(0.0, 6.0);
            let normal = draws.unit_vector();
            let mut direction = || (normal * draws.between(0.0, 1.0) + draws.unit_vector_across(normal)).normalize();
            let (light, eye) = (direction(), direction());
            for (peak, cosine) in [
                (phong_peak(exponent), mirror_cosine as fn(_, _, _) -> f64),
                (blinn_phong_peak(exponent), half_vector_cosine),
            ] {
                let there = highlight(peak, exponent, cosine(normal, light, eye));
                let back = highlight(peak, exponent, cosine(normal, eye, light));
                let doubt = (exponent + 8.0) * 1e-14 / cosine(normal, light, eye).abs();
                assert!((there - back).abs() <= doubt * there.max(back), "{index}: {there} {back}");
            }
        }
        eprintln!("highlights: 20000 pairs of directions, two models, reciprocal");
    }

    #[test]
    fn highlights_at_their_limits() {
        assert_eq!(highlight(2.0, 1e9, 1.000_001), 2.0, "a cosine above 1 by rounding");
        assert_eq!(highlight(2.0, 1e9, 0.999), 0.0);
        assert_eq!([highlight(2.0, 0.0, 1e-300), highlight(2.0, 0.0, 0.0), highlight(2.0, 2.0, -1.0)], [2.0, 0.0, 0.0]);
        assert_eq!(highlight(2.0, 5.0, f64::NAN), 0.0);
        let opposite = half_vector_cosine(DVec3::Y, DVec3::X, -DVec3::X);
        assert_eq!(highlight(2.0, 5.0, opposite), 0.0, "light and eye are opposite");
        assert!(phong_peak(1e9).is_finite() && blinn_phong_peak(1e9).is_finite());
        assert!((blinn_phong_peak(0.0) - std::f64::consts::FRAC_1_PI).abs() < 1e-16, "an exponent of 0 is matte");
    }
}

#[cfg(test)]
mod lobe_tests {
    use super::*;
    use crate::material::{BlinnPhongTable, PhongTable};
    use crate::measure::chi_squared::{Bins, p_value};
    use crate::measure::draws::Draws;
    use std::f64::consts::PI;
    use std::f64::consts::TAU;

    const EXPONENTS: [f64; 4] = [1.0, 3.0, 12.0, 60.0];
    /// Angles of the direction to the eye, in degrees, and diffuse colours.
    const SURFACES: [(f64, f64); 5] = [(0.0, 0.0), (30.0, 0.4), (65.0, 0.0), (80.0, 0.0), (80.0, 0.4)];
    const RINGS: usize = 20;
    const SECTORS: usize = 24;
    /// Steps of the midpoint rule across a bin.
    const STEPS: usize = 32;

    fn phong(exponent: f64) -> PhongTable {
        PhongTable::new(vec![[0.3; 3]], vec![exponent])
    }

    fn blinn_phong(exponent: f64) -> BlinnPhongTable {
        BlinnPhongTable::new(vec![[0.3; 3]], vec![exponent])
    }

    fn eye_at(degrees: f64) -> DVec3 {
        let angle = degrees * PI / 180.0;
        DVec3::new(libm::sin(angle), 0.0, libm::cos(angle))
    }

    /// ∫ f dω over a bin of the cosine and the azimuth.
    fn over_bin(ring: usize, sector: usize, f: impl Fn(DVec3) -> f64) -> f64 {
        let (rise, turn) = (1.0 / (RINGS * STEPS) as f64, TAU / (SECTORS * STEPS) as f64);
        let mut sum = 0.0;
        for i in 0..STEPS {
            for j in 0..STEPS {
                let z = ((ring * STEPS + i) as f64 + 0.5) * rise;
                let (y, x) = libm::sincos(((sector * STEPS + j) as f64 + 0.5) * turn);
                let across = (1.0 - z * z).sqrt();
                sum += f(DVec3::new(x * across, y * across, z));
            }
        }
        sum * rise * turn
    }

    /// Directions have their pdf, the mean of the weights is the albedo, and no white surface gives back more than it
    /// gets.
    fn check<L: Lobe>(name: &str, lobes: &HighlightTable<L>, exponent: f64, angle: f64, colour: f64, seed: u64) -> f64 {
        const SAMPLES: u64 = 60_000;
        let (material, eye) = (Highlight::new(lobes, 0, [colour; 3]), eye_at(angle));
        // The last bin is for directions below the surface.
        let mut bins = Bins::new(RINGS * SECTORS + 1);
        let (mut above, mut albedo) = (0.0, 0.0);
        for bin in 0..RINGS * SECTORS {
            let (ring, sector) = (bin / SECTORS, bin % SECTORS);
            let part = over_bin(ring, sector, |light| material.pdf(light, eye));
            bins.expect(bin, part * SAMPLES as f64);
            above += part;
            albedo += over_bin(ring, sector, |light| material.brdf(light, eye)[0] * light.z);
        }
        assert!(above < 1.0 + 1e-3 && albedo < colour + 0.3 + 1e-3, "{name} {exponent} {angle}°: {above} {albedo}");
        bins.expect(RINGS * SECTORS, (1.0 - above).max(0.0) * SAMPLES as f64);
        let (mut sum, mut squares) = (0.0, 0.0);
        for index in 0..SAMPLES {
            let mut draws = Draws::new(seed, index);
            let sampled = material.sample(eye, [draws.unit(), draws.unit()], draws.unit());
            let weight = sampled.map_or(0.0, |sampled| sampled.weight[0]);
            (sum, squares) = (sum + weight, squares + weight * weight);
            bins.count(sampled.map_or(RINGS * SECTORS, |BsdfSample { to_light: light, .. }| {
                let turn = libm::atan2(light.y, light.x) / TAU;
                let sector = ((turn - turn.floor()) * SECTORS as f64) as usize;
                ((light.z * RINGS as f64) as usize).min(RINGS - 1) * SECTORS + sector.min(SECTORS - 1)
            }));
        }
        let mean = sum / SAMPLES as f64;
        let error = ((squares / SAMPLES as f64 - mean * mean).max(0.0) / SAMPLES as f64).sqrt();
        assert!((mean - albedo).abs() <= 4.0 * error + 2e-3 * albedo, "{name} {exponent} {angle}°: {mean} {albedo}");
        let (statistic, freedom) = bins.statistic();
        p_value(statistic, freedom)
    }

    #[test]
    fn directions_have_their_pdf_and_weights_their_mean() {
        let mut min = 1.0_f64;
        let mut tried = 0;
        for exponent in EXPONENTS {
            for (angle, colour) in SURFACES {
                tried += 2;
                let seed = 1600 + tried;
                min = min.min(check("Phong", &phong(exponent), exponent, angle, colour, seed));
                let lobes = blinn_phong(exponent);
                min = min.min(check("Blinn–Phong", &lobes, exponent, angle, colour, seed + 1));
            }
        }
        eprintln!("highlights: {tried} materials and angles, least p {min:.4}");
        // Šidák: the least of so many is below this once in a thousand.
        assert!(min > 1.0 - libm::pow(0.999, 1.0 / tried as f64), "{min}");
    }

    #[test]
    fn extreme_numbers_give_finite_samples() {
        const LAST: f64 = 1.0 - 1.0 / (1 << 24) as f64;
        let corners = [0.0, 1.0 / (1 << 24) as f64, 0.5, LAST];
        let mut tried = 0;
        let mut check = |sampled: Option<BsdfSample>, what: &str| {
            tried += 1;
            if let Some(BsdfSample { to_light: light, pdf, weight: weights }) = sampled {
                assert!(
                    light.z > 0.0 && (light.length() - 1.0).abs() < 1e-12 && pdf.is_finite(),
                    "{what}: {light} {pdf}"
                );
                assert!(weights.iter().all(|weight| (0.0..4.0).contains(weight)), "{what}: {weights:?}");
            }
        };
        for exponent in [0.0, 1e-3, 1.0, 1e3, 1e6, 1e9] {
            for angle in [0.0, 1e-7, 45.0, 89.999_999, 90.0] {
                for numbers in corners.into_iter().flat_map(|u| corners.map(|v| [u, v])) {
                    for choice in corners {
                        let (eye, what) = (eye_at(angle), format!("{exponent} {angle}° {numbers:?} {choice}"));
                        let (phong, blinn_phong) = (phong(exponent), blinn_phong(exponent));
                        check(Highlight::new(&phong, 0, [0.4; 3]).sample(eye, numbers, choice), &what);
                        check(Highlight::new(&blinn_phong, 0, [0.0; 3]).sample(eye, numbers, choice), &what);
                    }
                }
            }
        }
        assert_eq!(Highlight::new(&phong(5.0), 0, [0.0; 3]).of_lobe, 1.0);
        eprintln!("highlights: {tried} of the hardest numbers, all finite");
    }
}
