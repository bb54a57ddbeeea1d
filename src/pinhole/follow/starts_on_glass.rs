//! Paths that start on the surface of glass, and shadow rays that end close to one.

use super::interface::{Interface, InterfaceView};
use crate::each::Each;
use crate::extract::{
    GlassBody, GlassBodyTable, GlassStart, GlassStartTable, GlassTable, MaterialTable, NO_ROW,
    end_close_to_glass_evidence, followed_evidence, list_around, start_on_glass_evidence,
};
use crate::intersect::{NO_SHAPE, Surfaces};
use crate::plan::{Column, Shared, Stage, TileSystems, VectorRowsMut};
use crate::rays::{RayTimes, WorldRays};
use crate::shade::{ShadowHits, ShadowRays, light_distance, shadow_evidence};
use bevy_ecs::prelude::*;
use glam::DVec3;

/// How far from its light a shadow ray may end, as a fraction of its length and of the light's distance from the eye: more
/// than f32 rounds its direction by.
const BESIDE: f64 = 1e-5;

/// Moves the origin of each ray that starts on a surface of glass along the ray, to the side of that surface that it
/// leads to: so the media around its origin are those ahead of it, and it does not hit the surface again.
pub fn leave_glass_at_start(
    (bodies, starts): (Res<Shared<GlassBodyTable>>, Res<Shared<GlassStartTable>>),
    mut tiles: Query<(&mut WorldRays, Option<&RayTimes>)>,
) {
    let step_at = |origin: DVec3| {
        let own = starts.row.iter().find(|start| start.position == origin);
        own.or(starts.row.first()).map_or(0.0, |start| start.step)
    };
    for (mut rays, times) in &mut tiles {
        for row in 0..rays.rows() {
            let (origin, direction) = (rays.origin_of(row), rays.direction_of(row));
            let (time, step) = (times.map_or(0.0, |times| times.time[row]), step_at(origin));
            let [ahead, behind] = [1.0, -1.0].each(|sign| origin + sign * step * direction);
            let is_near = |body: &&GlassBody| body.bounds.contains(ahead) || body.bounds.contains(behind);
            let mut near = bodies.row.iter().filter(is_near);
            if near.any(|body| body.windings(ahead, time) != body.windings(behind, time)) {
                rays.origin.put(row, ahead.as_vec3());
            }
        }
    }
}

// ANCHOR: block_across_surfaces
/// Blocks each shadow ray that ends in another medium than it starts in: a surface of glass is between its ends, though so
/// close to the light that the ray, which ends a little before it, has not hit it.
///
/// That light is refracted, and paths from the light bring it.
pub fn block_across_surfaces(
    (bodies, ends): (Res<Shared<GlassBodyTable>>, Res<Shared<GlassStartTable>>),
    (glass, materials): (Res<Shared<GlassTable>>, Res<Shared<MaterialTable>>),
    mut around: Local<Vec<u32>>,
    mut tiles: Query<(&Surfaces, InterfaceView, Option<&RayTimes>, Option<&ShadowHits>, &mut ShadowRays)>,
) {
    for (surfaces, interface, times, hits, mut rays) in &mut tiles {
        let interface = Interface::new(interface, Some(&glass));
        for ray in 0..rays.rows() {
            // A light without shadows, of t_max 0, shines through everything; a distant one is in no glass.
            let t_max = rays.t_max[ray];
            if t_max == 0.0 || t_max == f32::INFINITY || hits.is_some_and(|hits| hits.shape[ray] != NO_SHAPE) {
                continue;
            }
            let (direction, distance) = (rays.direction_of(ray), light_distance(t_max));
            let end = rays.origin_of(ray) + distance * direction;
            let off = |start: &GlassStart| (start.position - end).length();
            let is_end = |start: &&GlassStart| off(start) <= BESIDE * (distance + start.position.length());
            let found = ends.row.iter().filter(is_end).min_by(|a, b| off(a).total_cmp(&off(b)));
            let Some(light) = found else { continue };
            let row = rays.row[ray] as usize;
            let surface = surfaces.get(row);
            let [near, far] = interface.media(materials.interior[surface.material as usize], row);
            let is_behind = direction.dot(surface.normal.as_dvec3()) < 0.0;
            let before_light = light.position - light.step * direction;
            list_around(&bodies.row, &glass, (before_light, times.map_or(0.0, |times| times.time[row])), &mut around);
            if around.first().copied().unwrap_or(NO_ROW) != if is_behind { far } else { near } {
                rays.irradiance.put(ray, [0.0; 3]);
            }
        }
    }
}
// ANCHOR_END: block_across_surfaces

/// The stage that runs [`leave_glass_at_start`].
pub fn leave_glass_at_start_stage() -> Stage {
    Stage::new("Start rays off the surfaces of glass", TileSystems::Start, leave_glass_at_start)
        .on_first_bounce()
        .when(|scene| start_on_glass_evidence(scene).and(|| followed_evidence(scene)))
}

/// The stage that runs [`block_across_surfaces`].
pub fn block_across_surfaces_stage() -> Stage {
    Stage::new("Block light across surfaces beside lights", TileSystems::AbsorbShadowRays, block_across_surfaces).when(
        |scene| {
            let close = end_close_to_glass_evidence(scene).and(|| followed_evidence(scene));
            close.and(|| shadow_evidence(scene))
        },
    )
}
