use super::Radiance;
use crate::extract::{EmissiveTable, emissive_evidence, followed_evidence, unless_occlusion};
use crate::intersect::EmissiveRows;
use crate::plan::{Evidence, Shared, Stage, TileSystems};
use bevy_ecs::prelude::*;

// ANCHOR: add_emission
/// Adds what the surface that a ray hit emits; where it came from does not matter.
pub fn add_emission(emissive: Res<Shared<EmissiveTable>>, mut tiles: Query<(&EmissiveRows, &mut Radiance)>) {
    for (list, mut radiance) in &mut tiles {
        for (&row, &of) in list.row.iter().zip(&list.emissive) {
            let (row, [r, g, b]) = (row as usize, emissive.radiance[of as usize]);
            radiance.r[row] += r;
            radiance.g[row] += g;
            radiance.b[row] += b;
        }
    }
}
// ANCHOR_END: add_emission

/// The stage on offer.
pub fn emissive_stage() -> Stage {
    Stage::new("Add what surfaces emit", TileSystems::Shade, add_emission)
        .reads::<EmissiveRows>()
        .reads::<Radiance>()
        .writes::<Radiance>()
        .table::<EmissiveTable>()
        .when(|scene| {
            let found = emissive_evidence(scene);
            let alone = found.needed && !followed_evidence(scene).needed;
            let unlit = if alone { ", seen, but lighting nothing else" } else { "" };
            unless_occlusion(scene, Evidence { reason: format!("{}{unlit}", found.reason), ..found })
        })
}
