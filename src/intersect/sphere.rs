use super::classify::SphereRows;
use super::surface::{Surface, Surfaces};
use super::{HitColumn, Hits, RayColumn, RayLanes};
use crate::extract::{ShapeTable, SphereTable};
use crate::plan::{Evidence, Shared, Stage, TileSystems};
use crate::rays::WorldRays;
use crate::scene::Sphere;
use bevy_ecs::prelude::*;
use glam::DVec3;
use multiversion::multiversion;

/// Rays tested together before it is asked whether any of them came near.
const LANES: usize = 16;

// ANCHOR: sphere_t
/// The smallest t > 0 at which O + tR lies on a sphere, or infinity.
///
/// `to_centre` is C − O; `direction` need not be exactly 1 long.
/// The discriminant is taken from the part of C − O across the ray, r² − |f − sR|², so that nothing of the size of the
/// distance is squared and cancelled (Haines et al., *Ray Tracing Gems* ch. 7), and in f64, so that what is left after
/// the subtraction is still exact enough at 10⁷ radii.
#[inline(always)]
pub fn sphere_t(to_centre: DVec3, direction: DVec3, radius: f64) -> f64 {
    let (s, inside) = sphere_depth(to_centre, direction, radius);
    let half_chord = (inside.max(0.0) / direction.dot(direction)).sqrt();
    let (near, far) = (s - half_chord, s + half_chord);
    let t = if near > 0.0 { near } else { far };
    if inside >= 0.0 && t > 0.0 { t } else { f64::INFINITY }
}

/// Where the ray passes the centre, and r² less the squared distance there: at least 0 where the line meets the sphere.
#[inline(always)]
fn sphere_depth(to_centre: DVec3, direction: DVec3, radius: f64) -> (f64, f64) {
    let s = to_centre.dot(direction) / direction.dot(direction);
    let across = to_centre - s * direction;
    (s, radius * radius - across.dot(across))
}
// ANCHOR_END: sphere_t

/// Narrows hits by all spheres, for any column of rays.
pub fn intersect_spheres<R: RayColumn, H: HitColumn>(
    spheres: Res<Shared<SphereTable>>,
    mut tiles: Query<(&R, &mut H)>,
) {
    for (rays, mut hits) in &mut tiles {
        let (t, shape) = hits.hit_lanes();
        sphere_rows(rays.ray_lanes(), &spheres, t, shape);
    }
}

/// A sphere at a time over all rays, so that the arithmetic of many rays is done at once.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn sphere_rows(rays: RayLanes<'_>, spheres: &SphereTable, t: &mut [f64], shape: &mut [u32]) {
    let rows = t.len();
    let [ox, oy, oz] = rays.origin.map(|lane| &lane[..rows]);
    let [dx, dy, dz] = rays.direction.map(|lane| &lane[..rows]);
    let mut start = 0;
    while start < rows {
        let end = rows.min(start + LANES);
        let (mut o, mut d) = ([[0.0_f64; LANES]; 3], [[1.0_f64; LANES]; 3]);
        for (lane, row) in (start..end).enumerate() {
            (o[0][lane], o[1][lane], o[2][lane]) = (f64::from(ox[row]), f64::from(oy[row]), f64::from(oz[row]));
            (d[0][lane], d[1][lane], d[2][lane]) = (f64::from(dx[row]), f64::from(dy[row]), f64::from(dz[row]));
        }
        for sphere in 0..spheres.x.len() {
            let (centre, radius) = (spheres.centre(sphere), spheres.radius[sphere]);
            let mut inside = [0.0_f64; LANES];
            let mut nearest = f64::NEG_INFINITY;
            for lane in 0..LANES {
                let origin = DVec3::new(o[0][lane], o[1][lane], o[2][lane]);
                let direction = DVec3::new(d[0][lane], d[1][lane], d[2][lane]);
                inside[lane] = sphere_depth(centre - origin, direction, radius).1;
            }
            for depth in inside {
                nearest = if depth > nearest { depth } else { nearest };
            }
            if nearest < 0.0 {
                continue;
            }
            narrow(&o, &d, centre, radius, spheres.shape[sphere], &mut t[start..end], &mut shape[start..end]);
        }
        start = end;
    }
}

#[inline(always)]
fn narrow(
    o: &[[f64; LANES]; 3],
    d: &[[f64; LANES]; 3],
    centre: DVec3,
    radius: f64,
    number: u32,
    t: &mut [f64],
    shape: &mut [u32],
) {
    let mut found = [f64::INFINITY; LANES];
    for lane in 0..LANES {
        let origin = DVec3::new(o[0][lane], o[1][lane], o[2][lane]);
        let direction = DVec3::new(d[0][lane], d[1][lane], d[2][lane]);
        found[lane] = sphere_t(centre - origin, direction, radius);
    }
    for (lane, (t, shape)) in t.iter_mut().zip(shape).enumerate() {
        let closer = found[lane] < *t || (found[lane] == *t && number < *shape && found[lane] < f64::INFINITY);
        if closer {
            (*t, *shape) = (found[lane], number);
        }
    }
}

/// Fills the surface of every row that hit a sphere.
pub fn fill_sphere_surfaces(
    spheres: Res<Shared<SphereTable>>,
    shapes: Res<Shared<ShapeTable>>,
    mut tiles: Query<(&WorldRays, &Hits, &SphereRows, &mut Surfaces)>,
) {
    for (rays, hits, list, mut surfaces) in &mut tiles {
        for &row in &list.row {
            let row = row as usize;
            let shape = hits.shape[row] as usize;
            let centre = spheres.centre(shapes.row[shape] as usize);
            let point = rays.point_at(row, hits.t[row]);
            let outward = (point - centre).normalize();
            surfaces.set(row, Surface::facing(rays.direction_of(row), point, outward, shapes.matte[shape]));
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
    Stage::new("Describe sphere surfaces", TileSystems::Surface, fill_sphere_surfaces)
        .reads::<WorldRays>()
        .reads::<Hits>()
        .reads::<SphereRows>()
        .reads::<Surfaces>()
        .writes::<Surfaces>()
        .table::<SphereTable>()
        .table::<ShapeTable>()
        .when(sphere_evidence)
}

/// Evidence that the scene holds a sphere.
pub fn sphere_evidence(scene: &World) -> Evidence {
    Evidence::of::<Sphere>(scene, "sphere")
}
