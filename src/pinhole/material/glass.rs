use super::{
    Bsdf, BsdfClass, Example, Interior, Parameters, ShadingContext, SpecularSample, Transport, fresnel,
    mirror_direction, refract,
};
use crate::check::{light_colour, number};
use crate::plan::{Census, Table};
use crate::scene::{Glass, SceneError};
use glam::DVec3;

/// The least accepted index of refraction, and the reciprocal of the greatest.
pub(super) const MIN_INDEX: f64 = 1e-3;

/// Whether a number is accepted as an index of refraction.
pub(super) fn is_index(ior: f64) -> bool {
    (MIN_INDEX..=1.0 / MIN_INDEX).contains(&ior)
}

// ANCHOR: glass_samples
/// Both directions at a smooth surface to a medium of relative index η: specular reflection, and refraction with the
/// rest of the light.
///
/// A beam that enters a denser medium becomes narrower, so its radiance in there is η² times as large; seen from this
/// side, the factor is 1/η².
/// For total internal reflection, the second sample has weight 0.
#[inline(always)]
pub fn glass_samples(direction: DVec3, normal: DVec3, eta: f64) -> [SpecularSample; 2] {
    let reflected = fresnel((-direction.dot(normal)).max(0.0), eta);
    let mirrored = mirror_direction(direction, normal);
    let mirrored = SpecularSample { direction: mirrored, weight: [reflected; 3], through: false };
    let bent = refract(direction, normal, eta).map_or_else(SpecularSample::default, |direction| SpecularSample {
        direction,
        weight: [(1.0 - reflected) / (eta * eta); 3],
        through: true,
    });
    [mirrored, bent]
}
// ANCHOR_END: glass_samples

// ANCHOR: glass_event
/// One of the two at random: reflection with the reflectance as its probability, by a number in [0, 1); divided by the
/// probability, the weight is 1 for reflection and 1/η² for refraction.
#[inline(always)]
pub fn glass_event([mirrored, bent]: [SpecularSample; 2], eta: f64, number: f64) -> SpecularSample {
    if number < mirrored.weight[0] || !bent.through {
        SpecularSample { weight: [1.0; 3], ..mirrored }
    } else {
        SpecularSample { weight: [1.0 / (eta * eta); 3], ..bent }
    }
}
// ANCHOR_END: glass_event

// ANCHOR: layered_reflectance
/// The reflectance of parallel surfaces that are crossed together, each of which reflects one of these fractions.
///
/// Light goes to and fro between two of them: R = R₁ + (1 − R₁)² R₂ (1 + R₁R₂ + …), by which the ratios R / (1 − R) of
/// all surfaces add up.
/// The layers between them are thick beside a wavelength, so that light does not interfere, and thin beside all else, so
/// that nothing is absorbed in them.
#[inline]
pub fn layered_reflectance(reflectances: impl Iterator<Item = f64>) -> f64 {
    let ratio: f64 = reflectances.map(|reflected| reflected / (1.0 - reflected)).sum();
    if ratio.is_finite() { ratio / (1.0 + ratio) } else { 1.0 }
}
// ANCHOR_END: layered_reflectance

/// Smooth glass, whose only parameter is the relative index of refraction at each surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SmoothGlass;

impl Table for SmoothGlass {
    const NAME: &'static str = "smooth glass";

    fn extract(_: &Census<'_>) -> Result<Self, SceneError> {
        Ok(Self)
    }

    fn bytes(&self) -> usize {
        0
    }
}

/// Index, absorption and priority of a dielectric, checked.
pub(super) fn checked_interior(who: &str, glass: &Glass) -> Result<Interior, SceneError> {
    let Glass { ior, absorption, priority } = *glass;
    if !is_index(ior) {
        let accepted = format!("it must be a number from {MIN_INDEX} to {}", 1.0 / MIN_INDEX);
        return Err(SceneError::new(who, "ior", number(ior), accepted));
    }
    Ok(Interior { ior, absorption: light_colour(who, "absorption", absorption)?.to_array(), priority })
}

impl Bsdf for SmoothGlass {
    type Component = Glass;
    const COMPONENT: &'static str = "Glass";
    const WORD: &'static str = "glass";
    const NOUN: &'static str = "glass surface";
    const CLASS: BsdfClass = BsdfClass::Specular;
    const TRANSMITS: bool = true;

    fn parameters(glass: &Glass, who: &str) -> Result<Parameters, SceneError> {
        checked_interior(who, glass).map(|_| Parameters::default())
    }

    fn interior(glass: &Glass, who: &str) -> Result<Option<Interior>, SceneError> {
        checked_interior(who, glass).map(Some)
    }

    fn chooses(&self) -> bool {
        true
    }

    #[inline(always)]
    fn specular_directions(&self, context: &ShadingContext, direction: DVec3, normal: DVec3) -> [SpecularSample; 2] {
        let [mut mirrored, mut bent] = glass_samples(direction, normal, context.eta);
        if let Some(reflected) = context.reflectance {
            mirrored.weight = [reflected; 3];
            bent.weight = [if bent.through { (1.0 - reflected) / (context.eta * context.eta) } else { 0.0 }; 3];
        }
        [mirrored, bent]
    }

    /// A ray from a light keeps all of its power, where radiance would get its 1/η² (Veach 1997, 5.2).
    #[inline(always)]
    fn sample_specular(
        &self,
        context: &ShadingContext,
        direction: DVec3,
        normal: DVec3,
        number: f64,
    ) -> SpecularSample {
        let sample = glass_event(self.specular_directions(context, direction, normal), context.eta, number);
        match context.transport {
            Transport::Radiance => sample,
            Transport::Importance => SpecularSample { weight: [1.0; 3], ..sample },
        }
    }

    fn examples() -> Vec<Example<Glass>> {
        vec![Example { component: Glass::default(), lossless_to: None }]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws as Numbers;

    /// The mean of the sampled weights is that of the two rays, and no light is lost or gained.
    #[test]
    fn sampling_agrees_with_splitting_and_nothing_is_lost() {
        const STEPS: u32 = 4000;
        for index in 0..400 {
            let mut draws = Numbers::new(1951, index);
            let (normal, eta) = (draws.unit_vector().normalize(), draws.power_of_ten(-0.5, 0.5));
            let direction = (draws.unit_vector_across(normal) * draws.between(0.0, 3.0) - normal).normalize();
            let [mirrored, bent] = glass_samples(direction, normal, eta);
            assert!((mirrored.weight[0] + bent.weight[0] * eta * eta - 1.0).abs() < 1e-12 || !bent.through);
            let mut sums = [0.0; 2];
            for step in 0..STEPS {
                let sample = glass_event([mirrored, bent], eta, (f64::from(step) + 0.5) / f64::from(STEPS));
                sums[usize::from(sample.through)] += sample.weight[0] / f64::from(STEPS);
                assert_eq!(sample.direction, if sample.through { bent.direction } else { mirrored.direction });
            }
            let step = 1.0 / f64::from(STEPS) / (eta * eta).min(1.0);
            assert!(
                (sums[0] - mirrored.weight[0]).abs() <= step && (sums[1] - bent.weight[0]).abs() <= step,
                "{index}"
            );
        }
        eprintln!("glass: 400 surfaces, sampled and split");
    }

    /// In and out again through parallel faces, the direction comes back and the factors 1/η² and η² cancel.
    #[test]
    fn through_a_pane_radiance_is_unscaled() {
        for index in 0..2000 {
            let mut draws = Numbers::new(1952, index);
            let (normal, eta) = (draws.unit_vector().normalize(), draws.between(1.0, 3.0));
            let direction = (draws.unit_vector_across(normal) * draws.between(0.0, 3.0) - normal).normalize();
            let [_, inward] = glass_samples(direction, normal, eta);
            let [mirrored, outward] = glass_samples(inward.direction, normal, 1.0 / eta);
            assert!((outward.direction - direction).length() < 1e-13, "{index}");
            let once = 1.0 - mirrored.weight[0];
            assert!(
                (inward.weight[0] * outward.weight[0] - once * once).abs() < 1e-12,
                "{index}: both faces transmit the same fraction"
            );
        }
        eprintln!("panes: 2000 paths through, none bent, none brightened");
    }

    /// The closed forms of one surface, of a pane, and of a pile of plates (Stokes 1862): R = 2mF / (1 + (2m − 1)F).
    #[test]
    fn layers_reflect_as_a_pile_of_plates() {
        for (plates, reflected) in [(1, 0.04), (3, 0.04), (7, 0.3), (2, 0.0)] {
            let surfaces = f64::from(2 * plates);
            let pile = surfaces * reflected / (1.0 + (surfaces - 1.0) * reflected);
            let added = layered_reflectance((0..2 * plates).map(|_| reflected));
            assert!((added - pile).abs() < 1e-15, "{plates} plates: {added}");
        }
        assert_eq!(layered_reflectance([0.1, 1.0].into_iter()), 1.0, "nothing goes past total reflection");
    }

    #[test]
    fn a_surface_between_equals_is_none() {
        let direction = DVec3::new(0.6, 0.0, -0.8);
        let sample = glass_event(glass_samples(direction, DVec3::Z, 1.0), 1.0, 0.0);
        assert!(sample.through && sample.weight[0] == 1.0 && (sample.direction - direction).length() < 1e-15);
    }
}
