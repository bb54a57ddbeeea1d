use super::LightRays;
use super::light::{Aimed, LightRay, LitRows, append_chosen, shadow_reach};
use crate::extract::{CameraJoinTable, traced_evidence};
use crate::intersect::{MaterialRows, ShadingNormals, Surfaces, falling_cosine, offset_origin};
use crate::plan::{Shared, Stage, StageKind, TileSystems};
use crate::rays::{WorldRays, join_camera};
use bevy_ecs::prelude::*;

/// What a surface that is shaded by another normal than its own sends to the camera of each unit of power, but for its
/// matter: cos θ to the camera by its own normal, times by how much the other normal changes the cosine of what falls.
///
/// Rays from the camera weigh the light that falls by the normal to shade by; so must rays from the light (Veach 1997,
/// 5.3.2).
#[inline(always)]
pub fn join_cosine(to_camera: f64, falling: f64, falling_by_shading: f64) -> f64 {
    if to_camera > 0.0 && falling > 0.0 { to_camera * (falling_by_shading / falling).max(0.0) } else { 0.0 }
}

// ANCHOR: aim_at_the_camera
/// Appends a ray to the camera from every surface that light from a lamp falls on, and what the pixel there makes of it.
///
/// The camera stands in for a light: what falls on the surface is known, and what it sends there is asked for; matter
/// answers the same either way.
pub fn aim_at_the_camera(
    join: Res<Shared<CameraJoinTable>>,
    mut tiles: Query<(&WorldRays, &Surfaces, Option<&ShadingNormals>, &MaterialRows, &mut LightRays)>,
) {
    for (arriving, surfaces, shading, list, mut rays) in &mut tiles {
        let lit = LitRows { surfaces, shading, rows: &list.row };
        append_chosen(&lit, (&mut rays, None), |row, surface, normal| {
            let origin = offset_origin(surface.position, surface.normal, surface.bound);
            let joined = join_camera(&join, origin.as_dvec3()).unwrap_or_default();
            let distance = joined.to_camera.length();
            let direction = (joined.to_camera * (1.0 / distance)).as_vec3();
            let (own, from) = (surface.normal.as_dvec3(), -arriving.direction_of(row));
            let seen = if distance > 0.0 { own.dot(direction.as_dvec3()) } else { 0.0 };
            let cosine = join_cosine(seen, own.dot(from), falling_cosine(own, normal, from));
            let aimed = Aimed { origin, direction, distance, cosine };
            (LightRay { aimed, reach: shadow_reach(distance), irradiance: [joined.importance * cosine; 3] }, 0.0)
        });
    }
}
// ANCHOR_END: aim_at_the_camera

/// The stage on offer.
pub fn camera_join_stage() -> Stage {
    Stage::new("Aim at the camera", TileSystems::Aim, aim_at_the_camera)
        .on_light_paths()
        .kind(StageKind::Alternative)
        .reads::<WorldRays>()
        .reads::<Surfaces>()
        .reads_if::<ShadingNormals>()
        .reads::<MaterialRows>()
        .appends::<LightRays>()
        .table::<CameraJoinTable>()
        .when(traced_evidence)
}
