use super::{EmissionFactors, Radiance};
use crate::extract::{
    EmissiveTable, emissive_evidence, followed_evidence, light_sampling_evidence, one_sided_evidence, traced_evidence,
    unless_occlusion,
};
use crate::intersect::{EmissiveRows, SurfaceSides};
use crate::plan::{Evidence, Shared, Stage, StageKind, TileSystems};
use bevy_ecs::prelude::*;

// ANCHOR: add_emission
/// Adds the emission of the surface that a ray hit, on the side where it was hit; radiance does not depend on distance.
pub fn add_emission(
    emissive: Res<Shared<EmissiveTable>>,
    mut tiles: Query<(&EmissiveRows, Option<&SurfaceSides>, Option<&EmissionFactors>, &mut Radiance)>,
) {
    for (list, sides, factors, mut radiance) in &mut tiles {
        for (&row, &of) in list.row.iter().zip(&list.emissive) {
            let (row, [r, g, b]) = (row as usize, emissive.radiance[of as usize]);
            if sides.is_some_and(|sides| sides.outside[row] == 0 && emissive.one_sided[of as usize]) {
                continue;
            }
            let [r, g, b] = factors.map_or([r, g, b], |factors| factors.times(row, [r, g, b]));
            radiance.r[row] += r;
            radiance.g[row] += g;
            radiance.b[row] += b;
        }
    }
}
// ANCHOR_END: add_emission

/// The stage that runs [`add_emission`].
pub fn emissive_stage() -> Stage {
    Stage::new("Add emission", TileSystems::Shade, add_emission)
        .on_camera_paths()
        .kind(StageKind::Alternative)
        .reads_where::<SurfaceSides>(one_sided_evidence)
        .when(|scene| {
            let found = emissive_evidence(scene);
            let follows = followed_evidence(scene).needed;
            let traced = || traced_evidence(scene).needed;
            if found.needed && follows && (light_sampling_evidence(scene).needed || traced()) {
                let reason = "added with its MIS weight".into();
                return Evidence { needed: false, reason, count: 0 };
            }
            let unlit = if found.needed && !follows { ", seen, but not lighting other surfaces" } else { "" };
            unless_occlusion(scene, Evidence { reason: format!("{}{unlit}", found.reason), ..found })
        })
}
