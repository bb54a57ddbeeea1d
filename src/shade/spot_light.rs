use super::light::{LightRay, aim, append_rays, shadow_reach};
use super::{LightRays, irradiance_from_point};
use crate::extract::{SpotLightTable, material_evidence};
use crate::intersect::{MaterialRows, ShadingNormals, Surfaces};
use crate::plan::{Evidence, Shared, Stage, TileSystems};
use crate::scene::SpotLight;
use bevy_ecs::prelude::*;
use glam::DVec3;

// ANCHOR: versine
/// 1 − cos of the angle between two unit vectors: half the square of what lies between their tips.
///
/// The cosine itself would lose the angle in a narrow cone, where it is 1 but for its last digits.
#[inline(always)]
pub fn versine(a: DVec3, b: DVec3) -> f64 {
    0.5 * (a - b).length_squared()
}
// ANCHOR_END: versine

// ANCHOR: spot_share
/// The share of a spot light's intensity that is left where 1 − cos θ is `versine`: 1 in the inner cone, 0 beyond the
/// outer one, 3s² − 2s³ between, with s the share of the way from the outer edge to the inner.
///
/// All sharing is in 1 − cos, so the solid angle is shared evenly, and the light's whole power is πI(inner + outer).
#[inline(always)]
pub fn spot_share(versine: f64, inner: f64, outer: f64) -> f64 {
    let s = (outer - versine) / (outer - inner);
    if s >= 1.0 {
        1.0
    } else if s > 0.0 {
        s * s * (3.0 - 2.0 * s)
    } else {
        0.0
    }
}
// ANCHOR_END: spot_share

/// Appends a tile's rays to spot lights, light after light; a surface outside the cone gets none.
pub fn aim_at_spot_lights(
    lights: Res<Shared<SpotLightTable>>,
    mut tiles: Query<(&Surfaces, Option<&ShadingNormals>, &MaterialRows, &mut LightRays)>,
) {
    for (surfaces, shading, list, mut rays) in &mut tiles {
        for (light, &position) in lights.position.iter().enumerate() {
            let (axis, inner, outer) = (lights.axis[light], lights.inner[light], lights.outer[light]);
            append_rays(surfaces, shading, &list.row, &mut rays, lights.casts_shadows[light], |surface, shading| {
                let mut aimed = aim(surface, shading, position);
                // The direction of f32 is too coarse for narrow cones.
                let along = (aimed.origin.as_dvec3() - position) * (1.0 / aimed.distance);
                let share = spot_share(versine(along, axis), inner, outer);
                let intensity = lights.intensity[light].map(|part| part * share);
                let irradiance = irradiance_from_point(intensity, aimed.cosine, aimed.distance * aimed.distance);
                aimed.cosine = if share > 0.0 { aimed.cosine } else { 0.0 };
                LightRay { aimed, reach: shadow_reach(aimed.distance), irradiance }
            });
        }
    }
}

/// The stage on offer.
pub fn spot_light_stage() -> Stage {
    Stage::new("Aim at spot lights", TileSystems::Aim, aim_at_spot_lights)
        .reads::<Surfaces>()
        .reads_if::<ShadingNormals>()
        .reads::<MaterialRows>()
        .appends::<LightRays>()
        .table::<SpotLightTable>()
        .when(|scene| Evidence::of::<SpotLight>(scene, "spot light").and(material_evidence(scene)))
}
