use super::view::{BsdfView, BsdfViewItem};
use super::{MirrorRows, Scattered, ScatteredRay, mirror_direction};
use crate::extract::{MirrorTable, followed_evidence, mirror_evidence};
use crate::intersect::ShadingNormals;
use crate::plan::{Shared, Stage, TileSystems};
use crate::shapes::offset_origin;
use bevy_ecs::prelude::*;
use glam::DVec3;

/// The normal to reflect by: the shading normal, or the geometric one where reflection by the former would lead into
/// the surface.
#[inline(always)]
pub(super) fn mirroring_normal(shading: Option<&ShadingNormals>, row: usize, own: DVec3, direction: DVec3) -> DVec3 {
    let normal = shading.map_or(own, |normals| normals.get(row));
    if mirror_direction(direction, normal).dot(own) > 0.0 { normal } else { own }
}

// ANCHOR: sample_mirror
/// Reflects a ray from every mirror; the only direction of this specular BSDF.
pub fn sample_mirror(mirrors: Res<Shared<MirrorTable>>, mut tiles: Query<(BsdfView, &MirrorRows)>) {
    for (BsdfViewItem { rays, paths, surfaces, shading, mut scattered }, list) in &mut tiles {
        scattered.append(&list.row, |number, row| {
            let (surface, direction) = (surfaces.get(row), rays.direction_of(row));
            let normal = mirroring_normal(shading, row, surface.normal.as_dvec3(), direction);
            let (throughput, colour) = (paths.throughput(row), mirrors.colour[list.of[number] as usize]);
            ScatteredRay {
                origin: offset_origin(surface.position, surface.normal, surface.bound),
                direction: mirror_direction(direction, normal),
                throughput: [0, 1, 2].map(|part| throughput[part] * colour[part]),
                pdf: f64::INFINITY,
            }
        });
    }
}
// ANCHOR_END: sample_mirror

/// The stage that runs [`sample_mirror`].
pub fn mirror_stage() -> Stage {
    Stage::new("Sample BSDFs: mirror", TileSystems::SampleBsdfs, sample_mirror)
        .appends::<Scattered>()
        .when(|scene| mirror_evidence(scene).and(|| followed_evidence(scene)))
}
