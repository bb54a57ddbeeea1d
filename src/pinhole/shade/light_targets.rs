//! Sampling directions in which light leaves towards mirrors and glass.

use crate::extract::{MOST_TARGETS, Target};
use crate::shapes::emitter::{cone_direction, cone_versine};
use crate::shapes::l1_norm;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// The rounding error of a ray in f32, relative to its origin and to the distance travelled.
const OF_PLACE: f64 = 1.0 / (1_u64 << 21) as f64;

/// The axis of the cone that a sphere subtends from a point, and 1 − cos of its half angle; all directions from inside.
///
/// The sphere is enlarged by as much as a ray in f32 may miss it by.
#[inline(always)]
fn cone_to(target: &Target, from: DVec3) -> (DVec3, f64) {
    let to = target.centre - from;
    let dd = to.length_squared();
    let distance = dd.sqrt();
    let radius = target.radius + (l1_norm(from) + distance) * OF_PLACE;
    if distance <= radius { (DVec3::Z, 2.0) } else { (to / distance, cone_versine(radius * radius / dd)) }
}

// ANCHOR: direction_to_targets
/// A direction to one of the targets, and 1 over its pdf, in sr; none where the targets subtend `limit` sr or more, or
/// there is none.
///
/// A target is chosen in proportion to its solid angle, and a direction uniformly in its cone.
/// In the cone of a single target the pdf is 1 over the sum Ω of all solid angles; where n cones overlap it is n / Ω.
#[inline(always)]
pub fn direction_to_targets(
    targets: &[Target],
    from: DVec3,
    limit: f64,
    choice: f64,
    u: [f64; 2],
) -> Option<(DVec3, f64)> {
    let mut cones = [(DVec3::Z, 0.0); MOST_TARGETS];
    let cones = &mut cones[..targets.len()];
    cones.iter_mut().zip(targets).for_each(|(cone, target)| *cone = cone_to(target, from));
    let all = TAU * cones.iter().map(|(_, whole)| whole).sum::<f64>();
    if all == 0.0 || all >= limit {
        return None;
    }
    let (mut left, mut chosen) = (choice * all, 0);
    while chosen + 1 < cones.len() && left >= TAU * cones[chosen].1 {
        left -= TAU * cones[chosen].1;
        chosen += 1;
    }
    let (axis, whole) = cones[chosen];
    let direction = cone_direction(axis, whole, u);
    let others = cones
        .iter()
        .enumerate()
        .filter(|(number, (axis, whole))| *number != chosen && 0.5 * (direction - *axis).length_squared() <= *whole);
    Some((direction, all / (1 + others.count()) as f64))
}
// ANCHOR_END: direction_to_targets

/// Where the targets subtend more than this many sr, sampling directions towards them gains nothing.
pub const MAX_TARGETS_SOLID_ANGLE: f64 = PI;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::ray_aim::Draws;
    use crate::shapes::emitter::sphere_direction;

    /// Directions to targets, each weighted by 1 over its pdf, cover the union of the cones as uniform directions do.
    #[test]
    fn directions_to_targets_have_their_pdf() {
        const TRIED: u64 = 40_000;
        for index in 0..12 {
            let mut draws = Draws::new(2711, index);
            let targets: Vec<Target> = (0..3)
                .map(|_| Target { centre: draws.unit_vector().normalize() * 3.0, radius: draws.between(0.2, 2.0) })
                .collect();
            let within = |direction: DVec3| {
                targets.iter().any(|target| {
                    let (axis, whole) = cone_to(target, DVec3::ZERO);
                    0.5 * (direction - axis).length_squared() <= whole
                })
            };
            // The integrals of a smooth function of the direction, and of 1, agree with those over uniform directions.
            let function = |direction: DVec3| DVec3::new(1.0, 1.0 + direction.x, libm::exp(2.0 * direction.y));
            let (mut even, mut sampled, mut squares) = (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
            for _ in 0..TRIED {
                let direction = sphere_direction([draws.unit(), draws.unit()]);
                let value = function(direction) * if within(direction) { 4.0 * PI } else { 0.0 };
                (even, squares) = (even + value, squares + value * value);
                let (choice, u) = (draws.unit(), [draws.unit(), draws.unit()]);
                let sample = direction_to_targets(&targets, DVec3::ZERO, f64::INFINITY, choice, u);
                let (direction, weight) = sample.expect("targets");
                let value = function(direction) * weight;
                (sampled, squares) = (sampled + value, squares + value * value);
            }
            let n = TRIED as f64;
            let error = (squares / (n * n)).map(f64::sqrt);
            let off = (even - sampled) / n / error;
            assert!(off.abs().max_element() < 4.0, "{index}: {off}");
        }
        eprintln!("directions to targets: 12 sets of 3, {TRIED} each");
    }
}
