use super::emissive::emissive_of;
use super::shape_kind::{is_shape, listed_kind, one_shape};
use super::{EmissiveTable, NO_ROW, ShapeTable, moves_while_open, shape_entities};
use crate::plan::{Census, Evidence, Table, counted};
use crate::scene::{Emissive, Placement, Rgb, SceneError, called};
use crate::shapes::Emitter;
use bevy_ecs::prelude::*;
use std::f64::consts::PI;

/// The number of equal parts into which the unit interval is divided for choosing a light.
const PARTS: u64 = 1 << 32;

/// Area lights that can be sampled, in spawn order of their shapes.
///
/// Planes are infinite, the area of a non-uniformly scaled sphere has no known uniform sampling, and moving shapes are
/// elsewhere for every ray; the emission of these is found by BSDF sampling only.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AreaLightTable {
    /// The shape of each light.
    pub emitter: Vec<Emitter>,
    /// The shape's number.
    pub shape: Vec<u32>,
    /// The radiance emitted at every point, linear Rec. 709.
    pub radiance: Vec<[f64; 3]>,
    /// Whether it is emitted only on the side of the shape's own normal.
    pub one_sided: Vec<bool>,
    /// The cumulative distribution in units of 2⁻³²: a light is chosen by fractions from its predecessor's value up to
    /// its own.
    pub until: Vec<u64>,
    /// The probability of choosing it: half in proportion to its power, half uniform, and at least 2⁻³².
    pub probability: Vec<f64>,
    /// The light of each shape; [`NO_ROW`] for a shape that is none.
    pub light_of_shape: Vec<u32>,
}

impl AreaLightTable {
    // ANCHOR: choose_light
    /// The light chosen by a 32-bit fraction.
    #[inline(always)]
    pub fn chosen(&self, fraction: u32) -> usize {
        self.until.partition_point(|&until| until <= u64::from(fraction))
    }
    // ANCHOR_END: choose_light
}

/// The probabilities of lights, half in proportion to power and half uniform: a dim light may still dominate where it
/// is near, or where metal reflects it.
///
/// Returns the cumulative distribution in parts of 2⁻³² and the probability of each light.
/// Each light gets one part, and the rest are divided by its fraction; whole parts make each probability exact to the
/// last bit, however dim the light.
pub(super) fn light_distribution(powers: &[f64]) -> (Vec<u64>, Vec<f64>) {
    let total: f64 = powers.iter().sum();
    let even = !(total > 0.0 && total.is_finite());
    let left = PARTS - powers.len() as u64;
    let uniform = 1.0 / powers.len() as f64;
    let fraction = |power: f64| if even { uniform } else { 0.5 * (power / total + uniform) };
    let mut parts: Vec<u64> = powers.iter().map(|&power| 1 + (fraction(power) * left as f64) as u64).collect();
    let largest = (0..parts.len()).max_by_key(|&light| parts[light]);
    let given: u64 = parts.iter().sum();
    if let Some(largest) = largest {
        parts[largest] = parts[largest] + PARTS - given;
    }
    let probability = parts.iter().map(|&parts| parts as f64 / PARTS as f64).collect();
    (parts.iter().scan(0, |sum, &parts| Some(add(sum, parts))).collect(), probability)
}

fn add(sum: &mut u64, parts: u64) -> u64 {
    *sum += parts;
    *sum
}

/// The luminance of linear Rec. 709 light.
pub fn luminance([r, g, b]: [f64; 3]) -> f64 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

impl Table for AreaLightTable {
    const NAME: &'static str = "lights with area";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (shapes, emissive) = (scene.table::<ShapeTable>()?, scene.table::<EmissiveTable>()?);
        let mut table = Self { light_of_shape: vec![NO_ROW; shapes.kind.len()], ..Self::default() };
        let mut powers = Vec::new();
        for (shape, &emits) in shapes.emissive.iter().enumerate().filter(|(_, emits)| **emits != NO_ROW) {
            let radiance = emissive.radiance[emits as usize].map(f64::from);
            if radiance == [0.0; 3] {
                continue;
            }
            let row = shapes.row[shape] as usize;
            let emitter = listed_kind(shapes.kind[shape]).map(|listed| (listed.emitter)(scene, row)).transpose()?;
            let Some(emitter) = emitter.flatten() else { continue };
            let one_sided = emissive.one_sided[emits as usize];
            let sides = if one_sided { 1.0 } else { 2.0 };
            powers.push(luminance(radiance) * emitter.area() * PI * sides);
            table.light_of_shape[shape] = table.emitter.len() as u32;
            table.emitter.push(emitter);
            table.shape.push(shape as u32);
            table.radiance.push(radiance);
            table.one_sided.push(one_sided);
        }
        (table.until, table.probability) = light_distribution(&powers);
        Ok(table)
    }

    fn bytes(&self) -> usize {
        let row = size_of::<Emitter>() + size_of::<[f64; 3]>() + size_of::<bool>() + 4 + 16;
        self.emitter.len() * row + self.light_of_shape.len() * size_of::<u32>()
    }
}

/// Evidence that a shape emits light and can be sampled; emitting shapes that cannot are mentioned too.
pub fn area_light_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| {
        let moves = moves_while_open(scene);
        let endless = |shape: Entity| {
            moves(shape) || !one_shape(scene, shape).is_ok_and(|listed| (listed.is_sampled)(scene, shape))
        };
        let shines = |shape: Entity| {
            let emissive = emissive_of(scene, shape).and_then(|entity| scene.get::<Emissive>(entity));
            emissive.is_some_and(|emissive| emissive.radiance != Rgb::BLACK)
        };
        let found = Evidence::of_kind::<With<Placement>>(scene, "light with area", |shape| {
            shines(shape) && is_shape(scene, shape) && !endless(shape)
        });
        let by_bsdf: Vec<String> = shape_entities(scene)
            .iter()
            .copied()
            .filter(|&shape| shines(shape) && endless(shape))
            .map(|shape| called(scene, shape))
            .collect();
        if by_bsdf.is_empty() {
            return found;
        }
        let names = by_bsdf.iter().take(3).cloned().collect::<Vec<_>>().join(", ");
        let shapes = counted(by_bsdf.len(), "shape that cannot be sampled");
        let reason = format!("{}; {shapes}, found by BSDF sampling only: {names}", found.reason);
        Evidence { reason, ..found }
    })
}
