use super::{Radiance, ShadowHits};
use crate::extract::{MatteTable, PointLightTable, matte_evidence};
use crate::intersect::{MatteRows, NO_SHAPE, RayColumn, RayLanes, Surface, Surfaces, offset_origin};
use crate::plan::{Column, Evidence, Shared, Stage, StageKind, TileSystems, column};
use crate::scene::PointLight;
use bevy_ecs::prelude::*;
use glam::{DVec3, Vec3};
use multiversion::multiversion;

/// Surfaces aimed from together.
const LANES: usize = 16;

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

impl LightRays {
    #[inline(always)]
    fn push(&mut self, path: u32, aimed: &Aimed, reach: f32, brings: [f64; 3]) {
        self.path.push(path);
        self.ox.push(aimed.origin.x);
        self.oy.push(aimed.origin.y);
        self.oz.push(aimed.origin.z);
        self.dx.push(aimed.direction.x);
        self.dy.push(aimed.direction.y);
        self.dz.push(aimed.direction.z);
        self.reach.push(reach);
        self.r.push(brings[0] as f32);
        self.g.push(brings[1] as f32);
        self.b.push(brings[2] as f32);
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

/// How far a shadow ray looks: a little short of the light, by more than its direction's length can be off.
#[inline(always)]
pub fn shadow_reach(distance: f64) -> f32 {
    (distance * (1.0 - f64::from(f32::EPSILON) * 4.0)) as f32
}

/// Fills a tile's light rays.
pub fn aim_at_lights(
    lights: Res<Shared<PointLightTable>>,
    mattes: Res<Shared<MatteTable>>,
    mut tiles: Query<(&Surfaces, &MatteRows, &mut LightRays)>,
) {
    for (surfaces, list, mut rays) in &mut tiles {
        rays.clear();
        for light in 0..lights.position.len() {
            for rows in list.row.chunks(LANES) {
                aim_rows(surfaces, rows, &lights, light, &mattes, &mut rays);
            }
        }
    }
}

/// Aims from a few surfaces at once, then keeps those that face the light.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn aim_rows(
    surfaces: &Surfaces,
    rows: &[u32],
    lights: &PointLightTable,
    light: usize,
    mattes: &MatteTable,
    rays: &mut LightRays,
) {
    let mut near = [Surface::default(); LANES];
    for (surface, &row) in near.iter_mut().zip(rows) {
        *surface = surfaces.get(row as usize);
    }
    let aimed = near.map(|surface| aim(&surface, lights.position[light]));
    for ((&row, aimed), surface) in rows.iter().zip(aimed).zip(near) {
        if aimed.cosine > 0.0 {
            let colour = mattes.colour[surface.matte as usize];
            let distance_squared = aimed.distance * aimed.distance;
            let brings = reflected_radiance(colour, lights.intensity[light], aimed.cosine, distance_squared);
            let reach = if lights.casts_shadows[light] { shadow_reach(aimed.distance) } else { 0.0 };
            rays.push(row, &aimed, reach, brings);
        }
    }
}

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

/// The stage that aims.
pub fn aim_stage() -> Stage {
    Stage::new("Aim at lights", TileSystems::Aim, aim_at_lights)
        .reads::<Surfaces>()
        .reads::<MatteRows>()
        .writes::<LightRays>()
        .table::<PointLightTable>()
        .table::<MatteTable>()
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

/// Evidence that there is a light and matter that it can fall on.
pub fn lit_evidence(scene: &World) -> Evidence {
    Evidence::of::<PointLight>(scene, "point light").and(matte_evidence(scene))
}
