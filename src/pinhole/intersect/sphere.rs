use super::classify::SphereRows;
use super::double_double::double_double_sphere_t;
use super::surface::{Surface, SurfaceSides, SurfaceUvs, Surfaces, offset_bound, sum_of_parts};
use super::uv::sphere_uv;
use super::{HitColumn, Hits, RayBlockMut, RayColumn};
use crate::extract::{ShapeTable, SphereTable, UvSpaceTable, moves_while_open, unevenly_scaled};
use crate::plan::{Census, Evidence, Shared, Stage, TileSystems};
use crate::rays::WorldRays;
use crate::scene::Sphere;
use bevy_ecs::prelude::*;
use glam::DVec3;
use multiversion::multiversion;

/// Rays tested together before it is asked whether any of them came near.
pub(super) const LANES: usize = 16;
/// u, half the spacing of f32 numbers from 1 on.
pub(super) const UNIT_ROUNDOFF: f64 = 1.0 / (1_u64 << 24) as f64;

/// What the quick method says of a ray and a sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intersection {
    /// The smallest t > 0 at which they meet, or infinity.
    pub t: f64,
    /// Whether rounding could have changed whether they meet, or t by more than 2⁻²⁴ of itself.
    pub uncertain: bool,
}

// ANCHOR: sphere_intersection
/// Where O + tR meets a sphere, f = C − O, in f64.
///
/// The discriminant is taken from the part of f across the ray, r² − |f − sR|², so that nothing of the size of the
/// distance is squared and cancelled (Haines et al., *Ray Tracing Gems* ch. 7).
/// The nearer root is taken as c / (R·R (s + h)), c = f·f − r², where s − h would cancel.
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

/// How far rounding can have moved the discriminant.
///
/// With ε = 2⁻⁵³, f and sR are each rounded by ε|f|, an error of s acts along R only, and the squares add 3ε|l|² + εr²:
/// at most 9ε|f||l| + εr² together, and 50ε²|f|² of second order.
#[inline(always)]
fn discriminant_error(ff: f64, rr: f64, ll: f64) -> f64 {
    const TWO_TO_MINUS_50: f64 = 1.0 / (1_u64 << 50) as f64;
    TWO_TO_MINUS_50 * (2.0 * ff * (rr + ll + TWO_TO_MINUS_50 * TWO_TO_MINUS_50 * ff)).sqrt()
}

/// The smallest t > 0 at which O + tR lies on a sphere, or infinity; right also where f64 alone would leave a doubt.
#[inline(always)]
pub fn sphere_t(origin: DVec3, direction: DVec3, centre: DVec3, radius: f64) -> f64 {
    let intersection = sphere_intersection(centre - origin, direction, radius);
    if intersection.uncertain { double_double_sphere_t(origin, direction, centre, radius) } else { intersection.t }
}
// ANCHOR_END: sphere_intersection

/// At least 0 where a ray may meet the sphere or be in doubt, below 0 where it passes by for certain.
///
/// `inverse` is 1 / R·R, taken once a ray; the slack is many times what its rounding can do.
#[inline(always)]
pub fn nearness(f: DVec3, direction: DVec3, inverse: f64, radius: f64) -> f64 {
    const SLACK: f64 = 1.0 / (1_u64 << 47) as f64;
    let (ff, rr) = (f.dot(f), radius * radius);
    let across = f - f.dot(direction) * inverse * direction;
    rr - across.dot(across) + SLACK * (ff + rr)
}

/// Narrows hits by all spheres, for any column of rays.
pub fn intersect_spheres<R: RayColumn, H: HitColumn>(
    spheres: Res<Shared<SphereTable>>,
    mut tiles: Query<(&R, &mut H)>,
) {
    for (rays, mut hits) in &mut tiles {
        let (t, shape) = hits.hit_components();
        sphere_rows(rays.ray_components(), &spheres, t, shape);
    }
}

/// A sphere at a time over all rays, so that the arithmetic of many rays is done at once.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn sphere_rows(rays: RayBlockMut<'_>, spheres: &SphereTable, t: &mut [f64], shape: &mut [u32]) {
    let rows = t.len();
    let mut start = 0;
    while start < rows {
        let end = rows.min(start + LANES);
        let RayBlock { o, d, inverse } = RayBlock::of(rays, start, end);
        for sphere in 0..spheres.x.len() {
            let (centre, radius) = (spheres.centre(sphere), spheres.radius[sphere]);
            let mut nearest = [f64::NEG_INFINITY; LANES];
            for (component, nearness_of_component) in nearest.iter_mut().enumerate() {
                *nearness_of_component =
                    nearness(centre - vector(&o, component), vector(&d, component), inverse[component], radius);
            }
            if nearest.iter().any(|&nearness| nearness >= 0.0) {
                let (t, shape) = (&mut t[start..end], &mut shape[start..end]);
                keep_closest(&o, &d, centre, radius, spheres.shape[sphere], t, shape);
            }
        }
        start = end;
    }
}

/// Rays tested together, in f64: origins, directions, 1 / R·R; lanes beyond the last row hold a ray of no meaning.
pub(super) struct RayBlock {
    pub o: [[f64; LANES]; 3],
    pub d: [[f64; LANES]; 3],
    pub inverse: [f64; LANES],
}

impl RayBlock {
    #[inline(always)]
    pub fn of(rays: RayBlockMut<'_>, start: usize, end: usize) -> Self {
        let [ox, oy, oz] = rays.origin.map(|component| &component[..end]);
        let [dx, dy, dz] = rays.direction.map(|component| &component[..end]);
        let (mut o, mut d) = ([[0.0_f64; LANES]; 3], [[1.0_f64; LANES]; 3]);
        for (component, row) in (start..end).enumerate() {
            (o[0][component], o[1][component], o[2][component]) =
                (f64::from(ox[row]), f64::from(oy[row]), f64::from(oz[row]));
            (d[0][component], d[1][component], d[2][component]) =
                (f64::from(dx[row]), f64::from(dy[row]), f64::from(dz[row]));
        }
        Self::measured(o, d)
    }

    /// The rays of some rows, at most as many as there are lanes.
    #[inline(always)]
    pub fn of_rows(rays: RayBlockMut<'_>, rows: &[u32]) -> Self {
        let ([ox, oy, oz], [dx, dy, dz]) = (rays.origin, rays.direction);
        let (mut o, mut d) = ([[0.0_f64; LANES]; 3], [[1.0_f64; LANES]; 3]);
        for (component, &row) in rows.iter().enumerate() {
            let row = row as usize;
            (o[0][component], o[1][component], o[2][component]) =
                (f64::from(ox[row]), f64::from(oy[row]), f64::from(oz[row]));
            (d[0][component], d[1][component], d[2][component]) =
                (f64::from(dx[row]), f64::from(dy[row]), f64::from(dz[row]));
        }
        Self::measured(o, d)
    }

    #[inline(always)]
    fn measured(o: [[f64; LANES]; 3], d: [[f64; LANES]; 3]) -> Self {
        let mut inverse = [1.0_f64; LANES];
        for (component, inverse) in inverse.iter_mut().enumerate() {
            *inverse = 1.0 / vector(&d, component).dot(vector(&d, component));
        }
        Self { o, d, inverse }
    }
}

/// Three lanes' numbers as a vector.
#[inline(always)]
pub(super) fn vector(components: &[[f64; LANES]; 3], component: usize) -> DVec3 {
    DVec3::new(components[0][component], components[1][component], components[2][component])
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
    for component in 0..LANES {
        let intersection = sphere_intersection(centre - vector(o, component), vector(d, component), radius);
        (found[component], uncertain[component]) = (intersection.t, intersection.uncertain);
    }
    for (component, (t, shape)) in t.iter_mut().zip(shape).enumerate() {
        if uncertain[component] {
            found[component] = double_double_sphere_t(vector(o, component), vector(d, component), centre, radius);
        }
        if found[component] < *t || (found[component] == *t && number < *shape && found[component] < f64::INFINITY) {
            (*t, *shape) = (found[component], number);
        }
    }
}

/// Fills the surface of every row that hit a sphere.
pub fn fill_sphere_surfaces(
    spheres: Res<Shared<SphereTable>>,
    shapes: Res<Shared<ShapeTable>>,
    uv_spaces: Option<Res<Shared<UvSpaceTable>>>,
    mut tiles: Query<(
        &WorldRays,
        &Hits,
        &SphereRows,
        &mut Surfaces,
        Option<&mut SurfaceUvs>,
        Option<&mut SurfaceSides>,
    )>,
) {
    for (rays, hits, list, mut surfaces, uvs, sides) in &mut tiles {
        for &row in &list.row {
            let row = row as usize;
            let shape = hits.shape[row] as usize;
            let sphere = shapes.row[shape] as usize;
            let (centre, radius) = (spheres.centre(sphere), spheres.radius[sphere]);
            let (origin, direction) = (rays.origin_of(row), rays.direction_of(row));
            let point = origin + hits.t[row] * direction;
            // A sphere smaller than the spacing of numbers at its place may have no normal left; any serves it.
            let outward = (point - centre).try_normalize().unwrap_or(-direction);
            let bound = offset_bound(point, origin, sum_of_parts(centre) + radius);
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
    Stage::new("Intersect spheres", TileSystems::Intersect, intersect_spheres::<WorldRays, Hits>)
        .reads::<WorldRays>()
        .reads::<Hits>()
        .writes::<Hits>()
        .table::<SphereTable>()
        .when(sphere_evidence)
}

/// The stage that fills surfaces.
pub fn sphere_surface_stage() -> Stage {
    Stage::new("Compute surfaces: spheres", TileSystems::Surface, fill_sphere_surfaces)
        .reads::<WorldRays>()
        .reads::<Hits>()
        .reads::<SphereRows>()
        .reads::<Surfaces>()
        .writes::<Surfaces>()
        .writes::<SurfaceUvs>()
        .writes::<SurfaceSides>()
        .table::<SphereTable>()
        .table::<ShapeTable>()
        .table_with::<UvSpaceTable, SurfaceUvs>()
        .when(sphere_evidence)
}

/// Evidence that the scene holds a sphere that stays one.
pub fn sphere_evidence(scene: &Census<'_>) -> Evidence {
    let moves = moves_while_open(scene);
    Evidence::of_kind::<With<Sphere>>(scene, "sphere", |sphere| !unevenly_scaled(scene, sphere) && !moves(sphere))
}
