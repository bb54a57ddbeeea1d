use super::double_double::double_double_sphere_t;
use super::ray_block::{Intersection, LANES, RayBlock, UNIT_ROUNDOFF, vector};
use super::rows::SphereRows;
use super::surface::{Surface, SurfaceUvs, l1_norm, offset_bound};
use super::uv::sphere_uv;
use super::view::{SurfaceView, SurfaceViewItem};
use super::{HitColumn, Hits, RayColumn, RaySlices};
use crate::extract::{ShapeTable, SphereTable, UvSpaceTable, moves_while_open, unevenly_scaled};
use crate::plan::{Census, Evidence, Shared, Stage, TileSystems};
use crate::rays::WorldRays;
use crate::scene::Sphere;
use bevy_ecs::prelude::*;
use glam::DVec3;
use multiversion::multiversion;

// ANCHOR: sphere_intersection
/// Intersects O + tR with a sphere, in f64; f = C − O.
///
/// The discriminant is computed from the component of f perpendicular to the ray, as r² − |f − sR|², which avoids the
/// cancellation of squared distances (Haines et al., *Ray Tracing Gems* ch. 7).
/// The nearer root is computed as c / (R·R (s + h)) with c = f·f − r², because s − h would cancel.
#[inline(always)]
pub fn sphere_intersection(f: DVec3, direction: DVec3, radius: f64) -> Intersection {
    let (dd, ff, rr) = (direction.dot(direction), f.dot(f), radius * radius);
    let s = f.dot(direction) / dd;
    let across = f - s * direction;
    let ll = across.dot(across);
    let (discriminant, c) = (rr - ll, ff - rr);
    let half_chord = (discriminant.max(0.0) / dd).sqrt();

    let (outside, ahead) = (c > 0.0, s > 0.0);
    let sum = if ahead { s + half_chord } else { s - half_chord };
    let root = if ahead & !outside { sum } else { c / (dd * sum) };
    let misses = (discriminant < 0.0) | (outside & !ahead);
    let t = if misses { f64::INFINITY } else { root };

    let error = discriminant_error(ff, rr, ll);
    let unsure_of_hit = (error >= c.abs()) | (error >= UNIT_ROUNDOFF * dd * root * half_chord);
    let unsure_of_miss = if discriminant < 0.0 { -discriminant <= error } else { c <= error };
    Intersection { t, uncertain: if misses { unsure_of_miss } else { unsure_of_hit } }
}

/// A bound on the rounding error of the discriminant.
///
/// With ε = 2⁻⁵³, f and sR each have an error of ε|f|, an error of s acts along R only, and the squares add 3ε|l|² +
/// εr²:
/// together at most 9ε|f||l| + εr², plus second-order terms of 50ε²|f|².
#[inline(always)]
fn discriminant_error(ff: f64, rr: f64, ll: f64) -> f64 {
    const TWO_TO_MINUS_50: f64 = 1.0 / (1_u64 << 50) as f64;
    TWO_TO_MINUS_50 * (2.0 * ff * (rr + ll + TWO_TO_MINUS_50 * TWO_TO_MINUS_50 * ff)).sqrt()
}

/// The smallest t > 0 at which O + tR intersects a sphere, or infinity; uncertain cases are decided in double-double.
#[inline(always)]
pub fn sphere_t(origin: DVec3, direction: DVec3, centre: DVec3, radius: f64) -> f64 {
    let intersection = sphere_intersection(centre - origin, direction, radius);
    if intersection.uncertain { double_double_sphere_t(origin, direction, centre, radius) } else { intersection.t }
}
// ANCHOR_END: sphere_intersection

/// A conservative test: negative only if the ray's line certainly misses the sphere.
///
/// `inverse` is 1 / R·R, computed once per ray; the slack is many times its rounding error.
#[inline(always)]
pub fn nearness(f: DVec3, direction: DVec3, inverse: f64, radius: f64) -> f64 {
    const SLACK: f64 = 1.0 / (1_u64 << 47) as f64;
    let (ff, rr) = (f.dot(f), radius * radius);
    let across = f - f.dot(direction) * inverse * direction;
    rr - across.dot(across) + SLACK * (ff + rr)
}

/// Intersects any column of rays with all spheres and keeps the closest hits.
pub fn intersect_spheres<R: RayColumn, H: HitColumn>(
    spheres: Res<Shared<SphereTable>>,
    mut tiles: Query<(&R, &mut H)>,
) {
    for (rays, mut hits) in &mut tiles {
        let (t, shape) = hits.hit_components();
        sphere_rows(rays.ray_components(), &spheres, t, shape);
    }
}

/// Tests one sphere at a time against all rays, so that the arithmetic is vectorised over rays.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn sphere_rows(rays: RaySlices<'_>, spheres: &SphereTable, t: &mut [f64], shape: &mut [u32]) {
    let rows = t.len();
    let mut start = 0;
    while start < rows {
        let end = rows.min(start + LANES);
        let RayBlock { o, d, inverse } = RayBlock::of(rays, start, end);
        for sphere in 0..spheres.x.len() {
            let (centre, radius) = (spheres.centre(sphere), spheres.radius[sphere]);
            let mut nearest = [f64::NEG_INFINITY; LANES];
            for (lane, nearness_of_lane) in nearest.iter_mut().enumerate() {
                *nearness_of_lane = nearness(centre - vector(&o, lane), vector(&d, lane), inverse[lane], radius);
            }
            if nearest.iter().any(|&nearness| nearness >= 0.0) {
                let (t, shape) = (&mut t[start..end], &mut shape[start..end]);
                keep_closest(&o, &d, centre, radius, spheres.shape[sphere], t, shape);
            }
        }
        start = end;
    }
}

#[inline(always)]
fn keep_closest(
    o: &[[f64; LANES]; 3],
    d: &[[f64; LANES]; 3],
    centre: DVec3,
    radius: f64,
    number: u32,
    t: &mut [f64],
    shape: &mut [u32],
) {
    let (mut found, mut uncertain) = ([f64::INFINITY; LANES], [false; LANES]);
    for lane in 0..LANES {
        let intersection = sphere_intersection(centre - vector(o, lane), vector(d, lane), radius);
        (found[lane], uncertain[lane]) = (intersection.t, intersection.uncertain);
    }
    for (lane, (t, shape)) in t.iter_mut().zip(shape).enumerate() {
        if uncertain[lane] {
            found[lane] = double_double_sphere_t(vector(o, lane), vector(d, lane), centre, radius);
        }
        if found[lane] < *t || (found[lane] == *t && number < *shape && found[lane] < f64::INFINITY) {
            (*t, *shape) = (found[lane], number);
        }
    }
}

/// Fills the surface of every row that hit a sphere.
pub fn fill_sphere_surfaces(
    spheres: Res<Shared<SphereTable>>,
    shapes: Res<Shared<ShapeTable>>,
    uv_spaces: Option<Res<Shared<UvSpaceTable>>>,
    mut tiles: Query<SurfaceView<SphereRows>>,
) {
    for SurfaceViewItem { rays, hits, list, mut surfaces, uvs, sides } in &mut tiles {
        for &row in &list.row {
            let row = row as usize;
            let shape = hits.shape[row] as usize;
            let sphere = shapes.row[shape] as usize;
            let (centre, radius) = (spheres.centre(sphere), spheres.radius[sphere]);
            let (origin, direction) = (rays.origin_of(row), rays.direction_of(row));
            let point = origin + hits.t[row] * direction;
            // A sphere smaller than the spacing of f64 at its position may have no meaningful normal; any will do.
            let outward = (point - centre).try_normalize().unwrap_or(-direction);
            let bound = offset_bound(point, origin, l1_norm(centre) + radius);
            surfaces.set(row, Surface::facing(direction, point, outward, bound, shapes.material[shape]));
        }
        if let Some(mut sides) = sides {
            for &row in &list.row {
                let row = row as usize;
                let centre = spheres.centre(shapes.row[hits.shape[row] as usize] as usize);
                let from_centre = rays.point_at(row, hits.t[row]) - centre;
                let normal = surfaces.get(row).normal.as_dvec3();
                sides.outside[row] = u32::from(normal.dot(from_centre) >= 0.0);
            }
        }
        if let (Some(mut uvs), Some(spaces)) = (uvs, &uv_spaces) {
            for &row in &list.row {
                let row = row as usize;
                let own = spaces.point(hits.shape[row] as usize, rays.point_at(row, hits.t[row]));
                uvs.set(row, sphere_uv(own));
            }
        }
    }
}

/// The stage that intersects camera rays.
pub fn sphere_stage() -> Stage {
    Stage::new("Intersect spheres", TileSystems::Intersect, intersect_spheres::<WorldRays, Hits>).when(sphere_evidence)
}

/// The stage that fills surfaces.
pub fn sphere_surface_stage() -> Stage {
    Stage::new("Compute surfaces: spheres", TileSystems::Surface, fill_sphere_surfaces)
        .table_with::<UvSpaceTable, SurfaceUvs>()
        .when(sphere_evidence)
}

/// Evidence that the scene contains a static sphere that is not scaled to an ellipsoid.
pub fn sphere_evidence(scene: &Census<'_>) -> Evidence {
    let moves = moves_while_open(scene);
    Evidence::of_kind::<With<Sphere>>(scene, "sphere", |sphere| !unevenly_scaled(scene, sphere) && !moves(sphere))
}
