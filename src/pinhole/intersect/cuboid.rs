use super::double_double_planar::double_double_cuboid_t;
use super::ray_block::{Intersection, LANES, RayBlock, keep_closest, vector};
use super::rows::CuboidRows;
use super::sphere::nearness;
use super::surface::{Surface, l1_norm, offset_bound};
use super::uv::cuboid_uv;
use super::view::{SurfaceView, SurfaceViewItem};
use super::{HitColumn, Hits, RayColumn, RaySlices};
use crate::extract::{CuboidTable, ShapeTable, Slabs};
use crate::plan::{Census, Evidence, Shared, Stage, TileSystems};
use crate::rays::WorldRays;
use crate::scene::Cuboid;
use bevy_ecs::prelude::*;
use glam::DVec3;
use multiversion::multiversion;

/// 2⁻⁵³, the unit roundoff of f64.
const EPSILON: f64 = 1.0 / (1_u64 << 53) as f64;
/// Half of u: the largest relative error of a t that counts as certain.
const SMALL: f64 = 1.0 / (1_u64 << 25) as f64;

/// A t with an interval that contains its exact value.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Interval {
    t: f64,
    least: f64,
    most: f64,
}

impl Interval {
    #[inline(always)]
    fn new(t: f64, error: f64) -> Self {
        Self { t, least: t - error, most: t + error }
    }

    /// The larger of each number; a NaN is never taken over, for comparisons with it are false.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        let larger = |a: f64, b: f64| if b > a { b } else { a };
        Self { t: larger(self.t, other.t), least: larger(self.least, other.least), most: larger(self.most, other.most) }
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        let smaller = |a: f64, b: f64| if b < a { b } else { a };
        Self {
            t: smaller(self.t, other.t),
            least: smaller(self.least, other.least),
            most: smaller(self.most, other.most),
        }
    }
}

// ANCHOR: slab
/// Where a ray enters and leaves the slab |n · (x − C)| ≤ h: at t = (n·f ∓ h) / (n·R) with f = C − O, for n·R > 0.
///
/// A ray parallel to the slab divides by 0 and gets −∞ to ∞ inside and ∞ to ∞, or −∞ to −∞, outside, which is correct.
/// If rounding leaves the sign of n·R uncertain, or whether the ray lies in a face, the interval is all of ℝ.
#[inline(always)]
fn slab(f: DVec3, direction: DVec3, normal: DVec3, half: f64) -> [Interval; 2] {
    let (of_f, of_direction) = (normal * f, normal * direction);
    let (middle, approach) = (of_f.x + of_f.y + of_f.z, of_direction.x + of_direction.y + of_direction.z);
    let (sum, sum_of_approach) = (l1_norm(of_f), l1_norm(of_direction));
    // The magnitude, not the negative: −0 and 0 must both give speed 0.
    let (towards, speed) = (if approach < 0.0 { -middle } else { middle }, approach.abs());
    let (over_near, over_far) = (towards - half, towards + half);
    let (near, far) = (over_near / speed, over_far / speed);

    let lost = 8.0 * EPSILON * (sum + half);
    let relative = EPSILON * (4.0 * sum_of_approach / speed + 4.0);
    let (along, in_a_face) = (sum_of_approach == 0.0, (over_near.abs() <= lost) | (over_far.abs() <= lost));
    let unsure = if along { in_a_face } else { relative.is_nan() | (relative >= 0.25) };
    let error = |t: f64| if along { 0.0 } else { 2.0 * (lost / speed + relative * t.abs()) };
    let bounds = |t: f64| {
        if unsure { Interval { t, least: f64::NEG_INFINITY, most: f64::INFINITY } } else { Interval::new(t, error(t)) }
    };
    [bounds(near), bounds(far)]
}
// ANCHOR_END: slab

// ANCHOR: cuboid_intersection
/// Intersects O + tR with a cuboid, in f64: the ray is inside between entering the last slab and leaving the first.
#[inline(always)]
pub fn cuboid_intersection(origin: DVec3, direction: DVec3, slabs: &Slabs) -> Intersection {
    let f = slabs.centre - origin;
    let [near_x, far_x] = slab(f, direction, slabs.normal[0], slabs.half[0]);
    let [near_y, far_y] = slab(f, direction, slabs.normal[1], slabs.half[1]);
    let [near_z, far_z] = slab(f, direction, slabs.normal[2], slabs.half[2]);
    let enters = near_x.max(near_y).max(near_z);
    let leaves = far_x.min(far_y).min(far_z);

    let surely_not = (enters.least > leaves.most) | (leaves.most < 0.0);
    let surely_inside = enters.most <= leaves.least;
    let from_outside = enters.least > 0.0;
    let from_inside = (enters.most < 0.0) & (leaves.least > 0.0);
    let (t, open) =
        if from_outside { (enters.t, enters.most - enters.least) } else { (leaves.t, leaves.most - leaves.least) };
    let sure = surely_inside & (from_outside | from_inside) & (open <= SMALL * t);
    Intersection { t: if surely_not { f64::INFINITY } else { t }, uncertain: !surely_not & !sure }
}

/// The smallest t > 0 at which O + tR intersects a face of a cuboid, or infinity; uncertain cases are decided in
/// double-double.
#[inline(always)]
pub fn cuboid_t(origin: DVec3, direction: DVec3, slabs: &Slabs) -> f64 {
    let intersection = cuboid_intersection(origin, direction, slabs);
    if intersection.uncertain { double_double_cuboid_t(origin, direction, slabs).0 } else { intersection.t }
}
// ANCHOR_END: cuboid_intersection

/// The axis of the face that O + tR hits first; at an edge or a vertex, the first of the axes.
pub fn cuboid_face(origin: DVec3, direction: DVec3, slabs: &Slabs) -> usize {
    let f = slabs.centre - origin;
    let along = |axis: usize| slab(f, direction, slabs.normal[axis], slabs.half[axis]);
    let all = [along(0), along(1), along(2)];
    let from_outside = all.iter().any(|[near, _]| near.least > 0.0);
    let from_inside = all.iter().all(|[near, _]| near.most < 0.0);
    let is_first = |axis: usize| {
        let before = |other: usize| match (from_outside, from_inside) {
            (true, _) => all[axis][0].least > all[other][0].most,
            (_, true) => all[axis][1].most < all[other][1].least,
            _ => false,
        };
        before((axis + 1) % 3) && before((axis + 2) % 3)
    };
    (0..3).find(|&axis| is_first(axis)).unwrap_or_else(|| double_double_cuboid_t(origin, direction, slabs).1)
}

/// The axis of the face that a point lies on or is nearest to, relative to the cuboid's half extents.
pub fn face_of_point(slabs: &Slabs, from_centre: DVec3) -> usize {
    let coordinate = |axis: usize| (slabs.normal[axis].dot(from_centre) / slabs.half[axis]).abs();
    let first = usize::from(coordinate(1) > coordinate(0));
    if coordinate(2) > coordinate(first) { 2 } else { first }
}

// ANCHOR: cuboid_surface
/// The surface where O + tR hits the face of a cuboid across an axis, and whether it hits it from outside.
///
/// The normal faces the ray on either side.
/// From inside, a hit within rounding error of another face is moved away from that face by the bounds of both, since
/// its shadow rays might otherwise start behind it.
#[inline(always)]
pub fn cuboid_surface(
    origin: DVec3,
    direction: DVec3,
    t: f64,
    axis: usize,
    slabs: &Slabs,
    material: u32,
) -> (Surface, bool) {
    let mut point = origin + t * direction;
    let normal = slabs.normal[axis];
    let bound = offset_bound(point, origin, l1_norm(slabs.centre) + slabs.half[axis]);
    let outside = normal.dot(direction) * normal.dot(point - slabs.centre) <= 0.0;
    if !outside {
        let room = 2.0 * f64::from(bound);
        for other in [(axis + 1) % 3, (axis + 2) % 3] {
            let (across, half) = (slabs.normal[other], slabs.half[other]);
            let along = across.dot(point - slabs.centre);
            let lacking = room - (half - along.abs());
            if lacking > 0.0 && room < half {
                // Parallel to the other two faces, so that only this distance changes.
                let edge = slabs.normal[3 - axis - other].cross(normal);
                point -= edge * (lacking * along.signum() / across.dot(edge));
            }
        }
    }
    (Surface::facing(direction, point, normal, bound, material), outside)
}
// ANCHOR_END: cuboid_surface

/// Intersects any column of rays with all cuboids and keeps the closest hits.
pub fn intersect_cuboids<R: RayColumn, H: HitColumn>(
    cuboids: Res<Shared<CuboidTable>>,
    mut tiles: Query<(&R, &mut H)>,
) {
    for (rays, mut hits) in &mut tiles {
        let (t, shape) = hits.hit_components();
        cuboid_rows(rays.ray_components(), &cuboids, t, shape);
    }
}

/// Tests one cuboid at a time against all rays; if none of sixteen intersects the bounding sphere, they are skipped.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn cuboid_rows(rays: RaySlices<'_>, cuboids: &CuboidTable, t: &mut [f64], shape: &mut [u32]) {
    let rows = t.len();
    let mut start = 0;
    while start < rows {
        let end = rows.min(start + LANES);
        let block = RayBlock::of(rays, start, end);
        for (slabs, &number) in cuboids.slabs.iter().zip(&cuboids.shape) {
            let mut nearest = [f64::NEG_INFINITY; LANES];
            for (lane, nearness_of_lane) in nearest.iter_mut().enumerate() {
                let f = slabs.centre - vector(&block.o, lane);
                *nearness_of_lane = nearness(f, vector(&block.d, lane), block.inverse[lane], slabs.bounding_radius);
            }
            if nearest.iter().any(|&nearness| nearness >= 0.0) {
                let intersection = |origin, direction| cuboid_intersection(origin, direction, slabs);
                let double_double = |origin, direction| double_double_cuboid_t(origin, direction, slabs).0;
                keep_closest(&block, intersection, double_double, number, &mut t[start..end], &mut shape[start..end]);
            }
        }
        start = end;
    }
}

/// Fills the surface of every row that hit a cuboid.
pub fn fill_cuboid_surfaces(
    cuboids: Res<Shared<CuboidTable>>,
    shapes: Res<Shared<ShapeTable>>,
    mut tiles: Query<SurfaceView<CuboidRows>>,
) {
    for SurfaceViewItem { rays, hits, list, mut surfaces, mut uvs, mut sides } in &mut tiles {
        for &row in &list.row {
            let row = row as usize;
            let shape = hits.shape[row] as usize;
            let slabs = &cuboids.slabs[shapes.row[shape] as usize];
            let (origin, direction, t) = (rays.origin_of(row), rays.direction_of(row), hits.t[row]);
            let axis = cuboid_face(origin, direction, slabs);
            let (surface, outside) = cuboid_surface(origin, direction, t, axis, slabs, shapes.material[shape]);
            surfaces.set(row, surface);
            if let Some(sides) = &mut sides {
                sides.outside[row] = u32::from(outside);
            }
            if let Some(uvs) = &mut uvs {
                uvs.set(row, cuboid_uv(slabs, axis, t * direction - (slabs.centre - origin)));
            }
        }
    }
}

/// The stage that intersects camera rays.
pub fn cuboid_stage() -> Stage {
    Stage::new("Intersect cuboids", TileSystems::Intersect, intersect_cuboids::<WorldRays, Hits>).when(cuboid_evidence)
}

/// The stage that fills surfaces.
pub fn cuboid_surface_stage() -> Stage {
    Stage::new("Compute surfaces: cuboids", TileSystems::Surface, fill_cuboid_surfaces).when(cuboid_evidence)
}

/// Evidence that the scene contains a cuboid.
pub fn cuboid_evidence(scene: &Census<'_>) -> Evidence {
    Evidence::of::<Cuboid>(scene, "cuboid")
}
