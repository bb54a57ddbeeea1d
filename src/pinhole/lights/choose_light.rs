//! Choosing a light of a hierarchy for a surface, and the probability of the choice.

use super::light_hierarchy::{LightHierarchy, LightNode, STEP, WIDTH};
use crate::each::Each;
use glam::DVec3;
use multiversion::multiversion;

/// The number of equal parts into which the unit interval is divided.
const PARTS: u64 = 1 << 32;
/// The parts that are divided evenly among all lights: inside a large set a dim one may still dominate where it is near.
const EVEN: u64 = PARTS / 16;
/// By how much a cosine may be off, since the axes of lights are rounded to f32.
const MARGIN: f64 = 1e-5;
/// The square of the shortest distance to a light.
const NEAREST: f64 = 1e-290;
/// What grazing light counts for, as a fraction of the same light at normal incidence: a glossy surface reflects it, and
/// a shading normal may lean towards it.
const GRAZING: f64 = 0.125;

/// A surface for which a light is chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Receiver {
    /// A point on it, relative to the eye.
    pub position: DVec3,
    /// Its geometric normal, on the side that is lit.
    pub normal: DVec3,
    /// The number of bounces that lead to it; 0 for what the camera sees.
    pub depth: u32,
}

/// A light chosen for a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChosenLight {
    /// The light's number.
    pub light: u32,
    /// The probability of this choice, a whole number of 2⁻³².
    pub probability: f64,
}

impl LightHierarchy {
    /// The light that a 32-bit fraction chooses for a surface; no light where there is none.
    #[inline(always)]
    pub fn choose(&self, receiver: &Receiver, fraction: u32) -> Option<ChosenLight> {
        if self.is_empty() { None } else { Some(choose(&self.nodes, receiver, fraction)) }
    }

    /// The probability with which a light is chosen for a surface; 0 for one that emits nothing.
    #[inline(always)]
    pub fn probability(&self, receiver: &Receiver, light: usize) -> f64 {
        if self.is_empty() { 0.0 } else { probability(&self.nodes, receiver, light as u32, self.trail[light]) }
    }
}

/// How much each child of a node may contribute at a surface, up to a factor that is the same for all.
///
/// That is its strength over the square of its distance, times two cosines, both at the most favourable point of its
/// sphere: that of the angle between its normals and the direction to the surface, and that of the angle of incidence.
/// An angle is made smaller by another with the formula for the cosine of a difference, and never below 0.
#[inline(always)]
fn importance(node: &LightNode, receiver: &Receiver) -> [f64; WIDTH] {
    let Receiver { position, normal, .. } = *receiver;
    let position = position - DVec3::from(node.origin);
    let mut importance = [0.0; WIDTH];
    for (place, importance) in importance.iter_mut().enumerate() {
        let part = |vector: &[[f32; WIDTH]; 3], axis: usize| f64::from(vector[axis][place]);
        let (x, y, z) = (
            position.x - part(&node.centre, 0),
            position.y - part(&node.centre, 1),
            position.z - part(&node.centre, 2),
        );
        let radius = f64::from(node.radius[place]);
        let (squared, min) = (x * x + y * y + z * z, larger(radius * radius, NEAREST));
        let near = larger(squared, min);
        let inverse = 1.0 / near.sqrt();
        // Half the angle that the sphere subtends: all directions from inside.
        let outside = squared > min;
        let sine = if outside { radius * inverse } else { 0.0 };
        let cosine = if outside { (1.0 - sine * sine).sqrt() } else { -1.0 };

        let along = part(&node.axis, 0) * x + part(&node.axis, 1) * y + part(&node.axis, 2) * z;
        let along = along * inverse;
        let along = smaller(if node.both[place] > 0.0 { along.abs() } else { along }, 1.0);
        let (spread, edge) = (f64::from(node.spread[place]), f64::from(node.edge[place]));
        let beyond = less([along, root(along)], [spread, root(spread)]);
        let leaving = less(beyond, [cosine, sine])[0];

        let towards = smaller(-(normal.x * x + normal.y * y + normal.z * z) * inverse, 1.0);
        let arriving = less([towards, root(towards)], [cosine, sine])[0];

        let reaches = leaving >= edge - MARGIN && arriving >= -MARGIN;
        let weight = larger(leaving, MARGIN) * (GRAZING + (1.0 - GRAZING) * larger(arriving, 0.0));
        *importance = if reaches { node.strength[place] * weight / near } else { 0.0 };
    }
    importance
}

/// The sine of an angle from 0 to half a turn, by its cosine.
#[inline(always)]
fn root(cosine: f64) -> f64 {
    larger(1.0 - cosine * cosine, 0.0).sqrt()
}

/// The cosine and sine of one angle less another, or of 0 where the other is larger.
#[inline(always)]
fn less([cosine, sine]: [f64; 2], [of_other, sine_of_other]: [f64; 2]) -> [f64; 2] {
    let (differs, apart) = (cosine * of_other + sine * sine_of_other, sine * of_other - cosine * sine_of_other);
    if cosine >= of_other { [1.0, 0.0] } else { [differs, apart] }
}

/// Without the standard library's care for NaN, so that it is one instruction.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

#[inline(always)]
fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// How many of so many parts the children up to each get: the least for each of their lights, and the rest in
/// proportion to importance.
///
/// Parts are whole, so that probabilities are exact and no light's is 0, however much brighter another is.
#[inline(always)]
fn parts_until(node: &LightNode, receiver: &Receiver, parts: u64, min: u64) -> [u64; WIDTH] {
    let importance = importance(node, receiver);
    let mut until = [0.0; WIDTH];
    let mut sum = 0.0;
    for (until, importance) in until.iter_mut().zip(importance) {
        // NaN counts as nothing.
        sum += if importance > 0.0 { importance } else { 0.0 };
        *until = sum;
    }
    if sum == 0.0 {
        (until, sum) = (node.until.each(f64::from), f64::from(node.until[WIDTH - 1]));
    }
    let spare = (parts - min * u64::from(node.until[WIDTH - 1])) as f64;
    let mut ends = [0; WIDTH];
    for (place, end) in ends.iter_mut().enumerate() {
        *end = min * u64::from(node.until[place]) + (until[place] / sum * spare) as u64;
    }
    ends
}

/// The parts that every light below the root gets: one at least.
#[inline(always)]
fn least_parts(root: &LightNode) -> u64 {
    (EVEN / u64::from(root.until[WIDTH - 1])).max(1)
}

/// Descends from the root to a light: at each node the fraction selects a child by its parts, and what is left of the
/// fraction selects among the parts of that child.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn choose(nodes: &[LightNode], receiver: &Receiver, fraction: u32) -> ChosenLight {
    let (mut node, mut parts, mut left) = (&nodes[0], PARTS, u64::from(fraction));
    let min = least_parts(node);
    loop {
        let until = parts_until(node, receiver, parts, min);
        let place = until.iter().map(|&until| usize::from(until <= left)).sum::<usize>();
        let before = if place == 0 { 0 } else { until[place - 1] };
        (parts, left) = (until[place] - before, left - before);
        if node.count(place) == 1 {
            return ChosenLight { light: node.child[place], probability: parts as f64 / PARTS as f64 };
        }
        node = &nodes[node.child[place] as usize];
    }
}

/// Descends along a light's trail.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn probability(nodes: &[LightNode], receiver: &Receiver, light: u32, trail: u64) -> f64 {
    let (mut node, mut parts, mut trail) = (&nodes[0], PARTS, trail);
    let min = least_parts(node);
    loop {
        let until = parts_until(node, receiver, parts, min);
        let place = trail as usize % WIDTH;
        trail >>= STEP;
        parts = until[place] - if place == 0 { 0 } else { until[place - 1] };
        match node.count(place) {
            0 => return 0.0,
            1 if node.child[place] != light => return 0.0,
            1 => return parts as f64 / PARTS as f64,
            _ => node = &nodes[node.child[place] as usize],
        }
    }
}
