//! What single scattering on the microfacets of principled surfaces loses and leaves, at any roughness.

use super::{ByCosine, SMOOTHEST_METAL, multiple_scattering_albedo, single_scattering};
use std::sync::OnceLock;

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
        ByCosine::between(self.tables.map(|table| &table.lost), self.t, self.alpha, cosine)
    }

    /// What the factor (1 − cos θ)⁵ leaves at this cosine, less what it would leave of smooth microfacets.
    #[inline(always)]
    pub fn more_at_grazing(&self, cosine: f64) -> f64 {
        ByCosine::between(self.tables.map(|table| &table.grazing), self.t, self.alpha, cosine)
    }

    /// The hemispherical averages of what is lost, and of what the factor leaves.
    #[inline(always)]
    pub fn average(&self) -> [f64; 2] {
        let between = |[low, high]: [f64; 2]| (1.0 - self.t) * low + self.t * high;
        let over_square = between(self.tables.map(|table| table.lost_over_square));
        [self.alpha * self.alpha * over_square, between(self.tables.map(|table| table.average))]
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
mod tests {
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
