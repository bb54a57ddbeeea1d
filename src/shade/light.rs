use super::{Radiance, ShadowHits};
use crate::extract::{MaterialTable, PointLightTable, material_evidence};
use crate::intersect::{MaterialRows, NO_SHAPE, RayColumn, RayLanes, Surface, Surfaces, offset_origin};
use crate::plan::{Column, Evidence, Shared, Stage, StageKind, TileSystems, column};
use crate::scene::PointLight;
use bevy_ecs::prelude::*;
use glam::{DVec3, Vec3};
use multiversion::multiversion;

column! {
    /// Rays from surfaces towards lights that their side faces, light after light, and what each will bring if it gets there.
    pub struct LightRays("light", "world, from the eye", "scene units", Ray) {
        /// The row of the tile whose surface it starts on.
        path: u32,
        /// Origin, x: off the surface by its bound.
        ox: f32,
        /// Origin, y.
        oy: f32,
        /// Origin, z.
        oz: f32,
        /// Direction to the light, x; the three are a unit vector.
        dx: f32,
        /// Direction, y.
        dy: f32,
        /// Direction, z.
        dz: f32,
        /// The distance before which something in between counts; 0 for a light without shadows.
        reach: f32,
        /// The radiance it brings to its path, red.
        r: f32,
        /// Green.
        g: f32,
        /// Blue.
        b: f32,
    }
}

impl LightRays {
    /// The direction: each part from −1 to 1 becomes 0 to 1.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.dx[row], self.dy[row], self.dz[row]].map(|part| 0.5 + 0.5 * part)
    }
}

impl RayColumn for LightRays {
    fn ray_lanes(&self) -> RayLanes<'_> {
        RayLanes { origin: [&self.ox, &self.oy, &self.oz], direction: [&self.dx, &self.dy, &self.dz] }
    }
}

// ANCHOR: reflected_radiance
/// What a matte surface sends towards the eye of a point light's intensity I: (colour / π) · I cos θ / d².
///
/// The same in all directions (Lambert); the light thins out with the square of the distance and with the slant at
/// which it falls.
#[inline(always)]
pub fn reflected_radiance(colour: [f64; 3], intensity: [f64; 3], cosine: f64, distance_squared: f64) -> [f64; 3] {
    let share = cosine * std::f64::consts::FRAC_1_PI / distance_squared;
    [colour[0] * intensity[0] * share, colour[1] * intensity[1] * share, colour[2] * intensity[2] * share]
}
// ANCHOR_END: reflected_radiance

// ANCHOR: aim
/// A ray from a surface to a light.
#[derive(Clone, Copy, Debug, Default)]
struct Aimed {
    origin: Vec3,
    direction: Vec3,
    distance: f64,
    /// Of the angle between the normal and the direction; not above 0 where the surface faces away.
    cosine: f64,
}

#[inline(always)]
fn aim(surface: &Surface, light: DVec3) -> Aimed {
    let origin = offset_origin(surface.position, surface.normal, surface.bound);
    let to_light = light - origin.as_dvec3();
    let distance = to_light.length();
    let direction = (to_light * (1.0 / distance)).as_vec3();
    Aimed { origin, direction, distance, cosine: surface.normal.as_dvec3().dot(direction.as_dvec3()) }
}
// ANCHOR_END: aim

// ANCHOR: shadow_reach
/// How far a shadow ray looks: a little short of the light, by more than its direction's length can be off.
#[inline(always)]
pub fn shadow_reach(distance: f64) -> f32 {
    (distance * (1.0 - f64::from(f32::EPSILON) * 4.0)) as f32
}
// ANCHOR_END: shadow_reach

/// Fills a tile's light rays.
pub fn aim_at_lights(
    lights: Res<Shared<PointLightTable>>,
    materials: Res<Shared<MaterialTable>>,
    mut tiles: Query<(&Surfaces, &MaterialRows, &mut LightRays)>,
) {
    for (surfaces, list, mut rays) in &mut tiles {
        let mut length = 0;
        rays.slices_mut(list.rows() * lights.position.len());
        for light in 0..lights.position.len() {
            length = aim_rows(surfaces, &list.row, &lights, light, &materials, &mut rays, length);
        }
        rays.slices_mut(length);
    }
}

/// Aims from all surfaces of a tile at one light, keeps those that face it, and says how many rays there are now.
///
/// Every row is written and the next one overwrites it unless it counts, so that no branch depends on the surface.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn aim_rows(
    surfaces: &Surfaces,
    rows: &[u32],
    lights: &PointLightTable,
    light: usize,
    materials: &MaterialTable,
    rays: &mut LightRays,
    length: usize,
) -> usize {
    let (position, intensity) = (lights.position[light], lights.intensity[light]);
    let most = rays.rows();
    let (path, ox, oy, oz, dx, dy, dz, reach, r, g, b) = rays.slices_mut(most);
    let mut at = length;
    for &row in rows {
        let surface = surfaces.get(row as usize);
        let aimed = aim(&surface, position);
        let distance_squared = aimed.distance * aimed.distance;
        let colour = materials.colour[surface.material as usize];
        let brings = reflected_radiance(colour, intensity, aimed.cosine, distance_squared);
        path[at] = row;
        (ox[at], oy[at], oz[at]) = aimed.origin.into();
        (dx[at], dy[at], dz[at]) = aimed.direction.into();
        reach[at] = shadow_reach(aimed.distance);
        (r[at], g[at], b[at]) = (brings[0] as f32, brings[1] as f32, brings[2] as f32);
        at += usize::from(aimed.cosine > 0.0);
    }
    if !lights.casts_shadows[light] {
        reach[length..at].fill(0.0);
    }
    at
}

// ANCHOR: add_light
/// Adds what each light ray brings to its path, unless something stands in between.
pub fn add_light(mut tiles: Query<(&LightRays, Option<&ShadowHits>, &mut Radiance)>) {
    for (rays, hits, mut radiance) in &mut tiles {
        for ray in 0..rays.rows() {
            if hits.is_some_and(|hits| hits.shape[ray] != NO_SHAPE) {
                continue;
            }
            let path = rays.path[ray] as usize;
            radiance.r[path] += rays.r[ray];
            radiance.g[path] += rays.g[ray];
            radiance.b[path] += rays.b[ray];
        }
    }
}
// ANCHOR_END: add_light

/// The stage that aims.
pub fn aim_stage() -> Stage {
    Stage::new("Aim at lights", TileSystems::Aim, aim_at_lights)
        .reads::<Surfaces>()
        .reads::<MaterialRows>()
        .writes::<LightRays>()
        .table::<PointLightTable>()
        .table::<MaterialTable>()
        .when(lit_evidence)
}

/// The stage that adds.
pub fn light_stage() -> Stage {
    Stage::new("Add the light that arrives", TileSystems::Shade, add_light)
        .kind(StageKind::Alternative)
        .reads::<LightRays>()
        .reads_if::<ShadowHits>()
        .reads::<Radiance>()
        .writes::<Radiance>()
        .when(lit_evidence)
}

/// Evidence that there is a light and material that it can fall on.
pub fn lit_evidence(scene: &World) -> Evidence {
    Evidence::of::<PointLight>(scene, "point light").and(material_evidence(scene))
}
