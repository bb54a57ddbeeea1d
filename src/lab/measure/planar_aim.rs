//! Disks and rectangles at any tilt and skew, and rays aimed where they are hard to check.

use super::ray_aim::{AimedRay, BAND_IN_QUANTA, Draws, rounded_ray};
use glam::{DVec3, Vec3};
use pinhole::shapes::Planar;

/// One direction quantum: the spacing of f32 numbers just below 1.
const QUANTUM: f64 = 1.0 / (1_u64 << 24) as f64;

/// Where on a planar shape a ray is aimed, up to a few direction quanta.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum At {
    /// Within a disk, and so within a rectangle.
    Inside,
    /// At the edge of a disk.
    Rim,
    /// At the edge of a rectangle.
    Edge,
    /// At a corner of a rectangle.
    Corner,
}

/// What a case draws.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// The case.
    pub seed: u64,
    /// Where rays go.
    pub at: At,
    /// Sizes, and the places of those that are not seen from the eye, are 10^U(−this, this).
    pub sizes: f64,
    /// The slope at which rays come in is 10 to minus this, or more.
    pub flattest: f64,
    /// Rays start 10^U of these two sizes away.
    pub away: [f64; 2],
    /// Whether all rays start at the eye.
    pub from_eye: bool,
}

/// A ray and the shape that it is aimed at.
#[must_use]
pub fn planar_shot(view: View, index: u64) -> (AimedRay, Planar) {
    let mut draws = Draws::new(view.seed, index);
    let size = draws.power_of_ten(-view.sizes, view.sizes);
    let normal = draws.unit_vector();
    let x = draws.unit_vector_across(normal);
    // The edges at any angle from 17 to 163 degrees, one up to ten times as long as the other.
    let z = normal.cross(x) * draws.between(0.3, 1.0) + x * draws.between(-1.0, 1.0);
    let half_edges = [x * size, z * (size * draws.power_of_ten(-1.0, 0.0))];

    let slope = draws.power_of_ten(-view.flattest, 0.0);
    let side = if draws.unit() < 0.5 { 1.0 } else { -1.0 };
    let incoming = (draws.unit_vector_across(normal) - normal * (slope * side)).normalize();
    let [u, v] = spot(view.at, &mut draws);
    let target = half_edges[0] * u + half_edges[1] * v;
    let start = target - incoming * (size * draws.power_of_ten(view.away[0], view.away[1]));
    let centre = if view.from_eye { -start } else { draws.unit_vector() * draws.power_of_ten(-view.sizes, view.sizes) };
    let origin = (centre + start).as_vec3();
    // A normal that f32 holds tilts the shape a little; aimed at its own edges, rays are as hard as they get.
    let planar = Planar::new(centre, normal, half_edges);
    let aimed = planar.map_or(target, |planar| planar.half_edges()[0] * u + planar.half_edges()[1] * v);
    let quanta = draws.between(-BAND_IN_QUANTA, BAND_IN_QUANTA) * QUANTUM;
    let towards = (centre + aimed - origin.as_dvec3()).normalize();
    let ray = rounded_ray(origin, towards + draws.unit_vector_across(towards) * quanta);
    (ray, planar.unwrap_or(ANY))
}

/// Stands in where edges span no area, which none of the above do.
const ANY: Planar =
    Planar { centre: DVec3::ZERO, normal: DVec3::Y, along: [DVec3::X, DVec3::Z], norm: std::f64::consts::SQRT_2 };

/// The coordinates of a point to aim at.
fn spot(at: At, draws: &mut Draws) -> [f64; 2] {
    let (fraction, angle) = (draws.between(-1.0, 1.0), draws.between(0.0, std::f64::consts::TAU));
    let mut sign = || if draws.unit() < 0.5 { 1.0 } else { -1.0 };
    match at {
        At::Inside => [fraction * libm::cos(angle), fraction * libm::sin(angle)].map(|part| part * 0.99),
        At::Rim => [libm::cos(angle), libm::sin(angle)],
        At::Edge if fraction > 0.0 => [sign(), 2.0 * fraction - 1.0],
        At::Edge => [2.0 * fraction + 1.0, sign()],
        At::Corner => [sign(), sign()],
    }
}

/// A ray along or in the plane of a shape whose normal is an axis: nothing to hit, whatever the signs of its zeros.
#[must_use]
pub fn edge_on(index: u64) -> (AimedRay, Planar) {
    let mut draws = Draws::new(index, 97);
    let half_edges = [DVec3::X * draws.between(0.5, 2.0), DVec3::Z * draws.between(0.5, 2.0)];
    let centre = DVec3::new(draws.between(-1.0, 1.0), draws.between(-1.0, 1.0), draws.between(-1.0, 1.0));
    let planar = Planar::new(centre, DVec3::Y, half_edges).unwrap_or(ANY);
    let zero = if index.is_multiple_of(2) { 0.0 } else { -0.0 };
    let direction = Vec3::new(draws.between(-1.0, 1.0) as f32, zero, draws.between(-1.0, 1.0) as f32).normalize();
    let height = if index % 4 < 2 { centre.y as f32 } else { 0.0 };
    (AimedRay { origin: Vec3::new(-4.0, height, 0.5), direction }, planar)
}
