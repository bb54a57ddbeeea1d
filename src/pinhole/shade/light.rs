use super::{Radiance, ShadowHits, SurfaceColours};
use crate::extract::{
    MaterialTable, area_light_evidence, environment_light_evidence, light_sampling_evidence, material_evidence,
    occlusion_evidence, traced_evidence, unless_occlusion,
};
use crate::intersect::{
    NO_SHAPE, RayColumn, RaySlices, ShadingNormals, Surface, Surfaces, falling_cosine, offset_origin,
};
use crate::plan::{Column, ComponentKind, Evidence, Shared, Stage, StageKind, TileSystems, column};
use crate::scene::{DirectionalLight, PointLight, SpotLight};
use bevy_ecs::prelude::*;
use glam::{DVec3, Vec3};

column! {
    /// Rays from surfaces towards lights that their side faces, light after light, and what each will bring if nothing is
    /// in the way.
    pub struct LightRays("light", "world, from the eye", "scene units", Ray, begun in Start) {
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
        /// The irradiance it brings to its surface, red.
        r: f32,
        /// Green.
        g: f32,
        /// Blue.
        b: f32,
    }
}

column! {
    /// How likely each light ray was to be sent where it goes; beside the light rays, where something reads it.
    pub struct LightPdfs("light pdf", "directions", "1/sr", Ray) {
        /// The row of the tile whose surface the light ray starts on.
        path: u32,
        /// Per unit of solid angle, the chance of having chosen that light included; 0 for a light without an area, which
        /// no other ray can find by chance.
        pdf: f64,
    }
}

impl LightPdfs {
    /// Grey, the brighter the likelier.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [(self.pdf[row] / (1.0 + self.pdf[row])) as f32; 3]
    }
}

impl LightRays {
    /// The direction: each part from −1 to 1 becomes 0 to 1.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.dx[row], self.dy[row], self.dz[row]].map(|part| 0.5 + 0.5 * part)
    }

    /// The direction of a ray, exact in f64.
    #[inline(always)]
    pub fn direction_of(&self, ray: usize) -> DVec3 {
        DVec3::new(f64::from(self.dx[ray]), f64::from(self.dy[ray]), f64::from(self.dz[ray]))
    }

    /// Lets a ray bring only this share of what it would.
    #[inline(always)]
    pub fn mis(&mut self, ray: usize, share: f64) {
        let weighed = |part: f32| (f64::from(part) * share) as f32;
        (self.r[ray], self.g[ray], self.b[ray]) = (weighed(self.r[ray]), weighed(self.g[ray]), weighed(self.b[ray]));
    }

    /// The irradiance that a ray brings.
    #[inline(always)]
    pub fn irradiance(&self, ray: usize) -> [f64; 3] {
        [f64::from(self.r[ray]), f64::from(self.g[ray]), f64::from(self.b[ray])]
    }
}

impl RayColumn for LightRays {
    fn ray_components(&self) -> RaySlices<'_> {
        RaySlices { origin: [&self.ox, &self.oy, &self.oz], direction: [&self.dx, &self.dy, &self.dz] }
    }

    fn path_component(&self) -> Option<&[u32]> {
        Some(&self.path)
    }
}

// ANCHOR: matte_radiance
/// What a matte surface sends towards the eye of the irradiance E that it receives: (colour / π) · E.
///
/// The same in all directions (Lambert): summed over the hemisphere, each direction by its cosine, it is colour · E.
#[inline(always)]
pub fn matte_radiance(colour: [f64; 3], irradiance: [f64; 3]) -> [f64; 3] {
    const SHARE: f64 = std::f64::consts::FRAC_1_PI;
    [colour[0] * irradiance[0] * SHARE, colour[1] * irradiance[1] * SHARE, colour[2] * irradiance[2] * SHARE]
}
// ANCHOR_END: matte_radiance

// ANCHOR: aim
/// A ray from a surface to a light.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ShadowRay {
    pub origin: Vec3,
    pub direction: Vec3,
    pub distance: f64,
    /// Of the angle between the shading normal and the direction; not above 0 where the surface faces away.
    pub cosine: f64,
}

/// Aims at a point; `normal` is the one to shade by, which is the surface's own where it has no other.
#[inline(always)]
pub(super) fn aim(surface: &Surface, normal: DVec3, light: DVec3) -> ShadowRay {
    let origin = offset_origin(surface.position, surface.normal, surface.bound);
    let to_light = light - origin.as_dvec3();
    let distance = to_light.length();
    let direction = (to_light * (1.0 / distance)).as_vec3();
    ShadowRay { origin, direction, distance, cosine: cosine_of(surface, normal, direction) }
}
// ANCHOR_END: aim

/// The cosine by the shading normal, or 0 where the light is behind the surface itself.
#[inline(always)]
pub(super) fn cosine_of(surface: &Surface, normal: DVec3, direction: Vec3) -> f64 {
    falling_cosine(surface.normal.as_dvec3(), normal, direction.as_dvec3())
}

// ANCHOR: shadow_t_max
/// How far a shadow ray looks: a little short of the light, by more than its direction's length can be off.
#[inline(always)]
pub fn shadow_t_max(distance: f64) -> f32 {
    (distance * (1.0 - f64::from(f32::EPSILON) * 4.0)) as f32
}
// ANCHOR_END: shadow_t_max

/// A ray to a light as a kind of light makes it, and the irradiance that it brings.
pub(super) struct LightRay {
    pub aimed: ShadowRay,
    pub reach: f32,
    pub irradiance: [f64; 3],
}

/// The surfaces that light may fall on.
pub(super) struct LightRows<'a> {
    pub surfaces: &'a Surfaces,
    pub shading: Option<&'a ShadingNormals>,
    pub rows: &'a [u32],
}

/// The lists that rays to lights are appended to.
pub(super) type RayLists<'a> = (&'a mut LightRays, Option<&'a mut LightPdfs>);

/// Aims from all surfaces of a list at one light and appends the rays that bring something.
///
/// A scene without shading normals has a loop of its own, that knows nothing of them.
#[inline(always)]
pub(super) fn append_rays(
    lit: &LightRows<'_>,
    (rays, pdfs): RayLists<'_>,
    casts_shadows: bool,
    ray_of: impl Fn(&Surface, DVec3) -> LightRay,
) {
    let surfaces = lit.surfaces;
    match lit.shading {
        None => append(lit.rows, rays, casts_shadows, |row| {
            let surface = surfaces.get(row);
            ray_of(&surface, surface.normal.as_dvec3())
        }),
        Some(normals) => {
            append(lit.rows, rays, casts_shadows, |row| ray_of(&surfaces.get(row), normals.get(row)));
        }
    }
    if let Some(pdfs) = pdfs {
        let (path, _) = pdfs.slices_mut(rays.rows());
        path.copy_from_slice(&rays.path);
    }
}

/// Every row is written and the next one overwrites it unless it counts, so that no branch depends on the surface.
#[inline(always)]
fn append(rows: &[u32], rays: &mut LightRays, casts_shadows: bool, ray_of: impl Fn(usize) -> LightRay) {
    let length = rays.rows();
    let (path, ox, oy, oz, dx, dy, dz, reach, r, g, b) = rays.slices_mut(length + rows.len());
    let mut at = length;
    for &row in rows {
        let ray = ray_of(row as usize);
        path[at] = row;
        (ox[at], oy[at], oz[at]) = ray.aimed.origin.into();
        (dx[at], dy[at], dz[at]) = ray.aimed.direction.into();
        reach[at] = ray.reach;
        [r[at], g[at], b[at]] = ray.irradiance.map(|part| part.min(MOST) as f32);
        // Nearer than that the square of the distance is no ordinary number; no direction leads there.
        let apart = ray.aimed.distance * ray.aimed.distance >= f64::MIN_POSITIVE;
        at += usize::from(ray.aimed.cosine > 0.0 && apart);
    }
    if !casts_shadows {
        reach[length..at].fill(0.0);
    }
    rays.slices_mut(at);
}

/// Appends one ray a row whose direction was chosen, and beside it how likely that was; all cast shadows.
///
/// `ray_of` gets the row, the surface and the normal to shade by.
#[inline(always)]
pub(super) fn append_chosen(
    lit: &LightRows<'_>,
    (rays, mut pdfs): RayLists<'_>,
    ray_of: impl Fn(usize, &Surface, DVec3) -> (LightRay, f64),
) {
    let length = rays.rows();
    let most = length + lit.rows.len();
    let (path, ox, oy, oz, dx, dy, dz, reach, r, g, b) = rays.slices_mut(most);
    let mut likely = pdfs.as_deref_mut().map(|pdfs| pdfs.slices_mut(most));
    let mut at = length;
    for &row in lit.rows {
        let surface = lit.surfaces.get(row as usize);
        let normal = lit.shading.map_or_else(|| surface.normal.as_dvec3(), |shading| shading.get(row as usize));
        let (ray, pdf) = ray_of(row as usize, &surface, normal);
        path[at] = row;
        (ox[at], oy[at], oz[at]) = ray.aimed.origin.into();
        (dx[at], dy[at], dz[at]) = ray.aimed.direction.into();
        reach[at] = ray.reach;
        [r[at], g[at], b[at]] = ray.irradiance.map(|part| part.min(MOST) as f32);
        if let Some(likely) = &mut likely {
            (likely.0[at], likely.1[at]) = (row, pdf);
        }
        at += usize::from(ray.aimed.cosine > 0.0);
    }
    rays.slices_mut(at);
    if let Some(pdfs) = pdfs {
        pdfs.slices_mut(at);
    }
}

/// The most light that a ray brings: what is more than f32 holds counts as its largest number.
const MOST: f64 = f32::MAX as f64;

/// Empties every tile's list of light rays.
pub fn start_light(mut tiles: Query<(&mut LightRays, Option<&mut LightPdfs>)>) {
    for (mut rays, pdfs) in &mut tiles {
        rays.clear();
        if let Some(mut pdfs) = pdfs {
            pdfs.clear();
        }
    }
}

// ANCHOR: add_light
/// Adds what a matte surface sends on of each light ray's irradiance, unless something stands in between.
pub fn add_light(
    materials: Res<Shared<MaterialTable>>,
    mut tiles: Query<(&Surfaces, Option<&SurfaceColours>, &LightRays, Option<&ShadowHits>, &mut Radiance)>,
) {
    for (surfaces, colours, rays, hits, mut radiance) in &mut tiles {
        for ray in 0..rays.rows() {
            if hits.is_some_and(|hits| hits.shape[ray] != NO_SHAPE) {
                continue;
            }
            let path = rays.path[ray] as usize;
            let material = surfaces.material[path] as usize;
            let colour = colours.map_or_else(|| materials.colour[material], |colours| colours.get(path));
            let [r, g, b] = matte_radiance(colour, rays.irradiance(ray));
            radiance.r[path] += r as f32;
            radiance.g[path] += g as f32;
            radiance.b[path] += b as f32;
        }
    }
}
// ANCHOR_END: add_light

/// The stage that starts.
pub fn start_light_stage() -> Stage {
    Stage::new("Clear light rays", TileSystems::Start, start_light)
        .when(|scene| either(lit_evidence(scene), occlusion_evidence(scene)))
}

/// The stage that adds.
pub fn light_stage() -> Stage {
    Stage::new("Evaluate direct light", TileSystems::Shade, add_light).kind(StageKind::Alternative).when(lit_evidence)
}

/// Evidence of the one where it is needed, or else the other.
///
/// Unlike `or` it says nothing of an integrator that nobody asked for.
pub(super) fn either(one: Evidence, other: Evidence) -> Evidence {
    if !one.needed && other.needed { other } else { one }
}

/// Evidence that there is a light and material that it can fall on.
pub fn lit_evidence(scene: &World) -> Evidence {
    light_evidence(scene).and(|| material_evidence(scene))
}

/// Evidence that there is a light of any kind that rays are sent to.
pub(super) fn light_evidence(scene: &World) -> Evidence {
    let aimed_at = unless_occlusion(scene, or_light(scene, Evidence::among_any(scene, "light", &LIGHTS, |_| true)));
    either(aimed_at, traced_evidence(scene))
}

/// Evidence that there is a light without an area.
pub fn point_evidence(scene: &World) -> Evidence {
    Evidence::among_any(scene, "light without an area", &LIGHTS, |_| true)
}

/// The evidence of lights without an area, or else that there are others and that they are aimed at.
pub(super) fn or_light(scene: &World, points: Evidence) -> Evidence {
    let others =
        area_light_evidence(scene).or(environment_light_evidence(scene)).and(|| light_sampling_evidence(scene));
    if others.needed { points.or(others) } else { points }
}

/// Every component that is a light without an area; a new one joins here.
pub(super) const LIGHTS: [ComponentKind; 3] =
    [ComponentKind::of::<PointLight>(), ComponentKind::of::<DirectionalLight>(), ComponentKind::of::<SpotLight>()];
