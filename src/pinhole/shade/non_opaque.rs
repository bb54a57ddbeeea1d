//! Rays and surfaces that are not opaque everywhere: where they are, they are hit; elsewhere rays go on.

use super::maps::looked_up;
use super::{ShadowHits, ShadowRays, shadow_evidence};
use crate::extract::{Coverage, NO_TEXTURE, NonOpaqueTable, SamplingTable, TexturePoint, non_opaque_evidence};
use crate::intersect::{HitColumn, HitPrimitives, Hits, NO_SHAPE, RayColumn};
use crate::plan::{Shared, Stage, TileSystems};
use crate::rays::{SampleNumber, WorldRays};
use crate::sample::unit_of_ray;
use crate::shapes::{ClosestHit, RayHit, SurfacePoint};
use bevy_ecs::prelude::*;
use glam::DVec3;

/// How far beyond a surface that it passes a ray is continued, in error bounds of the surface along its normal.
const BEYOND: f64 = 2.0;
/// The lowest cosine between a ray and a normal that is taken as it is: beyond it, the step along the ray would be far
/// longer than the surface is thick.
const GRAZING: f64 = 1.0 / (1 << 20) as f64;

/// Intersects any column of rays with all shapes that are not opaque everywhere, and keeps the closest opaque hits.
///
/// What is not opaque is never a hit (an any-hit test), instead of being removed from hits afterwards: so all that is made
/// of hits, the weights of light samples among it, is as if the surface had been cut out.
pub fn intersect_non_opaque<R: RayColumn, H: HitColumn>(
    shapes: Res<Shared<NonOpaqueTable>>,
    sampling: Res<Shared<SamplingTable>>,
    mut tiles: Query<(&R, Option<&SampleNumber>, &mut H, Option<&mut HitPrimitives>)>,
) {
    for (rays, number, mut hits, mut primitives) in &mut tiles {
        let mut hits = hits.closest_hits();
        // Those of the tile's own rays; any hit blocks a shadow ray.
        let mut primitives = primitives.as_mut().filter(|_| !hits.any);
        hits.primitive = primitives.as_mut().map(|primitives| primitives.slices_mut(hits.t.len()));
        let salt = sampling.seed ^ u64::from(number.map_or(0, |number| number.0)) << 32;
        let rays = rays.ray_components();
        for row in 0..hits.t.len() {
            let (ray, mut closest) = (rays.ray(row), hits.get(row));
            for one in 0..shapes.body.len() {
                if closest.any && closest.shape != NO_SHAPE {
                    break;
                }
                let hit = first_opaque_hit((&shapes, one), ray, closest, salt);
                if let Some((t, primitive)) = hit {
                    (closest.t, closest.shape, closest.primitive) = (t, shapes.shape[one], primitive);
                }
            }
            hits.set(row, closest);
        }
    }
}

// ANCHOR: first_opaque_hit
/// The nearest hit of a ray with a shape at which the shape is opaque to it, and which primitive it hits; none if it is not
/// closer than the closest so far.
fn first_opaque_hit(
    (shapes, one): (&NonOpaqueTable, usize),
    [origin, direction]: [DVec3; 2],
    closest: ClosestHit,
    salt: u64,
) -> Option<(f64, u32)> {
    let (body, coverage, mut from) = (&shapes.body[one], &shapes.coverage[one], 0.0);
    for layer in 0.. {
        let start = origin + from * direction;
        let t = body.t(start, direction);
        let at = from + t;

        // At equal distances the lowest number wins, as in every kernel, so that the order of the stages does not matter.
        let wins_tie = at == closest.t && shapes.shape[one] < closest.shape && at < f64::INFINITY;
        if !(at < closest.t || wins_tie) {
            break;
        }
        let primitive = body.primitive_at(start, direction, t);
        let hit = RayHit { primitive, ..RayHit::at_rest(origin, direction, at) };
        let surface = body.surface(&hit);

        // A number is drawn only between the two: a hash of the ray, so that the same ray decides the same in every pass.
        let is_opaque = match opacity_at(shapes, one, &hit, &surface, coverage) {
            opacity if opacity <= 0.0 => false,
            opacity if opacity >= 1.0 => true,
            opacity => {
                let place = u64::from(shapes.shape[one]) | layer << 32;
                unit_of_ray([origin, direction], salt ^ place) < opacity
            }
        };
        if is_opaque {
            return Some((at, primitive));
        }

        // It is continued along itself, so that t needs no correction, from where the same surface is certain to be behind.
        let across = surface.normal.dot(direction).abs().max(GRAZING * direction.length());
        from = (at + BEYOND * f64::from(surface.bound) / across).max(at.next_up());
    }
    None
}
// ANCHOR_END: first_opaque_hit

/// The opacity of a surface at a hit, as seen from where the ray comes.
#[inline(always)]
fn opacity_at(
    shapes: &NonOpaqueTable,
    one: usize,
    hit: &RayHit,
    surface: &SurfacePoint,
    &Coverage { opacity, image, single_sided }: &Coverage,
) -> f64 {
    if single_sided && !surface.outside {
        return 0.0;
    }
    if image == NO_TEXTURE {
        return opacity.with(1.0);
    }
    let own =
        shapes.uv_spaces.as_deref().map_or(DVec3::ZERO, |spaces| spaces.point(shapes.shape[one] as usize, hit.point()));
    let [u, v] = shapes.body[one].uv(hit, surface.at, own);
    let at = TexturePoint { point: DVec3::new(u, v, 0.0), steps: [DVec3::ZERO; 2] };
    opacity.with(looked_up(&shapes.images, image as usize, at)[0])
}

/// The stage that intersects camera rays.
pub fn non_opaque_stage() -> Stage {
    let intersect = intersect_non_opaque::<WorldRays, Hits>;
    Stage::new("Intersect non-opaque shapes", TileSystems::Intersect, intersect).when(non_opaque_evidence)
}

/// The stage that intersects shadow rays.
pub fn non_opaque_shadow_stage() -> Stage {
    let intersect = intersect_non_opaque::<ShadowRays, ShadowHits>;
    Stage::new("Trace shadow rays: non-opaque shapes", TileSystems::TraceShadowRays, intersect)
        .when(|scene| non_opaque_evidence(scene).and(|| shadow_evidence(scene)))
}
