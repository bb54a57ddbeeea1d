//! Sampling the points and directions in which light leaves emitters.

use super::cone_versine;
use crate::extract::{Emitter, MOST_TARGETS, Parallelogram, Target};
use glam::{DMat3, DVec3};
use std::f64::consts::{PI, TAU};

/// The probability of starting a ray inside a closed shape that emits on both sides, where there is seldom anything.
const INWARD: f64 = 1.0 / 16.0;

/// A sampled point at which a ray leaves a light.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LeavingPoint {
    /// The position in render space.
    pub position: DVec3,
    /// The unit normal of the side that the ray starts on.
    pub normal: DVec3,
    /// Power per unit of radiance and cosine: the area over the probability of the side.
    pub area: f64,
    /// The largest magnitude in the computation of its position, for its error bound.
    pub size: f64,
}

/// Samples a point on an emitter uniformly over its area, and one of its sides by `side`.
#[inline(always)]
pub fn leaving_point(emitter: &Emitter, one_sided: bool, u: [f64; 2], side: f64) -> LeavingPoint {
    let (position, normal, size) = match emitter {
        Emitter::Sphere { centre, radius } => {
            let normal = sphere_direction(u);
            (*centre + *radius * normal, normal, l1_norm(*centre) + radius)
        }
        Emitter::Rectangle(planar) => {
            (planar_point(planar, [2.0 * u[0] - 1.0, 2.0 * u[1] - 1.0]), planar.normal, magnitude(planar))
        }
        Emitter::Disk(planar) => {
            let (radius, (sine, cosine)) = (u[0].sqrt(), libm::sincos(TAU * u[1]));
            (planar_point(planar, [radius * cosine, radius * sine]), planar.normal, magnitude(planar))
        }
        Emitter::Triangle { corners: [a, b, c], normal } => {
            let root = u[0].sqrt();
            let at = *a * (1.0 - root) + *b * (root * (1.0 - u[1])) + *c * (root * u[1]);
            (at, *normal, [a, b, c].into_iter().map(|corner| l1_norm(*corner)).fold(0.0, f64::max))
        }
        Emitter::Cuboid(cuboid) => {
            let area =
                |axis: usize| cuboid.half_edges[(axis + 1) % 3].cross(cuboid.half_edges[(axis + 2) % 3]).length();
            let areas = [area(0), area(1), area(2)];
            let all: f64 = areas.iter().sum();
            // The first number selects one of twice three faces, and its remainder is uniform again.
            let mut left = u[0] * 2.0;
            let sign = if left < 1.0 { 1.0 } else { -1.0 };
            left = left.fract() * all;
            let mut axis = 0;
            while axis < 2 && left >= areas[axis] {
                left -= areas[axis];
                axis += 1;
            }
            let along = [2.0 * (left / areas[axis]).min(1.0) - 1.0, 2.0 * u[1] - 1.0];
            let edges = [cuboid.half_edges[(axis + 1) % 3], cuboid.half_edges[(axis + 2) % 3]];
            let at = cuboid.centre + sign * cuboid.half_edges[axis] + along[0] * edges[0] + along[1] * edges[1];
            let size = l1_norm(cuboid.centre) + cuboid.half_edges.map(l1_norm).iter().sum::<f64>();
            (at, sign * cuboid.normals[axis], size)
        }
    };
    let is_closed = matches!(emitter, Emitter::Sphere { .. } | Emitter::Cuboid(_));
    let away = match (one_sided, is_closed) {
        (true, _) => 0.0,
        (_, true) => INWARD,
        _ => 0.5,
    };
    let (normal, random) = if side < away { (-normal, away) } else { (normal, 1.0 - away) };
    LeavingPoint { position, normal, area: emitter.area() / random, size }
}

fn planar_point(planar: &Parallelogram, [x, y]: [f64; 2]) -> DVec3 {
    planar.centre + x * planar.half_edges[0] + y * planar.half_edges[1]
}

fn magnitude(planar: &Parallelogram) -> f64 {
    l1_norm(planar.centre) + l1_norm(planar.half_edges[0]) + l1_norm(planar.half_edges[1])
}

fn l1_norm(v: DVec3) -> f64 {
    v.x.abs() + v.y.abs() + v.z.abs()
}

/// A direction uniform over the sphere.
#[inline(always)]
pub fn sphere_direction(u: [f64; 2]) -> DVec3 {
    cone_direction(DVec3::Z, 2.0, u)
}

/// A direction uniform over the cone about an axis, `whole` being 1 − cos of its half angle.
#[inline(always)]
pub fn cone_direction(axis: DVec3, whole: f64, u: [f64; 2]) -> DVec3 {
    let versine = u[0] * whole;
    let sine = (versine * (2.0 - versine)).max(0.0).sqrt();
    let (right, up) = axis.any_orthonormal_pair();
    let (up_part, right_part) = libm::sincos(TAU * u[1]);
    DMat3::from_cols(right, up, axis) * DVec3::new(sine * right_part, sine * up_part, 1.0 - versine)
}

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
    use crate::extract::EmittingCuboid;
    use crate::measure::ray_aim::Draws;

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

    /// Points are uniform over the area: the sum of their cosines to a distant plane gives the shape's projected area.
    #[test]
    fn points_of_lights_are_spread_over_their_area() {
        const TRIED: u64 = 40_000;
        let planar = Parallelogram::new(DVec3::new(1.0, 2.0, 3.0), [DVec3::X * 2.0, DVec3::Z], DVec3::Y);
        let cuboid = EmittingCuboid::new(DVec3::ONE, [DVec3::X, DVec3::Y * 2.0, DVec3::Z * 0.5]);
        let triangle = [DVec3::ZERO, DVec3::X * 3.0, DVec3::Y * 2.0];
        let emitters = [
            (Emitter::Sphere { centre: DVec3::ONE, radius: 2.0 }, DVec3::ONE),
            (Emitter::Rectangle(planar), planar.centre),
            (Emitter::Disk(planar), planar.centre),
            (Emitter::Triangle { corners: triangle, normal: DVec3::Z }, DVec3::new(1.0, 2.0 / 3.0, 0.0)),
            (Emitter::Cuboid(cuboid), DVec3::ONE),
        ];
        for (number, (emitter, middle)) in emitters.into_iter().enumerate() {
            for one_sided in [true, false] {
                let mut draws = Draws::new(2712, number as u64);
                let (mut mean, mut up, mut area) = (DVec3::ZERO, DVec3::ZERO, 0.0);
                for _ in 0..TRIED {
                    let (u, side) = ([draws.unit(), draws.unit()], draws.unit());
                    let point = leaving_point(&emitter, one_sided, u, side);
                    assert!((point.normal.length() - 1.0).abs() < 1e-12);
                    let outward = emitter.faces(point.position + 1e-6 * point.normal);
                    assert!(outward || !one_sided, "{number}");
                    mean += point.position - middle;
                    up += point.normal.abs() * point.area;
                    area += point.area;
                }
                let sides = if one_sided { 1.0 } else { 2.0 };
                let n = TRIED as f64;
                assert!((mean / n).abs().max_element() < 0.04, "{number}: {}", mean / n);
                assert!((area / n / emitter.area() / sides - 1.0).abs() < 0.06, "{number}: {}", area / n);
                if let (Emitter::Cuboid(_), true) = (&emitter, one_sided) {
                    // Faces across x, y and z: 4, 1 and 8 units, each twice.
                    assert!((up / n - DVec3::new(8.0, 4.0, 16.0)).abs().max_element() < 0.5, "{}", up / n);
                }
            }
        }
    }
}
