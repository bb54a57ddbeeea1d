//! How one of several lights is chosen.

use crate::lights::{LightBounds, LightHierarchy, Receiver};
use crate::scene::{SceneError, check_memory};

/// The number of equal parts into which the unit interval is divided for choosing a light.
const PARTS: u64 = 1 << 32;

/// How one of many lights without an area is chosen for a surface.
#[derive(Clone, Debug, PartialEq)]
pub enum LightChoice {
    /// By position and power, for lights that have a position.
    Hierarchy(LightHierarchy),
    /// By power alone.
    Power {
        /// The cumulative distribution in units of 2⁻³².
        until: Vec<u64>,
        /// The probability of each light.
        probability: Vec<f64>,
    },
}

impl LightChoice {
    /// The light that a 32-bit fraction chooses for a surface, and the probability of that choice.
    #[inline(always)]
    pub fn choose(&self, receiver: &Receiver, fraction: u32) -> (usize, f64) {
        match self {
            Self::Hierarchy(hierarchy) => {
                hierarchy.choose(receiver, fraction).map_or((0, 0.0), |own| (own.light as usize, own.probability))
            }
            Self::Power { until, probability } => {
                let light = until.partition_point(|&until| until <= u64::from(fraction));
                (light, probability[light])
            }
        }
    }

    /// The memory of its arrays, in bytes.
    pub fn bytes(&self) -> usize {
        match self {
            Self::Hierarchy(hierarchy) => hierarchy.bytes(),
            Self::Power { until, .. } => until.len() * 16,
        }
    }
}

/// The hierarchy of so many lights.
///
/// Errors: more lights than there is memory for.
pub(super) fn hierarchy_of_lights(
    noun: &str,
    lights: usize,
    bounds_of: impl Fn(usize) -> Option<LightBounds> + Sync,
) -> Result<LightHierarchy, SceneError> {
    let needed = LightHierarchy::bytes_to_build(lights as u64);
    check_memory(needed).map_err(|too_little| {
        let accepted = format!("a hierarchy of them {too_little}; let fewer of them emit light");
        SceneError::new(noun, "number", lights, accepted)
    })?;
    Ok(LightHierarchy::build(lights, bounds_of))
}

/// The probabilities of lights, half in proportion to power and half uniform: a dim light may still dominate where it
/// is near, or where metal reflects it.
///
/// Returns the cumulative distribution in parts of 2⁻³² and the probability of each light.
/// Each light gets one part, and the rest are divided by its fraction; whole parts make each probability exact to the
/// last bit, however dim the light.
/// A light whose power is NaN, such as a triangle without an area, gets none.
pub(super) fn light_distribution(powers: &[f64]) -> (Vec<u64>, Vec<f64>) {
    let lit = || powers.iter().filter(|power| !power.is_nan());
    let (total, count) = (lit().sum::<f64>(), lit().count());
    let even = !(total > 0.0 && total.is_finite());
    let left = PARTS - count as u64;
    let uniform = 1.0 / count as f64;
    let fraction = |power: f64| if even { uniform } else { 0.5 * (power / total + uniform) };
    let parts_of = |power: f64| if power.is_nan() { 0 } else { 1 + (fraction(power) * left as f64) as u64 };
    let mut parts: Vec<u64> = powers.iter().map(|&power| parts_of(power)).collect();
    let largest = (0..parts.len()).max_by_key(|&light| parts[light]);
    let given: u64 = parts.iter().sum();
    if let Some(largest) = largest.filter(|_| count > 0) {
        parts[largest] = parts[largest] + PARTS - given;
    }
    let probability = parts.iter().map(|&parts| parts as f64 / PARTS as f64).collect();
    (parts.iter().scan(0, |sum, &parts| Some(add(sum, parts))).collect(), probability)
}

fn add(sum: &mut u64, parts: u64) -> u64 {
    *sum += parts;
    *sum
}
