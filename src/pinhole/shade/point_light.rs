use super::light::{LightRay, LightRows, RayLists, aim, append_rays, shadow_t_max};
use super::{LightPdfs, LightRays};
use crate::extract::{PointLightTable, material_evidence, unless_occlusion};
use crate::intersect::{MaterialRows, ShadingNormals, Surfaces};
use crate::plan::{Evidence, Shared, Stage, TileSystems};
use crate::scene::PointLight;
use bevy_ecs::prelude::*;
use multiversion::multiversion;

// ANCHOR: irradiance_from_point
/// What a surface receives of a point light's intensity I: I cos θ / d².
///
/// The light thins out with the square of the distance and with the slant at which it falls.
#[inline(always)]
pub fn irradiance_from_point(intensity: [f64; 3], cosine: f64, distance_squared: f64) -> [f64; 3] {
    let share = cosine / distance_squared;
    [intensity[0] * share, intensity[1] * share, intensity[2] * share]
}
// ANCHOR_END: irradiance_from_point

/// Appends a tile's rays to point lights, light after light.
pub fn sample_point_lights(
    lights: Res<Shared<PointLightTable>>,
    mut tiles: Query<(&Surfaces, Option<&ShadingNormals>, &MaterialRows, &mut LightRays, Option<&mut LightPdfs>)>,
) {
    for (surfaces, shading, list, mut rays, mut pdfs) in &mut tiles {
        let lit = LightRows { surfaces, shading, rows: &list.row };
        for light in 0..lights.position.len() {
            aim_rows(&lit, &lights, light, (&mut rays, pdfs.as_deref_mut()));
        }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn aim_rows(lit: &LightRows<'_>, lights: &PointLightTable, light: usize, rays: RayLists<'_>) {
    let (position, intensity) = (lights.position[light], lights.intensity[light]);
    append_rays(lit, rays, lights.casts_shadows[light], |surface, normal| {
        let aimed = aim(surface, normal, position);
        let irradiance = irradiance_from_point(intensity, aimed.cosine, aimed.distance * aimed.distance);
        LightRay { aimed, reach: shadow_t_max(aimed.distance), irradiance }
    });
}

/// The stage on offer.
pub fn point_light_stage() -> Stage {
    Stage::new("Sample point lights", TileSystems::SampleLights, sample_point_lights).appends::<LightRays>().when(
        |scene| {
            unless_occlusion(scene, Evidence::of::<PointLight>(scene, "point light").and(|| material_evidence(scene)))
        },
    )
}
