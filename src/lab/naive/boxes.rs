//! Boxes around things: the slab test by the processor's minimum and maximum, and one that survives 0 · ∞.

use super::mesh::keep_closer;
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::extract::MeshTable;
use pinhole::intersect::{HitPrimitives, Hits, mesh_stage};
use pinhole::plan::{Column, Shared, Stage};
use pinhole::rays::WorldRays;
use pinhole::shapes::PlacedMesh;
use std::sync::Arc;

// ANCHOR: naive_box_of
/// The box around points: the smallest coordinates and the largest.
#[must_use]
pub fn box_of(points: impl IntoIterator<Item = DVec3>) -> [DVec3; 2] {
    let mut around = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    for point in points {
        around = [around[0].min(point), around[1].max(point)];
    }
    around
}
// ANCHOR_END: naive_box_of

/// The box around a mesh where it stands, in render space.
#[must_use]
pub fn box_of_mesh(mesh: &PlacedMesh) -> [DVec3; 2] {
    box_of(mesh.placed_triangles().flatten())
}

// ANCHOR: naive_enters_by_min_and_max
/// Whether a ray is in a box at any t from 0 to `t_max`; `inverse` is 1 over each component of its direction.
///
/// A ray in the plane of a face multiplies 0 by ∞.
/// `f64::min` and `f64::max` pass over what is not a number and give the other operand, here an infinity: the ray counts
/// as one that misses.
#[must_use]
pub fn enters_by_min_and_max(origin: DVec3, inverse: DVec3, [low, high]: [DVec3; 2], t_max: f64) -> bool {
    let (mut from, mut until) = (0.0, t_max);
    for axis in 0..3 {
        let first = (low[axis] - origin[axis]) * inverse[axis];
        let second = (high[axis] - origin[axis]) * inverse[axis];
        from = f64::max(from, f64::min(first, second));
        until = f64::min(until, f64::max(first, second));
    }
    from <= until
}
// ANCHOR_END: naive_enters_by_min_and_max

// ANCHOR: plain_enters
/// The same, so that NaN never counts: the sign says which plane the ray enters by, and a comparison with NaN is false,
/// which leaves the interval as it is.
#[must_use]
pub fn enters(origin: DVec3, inverse: DVec3, [low, high]: [DVec3; 2], t_max: f64) -> bool {
    let (mut from, mut until) = (0.0, t_max);
    for axis in 0..3 {
        let backwards = inverse[axis].is_sign_negative();
        let [near, far] = if backwards { [high[axis], low[axis]] } else { [low[axis], high[axis]] };
        let enters = (near - origin[axis]) * inverse[axis];
        let leaves = (far - origin[axis]) * inverse[axis];
        if enters > from {
            from = enters;
        }
        if leaves < until {
            until = leaves;
        }
    }
    from <= until
}
// ANCHOR_END: plain_enters

/// A slab test: origin, inverse direction, box, t_max.
pub type SlabTest = fn(DVec3, DVec3, [DVec3; 2], f64) -> bool;

/// Intersects meshes, each only where the ray enters its box by this test.
#[must_use]
pub fn meshes_in_boxes(enters: SlabTest) -> Stage {
    let system = move |meshes: Res<Shared<MeshTable>>,
                       mut boxes: Local<Vec<[DVec3; 2]>>,
                       mut tiles: Query<(&WorldRays, &mut Hits, Option<&mut HitPrimitives>)>| {
        if boxes.is_empty() {
            *boxes = meshes.row.iter().map(box_of_mesh).collect();
        }
        for (rays, mut hits, mut primitives) in &mut tiles {
            for row in 0..rays.rows() {
                let (origin, direction) = (rays.origin_of(row), rays.direction_of(row));
                for ((mesh, &shape), &around) in meshes.row.iter().zip(&meshes.shape).zip(&*boxes) {
                    if !enters(origin, direction.recip(), around, hits.t[row]) {
                        continue;
                    }
                    let closest = mesh.closest(origin, direction);
                    keep_closer((&mut *hits, primitives.as_deref_mut()), row, shape, closest);
                }
            }
        }
    };
    Stage { system: Arc::new(move || system.into_configs()), ..mesh_stage() }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CUBE: [DVec3; 2] = [DVec3::NEG_ONE, DVec3::ONE];

    #[test]
    fn points_are_in_their_box() {
        let points = [DVec3::new(1.0, -2.0, 3.0), DVec3::new(0.0, 4.0, -1.0)];
        assert_eq!(box_of(points), [DVec3::new(0.0, -2.0, -1.0), DVec3::new(1.0, 4.0, 3.0)]);
    }

    #[test]
    fn both_agree_on_ordinary_rays() {
        for (origin, direction, expected) in [
            (DVec3::new(0.25, 0.5, 5.0), DVec3::NEG_Z, true),
            (DVec3::new(0.25, 1.5, 5.0), DVec3::NEG_Z, false),
            (DVec3::new(0.25, 0.5, 5.0), DVec3::Z, false),
            (DVec3::ZERO, DVec3::new(1.0, 2.0, 3.0), true),
            (DVec3::new(3.0, 3.0, 3.0), DVec3::new(-1.0, -1.0, -1.0), true),
        ] {
            for test in [enters, enters_by_min_and_max] {
                assert_eq!(test(origin, direction.recip(), CUBE, f64::INFINITY), expected, "{origin} {direction}");
            }
        }
        assert!(!enters(DVec3::new(0.0, 0.0, 5.0), DVec3::NEG_Z.recip(), CUBE, 3.5), "the box begins at t = 4");
    }

    #[test]
    fn in_the_plane_of_a_face_min_and_max_lose_the_ray() {
        for (side, zero) in [(1.0, 0.0), (1.0, -0.0), (-1.0, 0.0), (-1.0, -0.0)] {
            let (origin, inverse) = (DVec3::new(0.0, side, 5.0), DVec3::new(zero, zero, -1.0).recip());
            assert!(enters(origin, inverse, CUBE, f64::INFINITY));
            assert!(!enters_by_min_and_max(origin, inverse, CUBE, f64::INFINITY));
        }
    }
}
