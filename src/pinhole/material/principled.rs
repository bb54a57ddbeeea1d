//! The principled BSDF, and the energy of its layers.

use super::bsdf::entities_of_kind;
use super::{
    Bsdf, BsdfClass, BsdfSample, ByCosine, Example, Named, Parameters, SMOOTHEST_METAL, ShadingContext,
    cosine_direction, cosine_pdf, ggx_brdf, ggx_sample, multiple_scattering_albedo, single_scattering, visible_pdf,
};
use crate::check::{kind_and_name, number, reflectance};
use crate::each::Each;
use crate::plan::{Census, Table};
use crate::sample::disk_point;
use crate::scene::{Feeds, MetallicRoughnessMap, Principled, Rgb, SceneError};
use glam::DVec3;
use std::collections::HashMap;
use std::f64::consts::FRAC_1_PI;
use std::sync::OnceLock;

/// The greatest index of refraction, at which all light is reflected.
const MAX_INDEX: f64 = 1e9;

/// Principled materials, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PrincipledTable {
    /// The reflectance of the dielectric at normal incidence, from 0 to 1.
    pub dielectric: Vec<f64>,
    /// The roughness of each where no texture gives another.
    roughness: Vec<f64>,
    /// The row of the energies of that roughness, which are there once for equal ones.
    energy_of: Vec<u32>,
    energy: Vec<EnergyTable>,
    /// The energies of all roughnesses, if a texture gives any material another than its own.
    by_roughness: &'static [EnergyTable],
    /// The clear coat of each; empty where none has one.
    coats: Vec<Coat>,
}

/// The reflectance of a clear coat at normal incidence: that of index 1.5.
const COAT: f64 = 0.04;

/// A clear coat.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Coat {
    /// How much of the surface is under it.
    factor: f64,
    roughness: f64,
    energy_of: u32,
}

/// A principled surface at one point.
#[derive(Clone, Copy)]
struct Surface<'a> {
    colour: [f64; 3],
    metallic: f64,
    alpha: f64,
    dielectric: f64,
    energy: Energy<'a>,
    coat: Option<CoatHere<'a>>,
}

/// A clear coat that is there.
#[derive(Clone, Copy)]
struct CoatHere<'a> {
    factor: f64,
    alpha: f64,
    energy: Energy<'a>,
}

impl CoatHere<'_> {
    /// What it reflects of the light that arrives or leaves at this cosine.
    #[inline(always)]
    fn albedo(&self, cosine: f64) -> f64 {
        let once = COAT * (1.0 - self.energy.lost(cosine)) + (1.0 - COAT) * self.energy.left_at_grazing(cosine);
        self.factor * once.clamp(0.0, 1.0)
    }

    // ANCHOR: coat
    /// The BRDF of a base under the coat: the coat's own reflection, and of the base's what goes through it twice.
    ///
    /// What the coat reflects back down is lost, so a coated surface is darker than its base, as wet ones are.
    #[inline(always)]
    fn over(&self, base: [f64; 3], to_light: DVec3, to_eye: DVec3) -> [f64; 3] {
        let facing = grazing(to_eye.dot((to_light + to_eye).normalize_or_zero()));
        let own = self.factor * ggx_brdf(to_light, to_eye, self.alpha) * (COAT + (1.0 - COAT) * facing);
        let through = (1.0 - self.albedo(to_light.z)) * (1.0 - self.albedo(to_eye.z));
        base.each(|base| own + through * base)
    }
    // ANCHOR_END: coat
}

impl PrincipledTable {
    /// Adds a material; the energies of equal roughnesses are there once, and their rows in `known`.
    fn push(&mut self, own: &Principled, known: &mut HashMap<u64, u32>) {
        let mut energies = |roughness: f64| {
            let alpha = alpha_of(roughness);
            *known.entry(alpha.to_bits()).or_insert_with(|| {
                self.energy.push(EnergyTable::new(alpha));
                self.energy.len() as u32 - 1
            })
        };
        let energy_of = energies(own.roughness);
        // One that is nowhere needs no energies of its own.
        let of_coat = if own.coat > 0.0 { energies(own.coat_roughness) } else { energy_of };
        self.coats.push(Coat { factor: own.coat, roughness: own.coat_roughness, energy_of: of_coat });
        let amplitude = (own.ior - 1.0) / (own.ior + 1.0);
        self.dielectric.push(amplitude * amplitude);
        self.roughness.push(own.roughness);
        self.energy_of.push(energy_of);
    }

    /// The surface at a point.
    #[inline(always)]
    fn at(&self, context: &ShadingContext) -> Surface<'_> {
        let Parameters { colour, metallic, roughness } = context.parameters;
        // A material's own roughness has energies of its own; others lie between two of many.
        let energy = if roughness == self.roughness[context.row] {
            Energy::of(&self.energy[self.energy_of[context.row] as usize], roughness)
        } else {
            Energy::between(self.by_roughness, roughness)
        };
        let coat = self.coats.get(context.row).filter(|coat| coat.factor > 0.0).map(|coat| {
            let energy = Energy::of(&self.energy[coat.energy_of as usize], coat.roughness);
            CoatHere { factor: coat.factor, alpha: alpha_of(coat.roughness), energy }
        });
        Surface { colour, metallic, alpha: alpha_of(roughness), dielectric: self.dielectric[context.row], energy, coat }
    }
}

impl Surface<'_> {
    /// The reflectance at normal incidence, of the dielectric and the metal together.
    #[inline(always)]
    fn at_normal_incidence(&self) -> [f64; 3] {
        self.colour.each(|colour| self.dielectric + self.metallic * (colour - self.dielectric))
    }

    /// Specular reflection of one scattering, in 1/sr.
    #[inline(always)]
    fn once(&self, to_light: DVec3, to_eye: DVec3) -> [f64; 3] {
        let facing = grazing(to_eye.dot((to_light + to_eye).normalize_or_zero()));
        let once = ggx_brdf(to_light, to_eye, self.alpha);
        self.at_normal_incidence().each(|normal| once * (normal + (1.0 - normal) * facing))
    }

    // ANCHOR: principled
    /// All other reflection, in 1/sr: by several microfacets, and diffuse below the dielectric.
    ///
    /// Diffuse reflection gets what specular reflection leaves of the light that enters and again of the light that
    /// leaves; its scale makes the two add up to 1 where nothing is absorbed (Kelemen and Szirmay-Kalos 2001).
    #[inline(always)]
    fn broad(&self, to_light: DVec3, to_eye: DVec3) -> [f64; 3] {
        let (energy, metallic, normal) = (self.energy, self.metallic, self.dielectric);
        let [lost_in, lost_out] = [to_light.z, to_eye.z].each(|cosine| energy.lost(cosine));
        let [left_in, left_out] = [to_light.z, to_eye.z].each(|cosine| energy.left_at_grazing(cosine));
        let [lost, left] = energy.average();
        let several = if lost > 0.0 { lost_in * lost_out / lost } else { 0.0 };
        let [below_in, below_out, below] = [[lost_in, left_in], [lost_out, left_out], [lost, left]]
            .each(|[lost, left]| 1.0 - energy.of_dielectric(normal, lost, left));
        // A dielectric that reflects all light leaves none for its base.
        let diffuse = if below > 0.0 { below_in * below_out / below } else { 0.0 };
        let again = energy.again(normal) * several;
        self.colour.each(|colour| {
            let dielectric = again + colour * diffuse;
            FRAC_1_PI * (dielectric + metallic * (energy.again(colour) * several - dielectric))
        })
    }
    // ANCHOR_END: principled

    /// The probability of sampling the coat, and that of sampling specular reflection of one scattering where it is not:
    /// their parts of the albedo.
    #[inline(always)]
    fn probabilities(&self, to_eye: DVec3) -> [f64; 2] {
        let (energy, metallic, of_dielectric) = (self.energy, self.metallic, self.dielectric);
        let (lost, left) = (energy.lost(to_eye.z), energy.left_at_grazing(to_eye.z));
        let below = 1.0 - energy.of_dielectric(of_dielectric, lost, left);
        let once: f64 =
            self.at_normal_incidence().iter().map(|normal| normal * (1.0 - lost) + (1.0 - normal) * left).sum();
        let broad = |colour: &f64| {
            let dielectric = energy.again(of_dielectric) * lost + colour * below;
            dielectric + metallic * (energy.again(*colour) * lost - dielectric)
        };
        let whole = once + self.colour.iter().map(broad).sum::<f64>();
        let specular = if whole > 0.0 { (once / whole).clamp(0.0, 1.0) } else { 1.0 };
        let coat = self.coat.map_or(0.0, |coat| {
            let own = coat.albedo(to_eye.z);
            3.0 * own / (3.0 * own + (1.0 - own) * whole)
        });
        [coat, specular]
    }

    #[inline(always)]
    fn eval(&self, to_light: DVec3, to_eye: DVec3) -> [f64; 3] {
        if to_light.z <= 0.0 || to_eye.z <= 0.0 {
            return [0.0; 3];
        }
        let (once, broad) = (self.once(to_light, to_eye), self.broad(to_light, to_eye));
        let base = [0, 1, 2].each(|part| once[part] + broad[part]);
        self.coat.map_or(base, |coat| coat.over(base, to_light, to_eye))
    }

    #[inline(always)]
    fn pdf(&self, to_light: DVec3, to_eye: DVec3) -> f64 {
        let [of_coat, once] = self.probabilities(to_eye);
        let visible = visible_pdf(to_light, to_eye, self.alpha);
        let base = once * visible + (1.0 - once) * cosine_pdf(to_light.z);
        match self.coat {
            Some(coat) => of_coat * visible_pdf(to_light, to_eye, coat.alpha) + (1.0 - of_coat) * base,
            None => base,
        }
    }

    /// By visible microfacet normals, of the coat or below it, or by the cosine; `choice` selects which.
    #[inline(always)]
    fn sample(&self, to_eye: DVec3, numbers: [f64; 2], choice: f64) -> Option<BsdfSample> {
        let [of_coat, once] = self.probabilities(to_eye);
        let below = if of_coat > 0.0 { (choice - of_coat) / (1.0 - of_coat) } else { choice };
        let to_light = if let (true, Some(coat)) = (below < 0.0, self.coat) {
            ggx_sample(to_eye, coat.alpha, disk_point(numbers))?.to_light
        } else if below < once {
            ggx_sample(to_eye, self.alpha, disk_point(numbers))?.to_light
        } else {
            cosine_direction(numbers)
        };
        let pdf = self.pdf(to_light, to_eye);
        let weight = self.eval(to_light, to_eye).each(|brdf| brdf * to_light.z / pdf);
        (pdf > 0.0).then_some(BsdfSample { to_light, pdf, weight })
    }
}

impl Table for PrincipledTable {
    const NAME: &'static str = "principled materials";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (mut table, mut known, mut has_coat) = (Self::default(), HashMap::new(), false);
        for entity in entities_of_kind(scene, Self::KIND) {
            let own = scene.get::<Principled>(entity).copied().unwrap_or_default();
            Self::parameters(&own, &kind_and_name(scene, Self::WORD, entity))?;
            table.push(&own, &mut known);
            has_coat |= own.coat > 0.0;
            if scene.get::<MetallicRoughnessMap>(entity).is_some() {
                table.by_roughness = EnergyTable::of_all_roughnesses();
            }
        }
        if !has_coat {
            table.coats.clear();
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        let rows = self.dielectric.len() * (2 * size_of::<f64>() + size_of::<u32>()) + size_of_val(&self.coats[..]);
        rows + size_of_val(&self.energy[..]) + size_of_val(self.by_roughness)
    }
}

impl Bsdf for PrincipledTable {
    type Component = Principled;
    const COMPONENT: &'static str = "Principled";
    const WORD: &'static str = "principled";
    const NOUN: &'static str = "principled surface";
    const CLASS: BsdfClass = BsdfClass::Glossy;
    const TAKES: &'static [Feeds] = &[Feeds::Colour, Feeds::MetallicRoughness];

    fn parameters(own: &Principled, who: &str) -> Result<Parameters, SceneError> {
        let numbers = [
            ("metallic", own.metallic),
            ("roughness", own.roughness),
            ("coat", own.coat),
            ("coat_roughness", own.coat_roughness),
        ];
        for (field, value) in numbers {
            if !(0.0..=1.0).contains(&value) {
                return Err(SceneError::new(who, field, number(value), "it must be a number from 0 to 1"));
            }
        }
        if !(1.0..=MAX_INDEX).contains(&own.ior) {
            return Err(SceneError::new(who, "ior", number(own.ior), "it must be a number from 1 to 1e9"));
        }
        let colour = reflectance(who, "base_colour", own.base_colour)?.to_array();
        Ok(Parameters { colour, metallic: own.metallic, roughness: own.roughness })
    }

    #[inline(always)]
    fn eval(&self, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> [f64; 3] {
        self.at(context).eval(to_light, to_eye)
    }

    #[inline(always)]
    fn pdf(&self, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> f64 {
        self.at(context).pdf(to_light, to_eye)
    }

    #[inline(always)]
    fn sample(&self, context: &ShadingContext, to_eye: DVec3, numbers: [f64; 2], choice: f64) -> Option<BsdfSample> {
        self.at(context).sample(to_eye, numbers, choice)
    }

    fn chooses(&self) -> bool {
        true
    }

    fn examples() -> Vec<Example<Principled>> {
        let of = |grey: f64, metallic, roughness| {
            let component = Principled { base_colour: Rgb::grey(grey), metallic, roughness, ..Principled::default() };
            Example { component, lossless_to: (grey == 1.0).then_some(3e-3) }
        };
        let white = [0.1, 0.3, 0.5, 0.8, 1.0].into_iter();
        let white = white.flat_map(|roughness| [0.0, 0.5, 1.0].each(|metallic| of(1.0, metallic, roughness)));
        let dense = [1.0, 2.0, 1e9].each(|ior| {
            let Example { component, lossless_to } = of(1.0, 0.0, 0.4);
            Example { component: Principled { ior, ..component }, lossless_to }
        });
        let coated =
            [(0.3, 0.0, 1.0, 0.0), (1.0, 1.0, 1.0, 0.3), (0.0, 0.0, 0.5, 0.8)].each(|(grey, metallic, coat, rough)| {
                let Example { component, .. } = of(grey, metallic, 0.5);
                let component = Principled { coat, coat_roughness: rough, ..component };
                Example { component, lossless_to: None }
            });
        white.chain(coated).chain([of(0.5, 0.0, 0.0), of(0.2, 0.3, 0.4), of(0.7, 1.0, 0.7)]).chain(dense).collect()
    }
}

// What single scattering on the microfacets of principled surfaces loses and leaves, at any roughness.

/// Steps of the hemispherical average of Schlick's part.
const STEPS: u32 = 512;
/// Equal steps of the root of roughness, from that of the smoothest metal to 1, between which images' roughnesses are
/// interpolated: by the root, since smooth surfaces differ more from one another.
const ROUGHNESSES: usize = 48;

/// (1 − cos θ)⁵.
#[inline(always)]
pub(super) fn grazing(cosine: f64) -> f64 {
    let rest = (1.0 - cosine).clamp(0.0, 1.0);
    let squared = rest * rest;
    squared * squared * rest
}

/// GGX's α of a perceived roughness.
#[inline(always)]
pub(super) fn alpha_of(roughness: f64) -> f64 {
    (roughness * roughness).max(SMOOTHEST_METAL)
}

/// The directional albedos of single scattering at one α, tabulated by the cosine, for Schlick's reflectance
/// F₀ + (1 − F₀)(1 − cos θ)⁵, which is linear in F₀.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct EnergyTable {
    lost: ByCosine,
    grazing: ByCosine,
    /// The hemispherical average of what the factor (1 − cos θ)⁵ leaves.
    average: f64,
    /// The average of what is lost over α², which changes less with α than the average itself.
    lost_over_square: f64,
}

impl EnergyTable {
    /// That of one α.
    pub fn new(alpha: f64) -> Self {
        let more = |cosine: f64| single_scattering(cosine, alpha, |facing| grazing(facing) - grazing(cosine));
        let (lost, more) = (ByCosine::lost(alpha), ByCosine::new(alpha, more));
        let lost_over_square = lost.average() / (alpha * alpha);
        let mut energy = Self { average: 0.0, lost, grazing: more, lost_over_square };
        let term = |at: u32| {
            let root = (f64::from(at) + 0.5) / f64::from(STEPS);
            4.0 * root * root * root * Energy::of(&energy, alpha.sqrt()).left_at_grazing(root * root) / f64::from(STEPS)
        };
        energy.average = (0..STEPS).map(term).sum();
        energy
    }

    /// Those of all roughnesses; they are made once, and only if a scene asks for them.
    pub fn of_all_roughnesses() -> &'static [Self] {
        static ALL: OnceLock<Vec<EnergyTable>> = OnceLock::new();
        ALL.get_or_init(|| {
            let smoothest = SMOOTHEST_METAL.sqrt().sqrt();
            let root = |step: usize| smoothest + (1.0 - smoothest) * step as f64 / ROUGHNESSES as f64;
            (0..=ROUGHNESSES).map(|step| Self::new(alpha_of(root(step) * root(step)))).collect()
        })
    }
}

/// The albedos at one roughness: those of a table, or of two of roughnesses next to it.
///
/// The tables' steps are steps of μ (1 + α) / (μ + α), over which little changes with α, so these are interpolated
/// rather than the values at one cosine.
#[derive(Clone, Copy)]
pub(super) struct Energy<'a> {
    alpha: f64,
    tables: [&'a EnergyTable; 2],
    t: f64,
}

impl<'a> Energy<'a> {
    /// Those of a perceived roughness that a table is of.
    #[inline(always)]
    pub fn of(table: &'a EnergyTable, roughness: f64) -> Self {
        Self { alpha: alpha_of(roughness), tables: [table; 2], t: 0.0 }
    }

    /// Those of a perceived roughness between two of all.
    #[inline(always)]
    pub fn between(all: &'a [EnergyTable], roughness: f64) -> Self {
        let smoothest = SMOOTHEST_METAL.sqrt().sqrt();
        let place = ((roughness.sqrt() - smoothest) / (1.0 - smoothest)).clamp(0.0, 1.0) * (all.len() - 1) as f64;
        let step = (place as usize).min(all.len() - 2);
        Self { alpha: alpha_of(roughness), tables: [&all[step], &all[step + 1]], t: place - step as f64 }
    }

    /// What is lost at this cosine where F₀ = 1.
    #[inline(always)]
    pub fn lost(&self, cosine: f64) -> f64 {
        ByCosine::between(self.tables.each(|table| &table.lost), self.t, self.alpha, cosine)
    }

    /// What the factor (1 − cos θ)⁵ leaves at this cosine, less what it would leave of smooth microfacets.
    #[inline(always)]
    pub fn more_at_grazing(&self, cosine: f64) -> f64 {
        ByCosine::between(self.tables.each(|table| &table.grazing), self.t, self.alpha, cosine)
    }

    /// The hemispherical averages of what is lost, and of what the factor leaves.
    #[inline(always)]
    pub fn average(&self) -> [f64; 2] {
        let between = |[low, high]: [f64; 2]| (1.0 - self.t) * low + self.t * high;
        let over_square = between(self.tables.each(|table| table.lost_over_square));
        [self.alpha * self.alpha * over_square, between(self.tables.each(|table| table.average))]
    }

    /// What the factor (1 − cos θ)⁵ leaves at this cosine.
    #[inline(always)]
    pub fn left_at_grazing(&self, cosine: f64) -> f64 {
        grazing(cosine) * (1.0 - self.lost(cosine)) + self.more_at_grazing(cosine)
    }

    /// The part of what is lost that leaves after further scatterings (Fdez-Agüera 2019).
    #[inline(always)]
    pub fn again(&self, normal: f64) -> f64 {
        // The hemispherical average of Schlick's reflectance.
        multiple_scattering_albedo(normal + (1.0 - normal) / 21.0, self.average()[0])
    }

    /// The albedo of the specular reflection of a dielectric that reflects `normal` at normal incidence, where single
    /// scattering loses `lost` and leaves `left` at grazing.
    #[inline(always)]
    pub fn of_dielectric(&self, normal: f64, lost: f64, left: f64) -> f64 {
        normal * (1.0 - lost) + (1.0 - normal) * left + self.again(normal) * lost
    }
}

#[cfg(test)]
mod principled_energy_tests {
    use super::*;

    /// Half way between two steps, where interpolation is worst.
    #[test]
    fn interpolated_energies_are_those_of_their_roughness() {
        let all = EnergyTable::of_all_roughnesses();
        let (mut tried, mut worst) = (0, [0.0_f64; 4]);
        let smoothest = SMOOTHEST_METAL.sqrt().sqrt();
        for step in 0..ROUGHNESSES {
            let root = smoothest + (1.0 - smoothest) * (step as f64 + 0.5) / ROUGHNESSES as f64;
            let roughness = root * root;
            let (own, between) = (EnergyTable::new(alpha_of(roughness)), Energy::between(all, roughness));
            let own = Energy::of(&own, roughness);
            for cosine in [0.0, 0.001, 0.01, 0.03, 0.1, 0.2, 0.35, 0.5, 0.7, 0.9, 1.0] {
                let lost = (own.lost(cosine) - between.lost(cosine)).abs();
                let left = (own.left_at_grazing(cosine) - between.left_at_grazing(cosine)).abs();
                worst = [worst[0].max(lost), worst[1].max(left), worst[2], worst[3]];
                tried += 1;
            }
            for part in [0, 1] {
                worst[2 + part] = worst[2 + part].max((own.average()[part] - between.average()[part]).abs());
            }
        }
        eprintln!("energies between {} roughnesses: {tried} cosines, worst {worst:.5?}", ROUGHNESSES + 1);
        assert!(worst.iter().all(|worst| *worst < 1e-3), "{worst:?}");
    }

    #[test]
    fn roughnesses_beyond_the_ends_are_those_of_the_ends() {
        let all = EnergyTable::of_all_roughnesses();
        for (roughness, table) in [(0.0, &all[0]), (0.03, &all[0]), (1.0, &all[ROUGHNESSES])] {
            let (between, table) = (Energy::between(all, roughness), Energy::of(table, roughness));
            for cosine in [0.01, 0.5, 1.0] {
                assert!((between.lost(cosine) - table.lost(cosine)).abs() < 1e-12, "{roughness}, {cosine}");
            }
            assert!((between.average()[0] - table.average()[0]).abs() < 1e-12, "{roughness}");
        }
    }
}
