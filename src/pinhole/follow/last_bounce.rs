use crate::extract::{IntegratorTable, followed_evidence};
use crate::intersect::MaterialRows;
use crate::plan::{Shared, Stage, TileSystems};
use crate::rays::Depth;
use bevy_ecs::prelude::*;

/// On the last leg light is only found, not sought: its surfaces are lit by nothing.
///
/// A ray to a light would be a leg more than a way may have.
pub fn end_at_max_depth(integrator: Res<Shared<IntegratorTable>>, mut tiles: Query<(&Depth, &mut MaterialRows)>) {
    for (depth, mut list) in &mut tiles {
        if depth.0 + 1 >= integrator.max_depth {
            list.row.clear();
        }
    }
}

/// The stage on offer.
pub fn max_depth_stage() -> Stage {
    Stage::new("End at the maximum depth", TileSystems::Classify, end_at_max_depth)
        .changes::<MaterialRows>()
        .when(followed_evidence)
}
