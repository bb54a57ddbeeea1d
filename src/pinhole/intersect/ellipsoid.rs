use super::double_double::{double_double_ellipsoid_point, double_double_ellipsoid_t};
use super::ray_block::{Intersection, LANES, RayBlock, UNIT_ROUNDOFF, vector};
use super::rows::EllipsoidRows;
use super::sphere::nearness;
use super::surface::{Surface, l1_norm, offset_bound};
use super::uv::sphere_uv;
use super::view::{SurfaceView, SurfaceViewItem};
use super::{HitColumn, Hits, RayColumn, RaySlices};
use crate::extract::{
    Ellipsoid, EllipsoidTable, ShapeTable, direction_object_from_world, normal_world_from_object,
    point_object_from_world, unevenly_scaled,
};
use crate::plan::{Census, Evidence, Shared, Stage, TileSystems};
use crate::rays::WorldRays;
use crate::scene::Sphere;
use bevy_ecs::prelude::*;
use glam::DVec3;
use multiversion::multiversion;

/// 2⁻⁵³, the unit roundoff of f64.
const EPSILON: f64 = 1.0 / (1_u64 << 53) as f64;

// ANCHOR: ellipsoid_intersection
/// Intersects O + tR with an ellipsoid, in f64: the ray is transformed to the space where the ellipsoid is the unit
/// sphere.
///
/// p = A (O − C) is transformed as a point and q = A R as a direction, and q is not normalised, so that p + tq is
/// A (O + tR − C) for the same t.
/// The discriminant is 1 − |p − (p·q / q·q) q|², with the component of p perpendicular to the ray, as for a sphere.
#[inline(always)]
pub fn ellipsoid_intersection(origin: DVec3, direction: DVec3, ellipsoid: &Ellipsoid) -> Intersection {
    let p = point_object_from_world(ellipsoid.unit_from_world, ellipsoid.centre, origin);
    let q = direction_object_from_world(ellipsoid.unit_from_world, direction);
    let (qq, pp) = (q.dot(q), p.dot(p));
    let s = -p.dot(q) / qq;
    let across = p + s * q;
    let ll = across.dot(across);
    let (discriminant, c) = (1.0 - ll, pp - 1.0);
    let half_chord = (discriminant.max(0.0) / qq).sqrt();

    let (outside, ahead) = (c > 0.0, s > 0.0);
    let sum = if ahead { s + half_chord } else { s - half_chord };
    let root = if ahead & !outside { sum } else { c / (qq * sum) };
    let misses = (discriminant < 0.0) | (outside & !ahead);
    let t = if misses { f64::INFINITY } else { root };

    let error = mapping_error(ellipsoid, origin, s.abs(), direction);
    let error_of_discriminant = 2.0 * error * (1.0 + ll + error);
    let error_of_c = 2.0 * error * (1.0 + pp.sqrt() + error);
    let unsure_of_hit = (error_of_c >= 0.5 * UNIT_ROUNDOFF * c.abs())
        | (error_of_discriminant >= UNIT_ROUNDOFF * qq * root * half_chord);
    let unsure_of_miss = if discriminant < 0.0 { -discriminant <= error_of_discriminant } else { c <= error_of_c };
    Intersection { t, uncertain: if misses { unsure_of_miss } else { unsure_of_hit } }
}

/// A bound on the rounding error of p + sq, in the space of the unit sphere.
///
/// Let ε = 2⁻⁵³ and ‖A‖ be the Frobenius norm of A.
/// O − C has a relative error of ε, and each component of A (O − C) an error of 3ε relative to the terms summed, so p
/// is off by 4ε‖A‖|O − C| and q by 3ε‖A‖|R|; the product sq and the sum add ε each, relative to values of at most
/// ‖A‖|O − C|.
/// Together that is 6ε‖A‖|O − C| + 3ε‖A‖|sR|; an error of s itself moves the point along the ray and enters squared
/// only.
/// A factor of 8 leaves room for that, and for the rounding of the squares.
/// Hence |p + sq|² is off by twice its length times this bound, plus the bound squared; and 2|l| ≤ 1 + |l|².
#[inline(always)]
fn mapping_error(ellipsoid: &Ellipsoid, origin: DVec3, s: f64, direction: DVec3) -> f64 {
    let lengths = l1_norm(origin - ellipsoid.centre) + s * l1_norm(direction);
    8.0 * EPSILON * (1.0 + ellipsoid.norm * lengths)
}

/// The smallest t > 0 at which O + tR intersects an ellipsoid, or infinity; uncertain cases are decided in
/// double-double.
#[inline(always)]
pub fn ellipsoid_t(origin: DVec3, direction: DVec3, ellipsoid: &Ellipsoid) -> f64 {
    let intersection = ellipsoid_intersection(origin, direction, ellipsoid);
    if intersection.uncertain { double_double_ellipsoid_t(origin, direction, ellipsoid) } else { intersection.t }
}
// ANCHOR_END: ellipsoid_intersection

/// Intersects any column of rays with all ellipsoids and keeps the closest hits.
pub fn intersect_ellipsoids<R: RayColumn, H: HitColumn>(
    ellipsoids: Res<Shared<EllipsoidTable>>,
    mut tiles: Query<(&R, &mut H)>,
) {
    for (rays, mut hits) in &mut tiles {
        let (t, shape) = hits.hit_components();
        ellipsoid_rows(rays.ray_components(), &ellipsoids, t, shape);
    }
}

/// Tests one ellipsoid at a time against all rays; if none of sixteen intersects the bounding sphere, they are skipped.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn ellipsoid_rows(rays: RaySlices<'_>, ellipsoids: &EllipsoidTable, t: &mut [f64], shape: &mut [u32]) {
    let rows = t.len();
    let mut start = 0;
    while start < rows {
        let end = rows.min(start + LANES);
        let RayBlock { o, d, inverse } = RayBlock::of(rays, start, end);
        for (ellipsoid, &number) in ellipsoids.ellipsoid.iter().zip(&ellipsoids.shape) {
            let mut nearest = [f64::NEG_INFINITY; LANES];
            for (lane, nearness_of_lane) in nearest.iter_mut().enumerate() {
                let f = ellipsoid.centre - vector(&o, lane);
                *nearness_of_lane = nearness(f, vector(&d, lane), inverse[lane], ellipsoid.bounding_radius);
            }
            if nearest.iter().any(|&nearness| nearness >= 0.0) {
                keep_closest(&o, &d, ellipsoid, number, &mut t[start..end], &mut shape[start..end]);
            }
        }
        start = end;
    }
}

#[inline(always)]
fn keep_closest(
    o: &[[f64; LANES]; 3],
    d: &[[f64; LANES]; 3],
    ellipsoid: &Ellipsoid,
    number: u32,
    t: &mut [f64],
    shape: &mut [u32],
) {
    let (mut found, mut uncertain) = ([f64::INFINITY; LANES], [false; LANES]);
    for lane in 0..LANES {
        let intersection = ellipsoid_intersection(vector(o, lane), vector(d, lane), ellipsoid);
        (found[lane], uncertain[lane]) = (intersection.t, intersection.uncertain);
    }
    for (lane, (t, shape)) in t.iter_mut().zip(shape).enumerate() {
        if uncertain[lane] {
            found[lane] = double_double_ellipsoid_t(vector(o, lane), vector(d, lane), ellipsoid);
        }
        if found[lane] < *t || (found[lane] == *t && number < *shape && found[lane] < f64::INFINITY) {
            (*t, *shape) = (found[lane], number);
        }
    }
}

// ANCHOR: ellipsoid_surface
/// The surface where O + tR hits an ellipsoid, and whether it hits it from outside.
///
/// In the space of the unit sphere the normal at g is g itself; Aᵀ transforms it to the world, and |Aᵀg| is the length
/// in unit space of one scene unit along the normal.
///
/// The bound.
/// Let g be the exact point at the computed t, and m = Aᵀg / |Aᵀg|.
/// The tangent plane at the image of g / |g| has normal m, and the ellipsoid lies entirely behind it; the image of g
/// lies behind that plane by |g| (1 − |g|) / |Aᵀg|, which is about half of (1 − |g|²) / |Aᵀg|.
/// An origin that is moved along m by more than this, and by the rounding errors, is therefore off the surface whatever
/// the curvature, since nothing but the distance to a plane matters.
/// The residual |g|² − 1 is measured to within twice the error of g; both are doubled.
/// From inside, the origin stays inside while the bound is less than a seventh of the smallest radius of curvature,
/// which is the shortest semi-axis squared over the longest; a thinner ellipsoid has no room for an origin.
/// If that error would rotate the normal by more than u or exceed u times the shortest semi-axis, g is computed again
/// in double-double.
#[inline(always)]
pub fn ellipsoid_surface(
    origin: DVec3,
    direction: DVec3,
    t: f64,
    ellipsoid: &Ellipsoid,
    material: u32,
) -> (Surface, bool) {
    let map = ellipsoid.unit_from_world;
    let mut point = origin + t * direction;
    let mut g = map * ((origin - ellipsoid.centre) + t * direction);
    let mut across = normal_world_from_object(map, g);
    let mut error = mapping_error(ellipsoid, origin, t, direction);
    if error * ellipsoid.norm >= UNIT_ROUNDOFF * across.length() {
        let (further, exact) = double_double_ellipsoid_point(origin, direction, t, ellipsoid);
        point += further * direction;
        (g, error) = (exact, 8.0 * EPSILON);
        across = normal_world_from_object(map, g);
    }
    let steps = across.length();
    let behind = ((g.dot(g) - 1.0).abs() + 2.0 * error) / steps;
    let bound = offset_bound(point, origin, 0.0) + behind as f32;
    // The side is decided in unit space, where g and q are known best.
    let away = g.dot(direction_object_from_world(map, direction)) > 0.0;
    let normal = if away { -across / steps } else { across / steps };
    (Surface { position: point.as_vec3(), normal: normal.as_vec3(), bound, material }, !away)
}
// ANCHOR_END: ellipsoid_surface

/// Fills the surface of every row that hit an ellipsoid.
pub fn fill_ellipsoid_surfaces(
    ellipsoids: Res<Shared<EllipsoidTable>>,
    shapes: Res<Shared<ShapeTable>>,
    mut tiles: Query<SurfaceView<EllipsoidRows>>,
) {
    for SurfaceViewItem { rays, hits, list, mut surfaces, uvs, mut sides } in &mut tiles {
        for &row in &list.row {
            let row = row as usize;
            let shape = hits.shape[row] as usize;
            let ellipsoid = &ellipsoids.ellipsoid[shapes.row[shape] as usize];
            let (origin, direction) = (rays.origin_of(row), rays.direction_of(row));
            let (surface, outside) =
                ellipsoid_surface(origin, direction, hits.t[row], ellipsoid, shapes.material[shape]);
            surfaces.set(row, surface);
            if let Some(sides) = &mut sides {
                sides.outside[row] = u32::from(outside);
            }
        }
        if let Some(mut uvs) = uvs {
            for &row in &list.row {
                let row = row as usize;
                let ellipsoid = &ellipsoids.ellipsoid[shapes.row[hits.shape[row] as usize] as usize];
                let from_centre = rays.origin_of(row) - ellipsoid.centre + hits.t[row] * rays.direction_of(row);
                uvs.set(row, sphere_uv(ellipsoid.unit_from_world * from_centre));
            }
        }
    }
}

/// The stage that intersects camera rays.
pub fn ellipsoid_stage() -> Stage {
    Stage::new("Intersect ellipsoids", TileSystems::Intersect, intersect_ellipsoids::<WorldRays, Hits>)
        .when(ellipsoid_evidence)
}

/// The stage that fills surfaces.
pub fn ellipsoid_surface_stage() -> Stage {
    Stage::new("Compute surfaces: ellipsoids", TileSystems::Surface, fill_ellipsoid_surfaces).when(ellipsoid_evidence)
}

/// Evidence that the scene contains a sphere with a non-uniform scale.
pub fn ellipsoid_evidence(scene: &Census<'_>) -> Evidence {
    let uneven = |sphere| unevenly_scaled(scene, sphere);
    Evidence::of_kind::<With<Sphere>>(scene, "unevenly scaled sphere", uneven)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DMat3, Vec3};

    /// Semi-axes 1, 2, 4 along x, y, z, ten units ahead.
    fn egg() -> Ellipsoid {
        let unit_from_world = DMat3::from_diagonal(DVec3::new(1.0, 0.5, 0.25));
        Ellipsoid::new(DVec3::new(0.0, 0.0, -10.0), unit_from_world, 4.0)
    }

    #[test]
    fn rays_hit_the_poles_at_the_ends_of_the_semi_axes() {
        let t = |origin, direction| ellipsoid_t(origin, direction, &egg());
        assert_eq!(t(DVec3::ZERO, DVec3::NEG_Z), 6.0);
        assert_eq!(t(DVec3::ZERO, DVec3::NEG_Z * 2.0), 3.0);
        assert_eq!(t(DVec3::new(0.0, 5.0, -10.0), DVec3::NEG_Y), 3.0);
        assert_eq!(t(DVec3::new(0.0, 0.0, -10.0), DVec3::X), 1.0);
        assert_eq!(t(DVec3::X, DVec3::NEG_Z), 10.0);
        assert_eq!(t(DVec3::X * (1.0 + f64::EPSILON), DVec3::NEG_Z), f64::INFINITY);
        assert_eq!(t(DVec3::ZERO, DVec3::Z), f64::INFINITY);
    }

    #[test]
    fn normals_point_outward_under_a_mirroring_transform() {
        let origin = DVec3::new(0.3, 0.7, 0.0);
        let at = |ellipsoid: &Ellipsoid| {
            let t = ellipsoid_t(origin, DVec3::NEG_Z, ellipsoid);
            ellipsoid_surface(origin, DVec3::NEG_Z, t, ellipsoid, 7).0
        };
        let (plain, mirror) = (egg(), DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0)));
        let mirrored = Ellipsoid { unit_from_world: mirror * plain.unit_from_world, ..plain };
        assert_eq!(at(&plain), at(&mirrored));
        let surface = at(&plain);
        let from_centre = surface.position.as_dvec3() - plain.centre;
        let gradient = from_centre / DVec3::new(1.0, 4.0, 16.0);
        assert!(gradient.normalize().as_vec3().distance(surface.normal) < 1e-7 && surface.material == 7);
        assert!((surface.normal.length() - 1.0).abs() < 1e-6 && surface.bound > 0.0 && surface.bound < 1e-4);
        assert!(surface.normal.dot(Vec3::Z) > 0.0);
    }

    #[test]
    fn where_f64_is_uncertain_the_double_double_point_lies_on_the_surface() {
        let long = Ellipsoid::new(DVec3::new(0.0, 3e9, -4e9), DMat3::from_diagonal(DVec3::new(1.0, 1e-4, 1.0)), 1e4);
        let direction = DVec3::new(0.0, 0.6, -0.8);
        let t = ellipsoid_t(DVec3::ZERO, direction, &long);
        let (_, g) = double_double_ellipsoid_point(DVec3::ZERO, direction, t, &long);
        assert!((g.length() - 1.0).abs() < 1e-15, "{g}");
    }
}
