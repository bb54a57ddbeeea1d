//! Cuboids of any size, tilt and skew, and rays aimed at their faces, edges and corners.

use super::ray_aim::{AimedRay, BAND_IN_QUANTA, Draws, rounded_ray};
use glam::{DVec3, Vec3};
use pinhole::shapes::Slabs;

/// One direction quantum: the spacing of f32 numbers just below 1.
const QUANTUM: f64 = 1.0 / (1_u64 << 24) as f64;

/// Where a ray is aimed, up to a few direction quanta.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spot {
    /// Anywhere on a face.
    Face,
    /// On an edge.
    Edge,
    /// At a corner.
    Corner,
}

/// From where a ray comes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Eye {
    /// So many of the longest half edges from the centre, the eye at the origin.
    Far(f64),
    /// From anywhere: up to 10^4 sizes away, at coordinates of any size.
    Anywhere,
    /// From inside.
    Inside,
    /// Along an axis of a cuboid that is not turned, zeros of either sign.
    Axis,
    /// In the plane of a face of a cuboid that is not turned.
    InFace,
}

/// A ray and the cuboid that it is aimed at; sizes are 10^U(−`sizes`, `sizes`), the longest edge 10^`ratio` times the
/// shortest at most.
#[must_use]
pub fn cuboid_shot(seed: u64, index: u64, spot: Spot, eye: Eye, sizes: f64, ratio: f64) -> (AimedRay, Slabs) {
    let mut draws = Draws::new(seed, index);
    let size = draws.power_of_ten(-sizes, sizes);
    let on_axes = matches!(eye, Eye::Axis | Eye::InFace);
    let edges = if on_axes { DVec3::AXES } else { skewed_axes(&mut draws) };
    let mut edges = edges.map(|edge| edge * (size * draws.power_of_ten(-ratio, 0.0)));
    edges[(draws.unit() * 3.0) as usize] *= 1.0;
    let longest = edges.iter().map(|edge| edge.length()).fold(0.0, f64::max);
    let shortest = edges.iter().map(|edge| edge.length()).fold(f64::INFINITY, f64::min);
    let normals = [edges[1].cross(edges[2]), edges[2].cross(edges[0]), edges[0].cross(edges[1])];
    let turned = if normals[0].dot(edges[0]) < 0.0 { normals.map(|normal| -normal) } else { normals };

    let at = coordinates(spot, &mut draws);
    let seen_from = draws.unit_vector();
    let start = match eye {
        Eye::Far(radii) => seen_from * (longest * radii),
        Eye::Anywhere => seen_from * (longest * draws.power_of_ten(0.3, 4.0)),
        Eye::Inside => {
            edges[0] * draws.between(-0.95, 0.95)
                + edges[1] * draws.between(-0.95, 0.95)
                + edges[2] * draws.between(-0.95, 0.95)
        }
        Eye::Axis | Eye::InFace => DVec3::ZERO,
    };
    let centre = match eye {
        Eye::Anywhere => draws.unit_vector() * draws.power_of_ten(-sizes, sizes),
        Eye::Axis | Eye::InFace => centre_on_axes(edges, at, &mut draws),
        _ => -start,
    };
    // Checked with its faces as f32 holds their normals; aimed at the corners that these make.
    let slabs = Slabs::new(centre, turned, edges);
    if on_axes {
        return (ray_on_axes(&slabs, at, matches!(eye, Eye::InFace), &mut draws), slabs);
    }
    let origin = (centre + start).as_vec3();
    let aimed = slabs.half_edges().iter().zip(at).map(|(&edge, at)| edge * at).sum::<DVec3>();
    let towards = centre + aimed - origin.as_dvec3();
    let towards = if towards.length() > 0.0 { towards.normalize() } else { seen_from };
    let quanta = draws.between(-BAND_IN_QUANTA, BAND_IN_QUANTA) * QUANTUM;
    let quanta = if longest > 1e3 * shortest { quanta * draws.unit() } else { quanta };
    (rounded_ray(origin, towards + draws.unit_vector_across(towards) * quanta), slabs)
}

/// Three unit vectors at angles of 45 degrees or more.
fn skewed_axes(draws: &mut Draws) -> [DVec3; 3] {
    let x = draws.unit_vector();
    let y = draws.unit_vector_across(x);
    let skew = if draws.unit() < 0.5 { 0.0 } else { 0.6 };
    let lean = [draws.between(-skew, skew), draws.between(-skew, skew)];
    [x, (y + x * lean[0]).normalize(), (x.cross(y) + x * lean[1]).normalize()]
}

/// Coordinates of a point of the surface, −1 to 1 each.
fn coordinates(spot: Spot, draws: &mut Draws) -> [f64; 3] {
    let mut at = [draws.between(-1.0, 1.0), draws.between(-1.0, 1.0), draws.between(-1.0, 1.0)];
    let first = (draws.unit() * 3.0) as usize;
    let count = match spot {
        Spot::Face => 1,
        Spot::Edge => 2,
        Spot::Corner => 3,
    };
    for axis in 0..count {
        at[(first + axis) % 3] = if draws.unit() < 0.5 { 1.0 } else { -1.0 };
    }
    at
}

/// A centre from which the spot has coordinates that f32 holds.
fn centre_on_axes(edges: [DVec3; 3], at: [f64; 3], draws: &mut Draws) -> DVec3 {
    let spot = DVec3::new(edges[0].x * at[0], edges[1].y * at[1], edges[2].z * at[2]);
    let place = draws.unit_vector() * spot.length() * draws.power_of_ten(0.0, 3.0);
    (spot + place).as_vec3().as_dvec3() - spot
}

/// A ray along an axis through the spot, or in the plane of a face: coordinates that are equal to those of a face, as far
/// as f32 goes, and up to a step beside it.
fn ray_on_axes(slabs: &Slabs, at: [f64; 3], in_face: bool, draws: &mut Draws) -> AimedRay {
    let spot = slabs.centre + DVec3::from([0, 1, 2].map(|axis| slabs.half[axis] * at[axis]));
    let size = slabs.bounding_radius as f32;
    let (first, zero) = ((draws.unit() * 3.0) as usize, if draws.unit() < 0.5 { 0.0 } else { -0.0 });
    let mut direction = Vec3::splat(zero);
    direction[first] = if draws.unit() < 0.5 { 1.0 } else { -1.0 };
    if in_face {
        direction[(first + 1) % 3] = draws.between(-1.0, 1.0) as f32;
        direction = direction.normalize();
    }
    let mut origin = spot.as_vec3() - direction * size * 3.0;
    for axis in 0..3 {
        if direction[axis] == 0.0 {
            let part = spot[axis] as f32;
            origin[axis] = [part, part, part.next_up(), part.next_down()][(draws.unit() * 4.0) as usize];
        }
    }
    AimedRay { origin, direction }
}
