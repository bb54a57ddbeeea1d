use super::{MirrorRows, Scattered, ScatteredRay, mirror_direction};
use crate::extract::{MirrorTable, followed_evidence, mirror_evidence};
use crate::intersect::{ShadingNormals, Surfaces, offset_origin};
use crate::plan::{Shared, Stage, TileSystems};
use crate::rays::{Paths, WorldRays};
use bevy_ecs::prelude::*;
use glam::DVec3;

/// The normal that light is mirrored by: the one to shade by, or the surface's own where by the other it would be
/// mirrored into the surface.
#[inline(always)]
pub(super) fn mirroring_normal(shading: Option<&ShadingNormals>, row: usize, own: DVec3, direction: DVec3) -> DVec3 {
    let normal = shading.map_or(own, |normals| normals.get(row));
    if mirror_direction(direction, normal).dot(own) > 0.0 { normal } else { own }
}

// ANCHOR: scatter_mirror
/// Sends a ray on from every mirror, the only one that there is.
pub fn scatter_mirror(
    mirrors: Res<Shared<MirrorTable>>,
    mut tiles: Query<((&WorldRays, &Paths), (&Surfaces, Option<&ShadingNormals>, &MirrorRows), &mut Scattered)>,
) {
    for ((rays, paths), (surfaces, shading, list), mut scattered) in &mut tiles {
        scattered.append(&list.row, |number, row| {
            let (surface, direction) = (surfaces.get(row), rays.direction_of(row));
            let normal = mirroring_normal(shading, row, surface.normal.as_dvec3(), direction);
            let (share, colour) = (paths.throughput(row), mirrors.colour[list.of[number] as usize]);
            ScatteredRay {
                origin: offset_origin(surface.position, surface.normal, surface.bound),
                direction: mirror_direction(direction, normal),
                share: [0, 1, 2].map(|part| share[part] * colour[part]),
                pdf: f64::INFINITY,
            }
        });
    }
}
// ANCHOR_END: scatter_mirror

/// The stage on offer.
pub fn mirror_stage() -> Stage {
    Stage::new("Sample BSDFs: mirror", TileSystems::SampleBsdfs, scatter_mirror)
        .appends::<Scattered>()
        .when(|scene| mirror_evidence(scene).and(|| followed_evidence(scene)))
}
