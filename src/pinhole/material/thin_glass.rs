use super::bsdf::entities_of_kind;
use super::{Bsdf, BsdfClass, Example, Named, Parameters, ShadingContext, SpecularSample, fresnel, mirror_direction};
use crate::check::{kind_and_name, number, reflectance};
use crate::each::Each;
use crate::plan::{Census, Table};
use crate::scene::{SceneError, ThinGlass};
use glam::DVec3;

/// The greatest index of refraction.
const MAX_INDEX: f64 = 1000.0;

/// The fraction of light that a pane of index η reflects, at a cosine to its normal: its first face reflects F, and of
/// what enters some comes back after each reflection at the second, F + (1 − F)² F (1 + F² + F⁴ + …) = 2F/(1 + F).
///
/// What it does not reflect is transmitted: (1 − F)/(1 + F).
#[inline(always)]
pub fn pane_reflectance(cosine: f64, eta: f64) -> f64 {
    let face = fresnel(cosine, eta);
    2.0 * face / (1.0 + face)
}

/// Thin panes of glass, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ThinGlassTable {
    /// The index of refraction of each.
    pub ior: Vec<f64>,
    /// The factor of the transmitted light: red, green, blue, from 0 to 1.
    pub colour: Vec<[f64; 3]>,
}

impl Table for ThinGlassTable {
    const NAME: &'static str = "thin glass";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let mut table = Self::default();
        for entity in entities_of_kind(scene, Self::KIND) {
            let own = scene.get::<ThinGlass>(entity).copied().unwrap_or_default();
            Self::parameters(&own, &kind_and_name(scene, Self::WORD, entity))?;
            table.ior.push(own.ior);
            table.colour.push(own.colour.to_array());
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.ior.len() * size_of::<[f64; 4]>()
    }
}

impl Bsdf for ThinGlassTable {
    type Component = ThinGlass;
    const COMPONENT: &'static str = "ThinGlass";
    const WORD: &'static str = "thin_glass";
    const NOUN: &'static str = "thin glass surface";
    const CLASS: BsdfClass = BsdfClass::Specular;
    const TRANSMITS: bool = true;

    fn parameters(own: &ThinGlass, who: &str) -> Result<Parameters, SceneError> {
        if !(1.0..=MAX_INDEX).contains(&own.ior) {
            let accepted = format!("it must be a number from 1 to {MAX_INDEX}");
            return Err(SceneError::new(who, "ior", number(own.ior), accepted));
        }
        reflectance(who, "colour", own.colour).map(|_| Parameters::default())
    }

    fn chooses(&self) -> bool {
        true
    }

    /// Reflection, and what goes straight on with the glass's colour.
    #[inline(always)]
    fn specular_directions(&self, context: &ShadingContext, direction: DVec3, normal: DVec3) -> [SpecularSample; 2] {
        let reflected = pane_reflectance((-direction.dot(normal)).max(0.0), self.ior[context.row]);
        let mirrored = mirror_direction(direction, normal);
        let through = self.colour[context.row].each(|part| (1.0 - reflected) * part);
        [
            SpecularSample { direction: mirrored, weight: [reflected; 3], through: false },
            SpecularSample { direction, weight: through, through: true },
        ]
    }

    /// One of the two, reflection with the reflectance as its probability.
    #[inline(always)]
    fn sample_specular(
        &self,
        context: &ShadingContext,
        direction: DVec3,
        normal: DVec3,
        number: f64,
    ) -> SpecularSample {
        let [mirrored, straight] = self.specular_directions(context, direction, normal);
        match number < mirrored.weight[0] {
            true => SpecularSample { weight: [1.0; 3], ..mirrored },
            false => SpecularSample { weight: self.colour[context.row], ..straight },
        }
    }

    fn examples() -> Vec<Example<ThinGlass>> {
        vec![Example { component: ThinGlass::default(), lossless_to: None }]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;

    /// Light goes to and fro between the two faces until next to nothing is left of it.
    #[test]
    fn a_pane_reflects_what_its_two_faces_do_in_turns() {
        for index in 0..1000 {
            let mut draws = Draws::new(1953, index);
            let (cosine, eta) = (draws.between(0.01, 1.0), draws.between(1.0, 3.0));
            let face = fresnel(cosine, eta);
            let (mut within, mut back, mut beyond) = (1.0 - face, face, 0.0);
            for bounce in 0..2000 {
                let out = if bounce % 2 == 0 { &mut beyond } else { &mut back };
                *out += within * (1.0 - face);
                within *= face;
            }
            let reflected = pane_reflectance(cosine, eta);
            assert!((reflected - back).abs() < 1e-9, "{index}: {reflected} for {back}");
            assert!((1.0 - reflected - beyond).abs() < 1e-9, "{index}");
        }
    }

    /// The mean of the samples is the two directions together, and only the colour takes light away.
    #[test]
    fn sampling_agrees_with_splitting() {
        let table = ThinGlassTable { ior: vec![1.5], colour: vec![[1.0, 0.5, 0.0]] };
        let (direction, normal) = (DVec3::new(0.8, 0.0, -0.6), DVec3::Z);
        let context = ShadingContext::opaque(0, Parameters::coloured([0.0; 3]));
        let both = table.specular_directions(&context, direction, normal);
        assert!(both[1].through && both[1].direction == direction && !both[0].through);
        let mut sums = [[0.0; 3]; 2];
        const STEPS: u32 = 100_000;
        for step in 0..STEPS {
            let number = (f64::from(step) + 0.5) / f64::from(STEPS);
            let sample = table.sample_specular(&context, direction, normal, number);
            for (sum, part) in sums[usize::from(sample.through)].iter_mut().zip(sample.weight) {
                *sum += part / f64::from(STEPS);
            }
        }
        for (sum, sample) in sums.iter().zip(both) {
            let apart = (0..3).map(|part| (sum[part] - sample.weight[part]).abs()).fold(0.0, f64::max);
            assert!(apart < 2.0 / f64::from(STEPS), "{sum:?} for {:?}", sample.weight);
        }
        assert!((both[0].weight[0] + both[1].weight[0] - 1.0).abs() < 1e-15);
    }
}
