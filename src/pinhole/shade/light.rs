use crate::each::Each;
use crate::extract::{
    area_light_evidence, delta_light_evidence, environment_light_evidence, joined_evidence, light_sampling_evidence,
    material_evidence, occlusion_evidence, unless_occlusion,
};
use crate::intersect::{RayColumn, Surface, falling_cosine};
use crate::plan::{Census, Evidence, Stage, TileSystems, VectorRows, VectorRowsMut, column};
use crate::rays::ray_vectors;
use crate::shapes::RaySlices;
use bevy_ecs::prelude::*;
use glam::{DVec3, Vec3};

column! {
    /// Shadow rays from surfaces to the lights that they face, light after light, with the irradiance that each carries
    /// if it is not blocked.
    pub struct ShadowRays("shadow ray", "world, from the eye", "scene units", Ray, begun in Start) {
        /// The row of the tile whose surface it starts on.
        row: u32,
        /// Where the ray starts: off the surface by its error bound.
        origin: Vec3 as [ox, oy, oz],
        /// The direction to the light; a unit vector.
        direction: Vec3 as [dx, dy, dz],
        /// The distance up to which a shape blocks the ray; 0 for a light without shadows.
        t_max: f32,
        /// The irradiance at its surface if it is not blocked.
        irradiance: [f32; 3] as [r, g, b],
    }
}

column! {
    /// The pdf of each shadow ray, row by row as in [`ShadowRays`]; exists where something reads it.
    pub struct LightPdfs("light pdf", "directions", "1/sr", Ray) {
        /// The row of the tile whose surface the shadow ray starts on.
        row: u32,
        /// In 1/sr, including the probability of choosing that light; 0 for a light without an area, which BSDF
        /// sampling cannot find.
        pdf: f64,
    }
}

impl LightPdfs {
    /// Grey, brighter where the pdf is higher.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [(self.pdf[row] / (1.0 + self.pdf[row])) as f32; 3]
    }
}

ray_vectors!(ShadowRays);

impl ShadowRays {
    /// The direction, each component mapped from [−1, 1] to [0, 1].
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        self.direction.at(row).each(|part| 0.5 + 0.5 * part)
    }

    /// Multiplies a ray's irradiance by a weight, colour by colour.
    #[inline(always)]
    pub fn weight_by(&mut self, ray: usize, weight: [f64; 3]) {
        let carried = self.irradiance(ray);
        self.irradiance.put(ray, [0, 1, 2].each(|part| (f64::from(carried[part]) * weight[part]) as f32));
    }
}

impl RayColumn for ShadowRays {
    fn ray_components(&self) -> RaySlices<'_> {
        let (_, origin, direction, ..) = self.slices();
        RaySlices { origin, direction }
    }

    fn path_component(&self) -> Option<&[u32]> {
        Some(&self.row)
    }
}

/// The geometry of a ray from a surface to a light.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ShadowRay {
    pub origin: Vec3,
    pub direction: Vec3,
    pub distance: f64,
    /// Cosine of the angle between the shading normal and the direction; at most 0 where the surface faces away.
    pub cosine: f64,
}

/// The cosine by the shading normal, or 0 where the light is behind the geometric surface.
#[inline(always)]
pub(super) fn cosine_of(surface: &Surface, normal: DVec3, direction: Vec3) -> f64 {
    falling_cosine(surface.normal.as_dvec3(), normal, direction.as_dvec3())
}

// ANCHOR: shadow_t_max
/// The t_max of a shadow ray: slightly less than the distance to the light, by more than the error of its direction's
/// length.
#[inline(always)]
pub fn shadow_t_max(distance: f64) -> f32 {
    (distance * (1.0 - f64::from(f32::EPSILON) * 4.0)) as f32
}
// ANCHOR_END: shadow_t_max

/// The distance to a light, of which [`shadow_t_max`] made this t_max.
#[inline(always)]
pub fn light_distance(t_max: f32) -> f64 {
    f64::from(t_max) / (1.0 - f64::from(f32::EPSILON) * 4.0)
}

/// Clears every tile's list of shadow rays.
pub fn start_shadow_rays(mut tiles: Query<(&mut ShadowRays, Option<&mut LightPdfs>)>) {
    for (mut rays, pdfs) in &mut tiles {
        rays.clear();
        if let Some(mut pdfs) = pdfs {
            pdfs.clear();
        }
    }
}

/// The stage that clears the list.
pub fn start_shadow_rays_stage() -> Stage {
    Stage::new("Clear shadow rays", TileSystems::Start, start_shadow_rays)
        .when(|scene| either(lit_evidence(scene), occlusion_evidence(scene)))
}

/// The first evidence where it is needed, or else the second.
///
/// Unlike `or`, it does not name an integrator that the scene does not have.
pub(super) fn either(one: Evidence, other: Evidence) -> Evidence {
    if !one.needed && other.needed { other } else { one }
}

/// Evidence that there is a light, and a material that it can illuminate.
pub fn lit_evidence(scene: &Census<'_>) -> Evidence {
    light_evidence(scene).and(|| material_evidence(scene))
}

/// Evidence that there is a light of any kind to which shadow rays are traced.
pub fn light_evidence(scene: &Census<'_>) -> Evidence {
    let sampled = unless_occlusion(scene, or_light(scene, delta_light_evidence(scene, "light", |_| true)));
    either(sampled, joined_evidence(scene))
}

/// The evidence of lights without an area, or else that there are others and they are sampled.
pub(super) fn or_light(scene: &Census<'_>, points: Evidence) -> Evidence {
    let others =
        area_light_evidence(scene).or(environment_light_evidence(scene)).and(|| light_sampling_evidence(scene));
    if others.needed { points.or(others) } else { points }
}
