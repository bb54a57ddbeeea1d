use crate::extract::{IntegratorTable, followed_evidence};
use crate::intersect::MaterialRows;
use crate::plan::{Shared, Stage, TileSystems};
use crate::rays::Depth;
use bevy_ecs::prelude::*;

/// At the maximum depth, surfaces are not lit: emission still counts, but no shadow ray is traced.
///
/// A shadow ray would add a segment beyond the maximum depth.
pub fn end_at_max_depth(integrator: Res<Shared<IntegratorTable>>, mut tiles: Query<(&Depth, &mut MaterialRows)>) {
    for (depth, mut list) in &mut tiles {
        if depth.0 + 1 >= integrator.max_depth {
            list.row.clear();
        }
    }
}

/// The stage that runs [`end_at_max_depth`].
pub fn max_depth_stage() -> Stage {
    Stage::new("End at the maximum depth", TileSystems::Classify, end_at_max_depth)
        .changes::<MaterialRows>()
        .when(followed_evidence)
}
