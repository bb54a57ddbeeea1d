use super::registered::entities_of_kind;
use super::{
    Bsdf, BsdfClass, BsdfSample, ByCosine, Example, Named, SMOOTHEST_METAL, Site, cosine_direction, cosine_pdf,
    ggx_brdf, ggx_sample, multiple_scattering_albedo, single_scattering, visible_pdf,
};
use crate::check::{kind_and_name, number, reflectance};
use crate::plan::{Census, Table};
use crate::scene::{Principled, Rgb, SceneError};
use glam::DVec3;
use std::f64::consts::FRAC_1_PI;

/// The reflectance of a dielectric of index 1.5 at normal incidence.
const DIELECTRIC: f64 = 0.04;
/// Steps of the hemispherical average of Schlick's part.
const STEPS: u32 = 512;

/// Principled materials, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PrincipledTable {
    /// How much of each is metal, from 0 to 1.
    pub metallic: Vec<f64>,
    /// GGX's α, from 0.001 to 1.
    pub alpha: Vec<f64>,
    energy: Vec<Energy>,
}

/// The directional albedos of single scattering at one α, for Schlick's reflectance F₀ + (1 − F₀)(1 − cos θ)⁵, which is
/// linear in F₀.
#[derive(Clone, Debug, PartialEq)]
struct Energy {
    /// What is lost where F₀ = 1.
    lost: ByCosine,
    /// What the factor (1 − cos θ)⁵ leaves, less what it would leave of smooth microfacets.
    grazing: ByCosine,
    /// The hemispherical averages of what is lost, and of what the factor leaves.
    average: [f64; 2],
}

/// (1 − cos θ)⁵.
#[inline(always)]
fn grazing(cosine: f64) -> f64 {
    let rest = (1.0 - cosine).clamp(0.0, 1.0);
    let squared = rest * rest;
    squared * squared * rest
}

impl Energy {
    fn new(alpha: f64) -> Self {
        let more = |cosine: f64| single_scattering(cosine, alpha, |facing| grazing(facing) - grazing(cosine));
        let (lost, more) = (ByCosine::lost(alpha), ByCosine::new(alpha, more));
        let mut energy = Self { average: [lost.average(), 0.0], lost, grazing: more };
        let term = |at: u32| {
            let root = (f64::from(at) + 0.5) / f64::from(STEPS);
            4.0 * root * root * root * energy.left_at_grazing(root * root) / f64::from(STEPS)
        };
        energy.average[1] = (0..STEPS).map(term).sum();
        energy
    }

    /// What the factor (1 − cos θ)⁵ leaves at this cosine.
    #[inline(always)]
    fn left_at_grazing(&self, cosine: f64) -> f64 {
        grazing(cosine) * (1.0 - self.lost.at(cosine)) + self.grazing.at(cosine)
    }

    /// The part of what is lost that leaves after further scatterings (Fdez-Agüera 2019).
    #[inline(always)]
    fn again(&self, normal: f64) -> f64 {
        // The hemispherical average of Schlick's reflectance.
        multiple_scattering_albedo(normal + (1.0 - normal) / 21.0, self.average[0])
    }

    /// The albedo of the dielectric's specular reflection where single scattering loses `lost` and leaves `left` at
    /// grazing.
    #[inline(always)]
    fn of_dielectric(&self, lost: f64, left: f64) -> f64 {
        DIELECTRIC * (1.0 - lost) + (1.0 - DIELECTRIC) * left + self.again(DIELECTRIC) * lost
    }
}

impl PrincipledTable {
    fn push(&mut self, metallic: f64, roughness: f64) {
        let alpha = (roughness * roughness).max(SMOOTHEST_METAL);
        self.metallic.push(metallic);
        self.alpha.push(alpha);
        self.energy.push(Energy::new(alpha));
    }

    /// The reflectance at normal incidence, of the dielectric and the metal together.
    #[inline(always)]
    fn at_normal_incidence(&self, site: &Site) -> [f64; 3] {
        site.colour.map(|colour| DIELECTRIC + self.metallic[site.row] * (colour - DIELECTRIC))
    }

    /// Specular reflection of one scattering, in 1/sr.
    #[inline(always)]
    fn once(&self, site: &Site, to_light: DVec3, to_eye: DVec3) -> [f64; 3] {
        let facing = grazing(to_eye.dot((to_light + to_eye).normalize_or_zero()));
        let once = ggx_brdf(to_light, to_eye, self.alpha[site.row]);
        self.at_normal_incidence(site).map(|normal| once * (normal + (1.0 - normal) * facing))
    }

    // ANCHOR: principled
    /// All other reflection, in 1/sr: by several microfacets, and diffuse below the dielectric.
    ///
    /// Diffuse reflection gets what specular reflection leaves of the light that enters and again of the light that
    /// leaves; its scale makes the two add up to 1 where nothing is absorbed (Kelemen and Szirmay-Kalos 2001).
    #[inline(always)]
    fn broad(&self, site: &Site, to_light: DVec3, to_eye: DVec3) -> [f64; 3] {
        let (energy, metallic) = (&self.energy[site.row], self.metallic[site.row]);
        let [lost_in, lost_out] = [to_light.z, to_eye.z].map(|cosine| energy.lost.at(cosine));
        let [left_in, left_out] = [to_light.z, to_eye.z].map(|cosine| energy.left_at_grazing(cosine));
        let [lost, left] = energy.average;
        let several = if lost > 0.0 { lost_in * lost_out / lost } else { 0.0 };
        let [below_in, below_out, below] = [[lost_in, left_in], [lost_out, left_out], [lost, left]]
            .map(|[lost, left]| 1.0 - energy.of_dielectric(lost, left));
        let diffuse = below_in * below_out / below;
        let again = energy.again(DIELECTRIC) * several;
        site.colour.map(|colour| {
            let dielectric = again + colour * diffuse;
            FRAC_1_PI * (dielectric + metallic * (energy.again(colour) * several - dielectric))
        })
    }
    // ANCHOR_END: principled

    /// The probability of sampling specular reflection of one scattering: its part of the albedo.
    #[inline(always)]
    fn specular_probability(&self, site: &Site, to_eye: DVec3) -> f64 {
        let (energy, metallic) = (&self.energy[site.row], self.metallic[site.row]);
        let (lost, left) = (energy.lost.at(to_eye.z), energy.left_at_grazing(to_eye.z));
        let below = 1.0 - energy.of_dielectric(lost, left);
        let once: f64 =
            self.at_normal_incidence(site).iter().map(|normal| normal * (1.0 - lost) + (1.0 - normal) * left).sum();
        let broad = |colour: &f64| {
            let dielectric = energy.again(DIELECTRIC) * lost + colour * below;
            dielectric + metallic * (energy.again(*colour) * lost - dielectric)
        };
        let whole = once + site.colour.iter().map(broad).sum::<f64>();
        if whole > 0.0 { (once / whole).clamp(0.0, 1.0) } else { 1.0 }
    }
}

impl Table for PrincipledTable {
    const NAME: &'static str = "principled materials";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let mut table = Self::default();
        for entity in entities_of_kind(scene, Self::KIND) {
            let own = scene.get::<Principled>(entity).copied().unwrap_or_default();
            Self::colour(&own, &kind_and_name(scene, Self::WORD, entity))?;
            table.push(own.metallic, own.roughness);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.alpha.len() * (2 * size_of::<f64>() + size_of::<Energy>())
    }
}

impl Bsdf for PrincipledTable {
    type Component = Principled;
    const COMPONENT: &'static str = "Principled";
    const WORD: &'static str = "principled";
    const NOUN: &'static str = "principled surface";
    const CLASS: BsdfClass = BsdfClass::Glossy;
    const TEXTURED: bool = true;

    fn colour(own: &Principled, who: &str) -> Result<[f64; 3], SceneError> {
        for (field, value) in [("metallic", own.metallic), ("roughness", own.roughness)] {
            if !(0.0..=1.0).contains(&value) {
                return Err(SceneError::new(who, field, number(value), "it must be a number from 0 to 1"));
            }
        }
        Ok(reflectance(who, "base_colour", own.base_colour)?.to_array())
    }

    #[inline(always)]
    fn eval(&self, site: &Site, to_light: DVec3, to_eye: DVec3) -> [f64; 3] {
        if to_light.z <= 0.0 || to_eye.z <= 0.0 {
            return [0.0; 3];
        }
        let (once, broad) = (self.once(site, to_light, to_eye), self.broad(site, to_light, to_eye));
        [0, 1, 2].map(|part| once[part] + broad[part])
    }

    #[inline(always)]
    fn pdf(&self, site: &Site, to_light: DVec3, to_eye: DVec3) -> f64 {
        let once = self.specular_probability(site, to_eye);
        let visible = visible_pdf(to_light, to_eye, self.alpha[site.row]);
        once * visible + (1.0 - once) * cosine_pdf(to_light.z)
    }

    /// By visible microfacet normals or by the cosine; `choice` selects which.
    #[inline(always)]
    fn sample(&self, site: &Site, to_eye: DVec3, numbers: [f64; 2], choice: f64) -> Option<BsdfSample> {
        let to_light = if choice < self.specular_probability(site, to_eye) {
            ggx_sample(to_eye, self.alpha[site.row], numbers)?.to_light
        } else {
            cosine_direction(numbers)
        };
        let pdf = self.pdf(site, to_light, to_eye);
        let weight = self.eval(site, to_light, to_eye).map(|brdf| brdf * to_light.z / pdf);
        (pdf > 0.0).then_some(BsdfSample { to_light, pdf, weight })
    }

    fn chooses(&self) -> bool {
        true
    }

    fn examples() -> Vec<Example<Principled>> {
        let of = |grey: f64, metallic, roughness| {
            let component = Principled { base_colour: Rgb::grey(grey), metallic, roughness };
            Example { component, lossless_to: (grey == 1.0).then_some(3e-3) }
        };
        let white = [0.1, 0.3, 0.5, 0.8, 1.0].into_iter();
        let white = white.flat_map(|roughness| [0.0, 0.5, 1.0].map(|metallic| of(1.0, metallic, roughness)));
        white.chain([of(0.5, 0.0, 0.0), of(0.2, 0.3, 0.4), of(0.7, 1.0, 0.7)]).collect()
    }
}
