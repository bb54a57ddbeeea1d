use crate::extract::{IntegratorTable, followed_evidence};
use crate::intersect::MaterialRows;
use crate::plan::{Shared, Stage, TileSystems};
use crate::rays::Leg;
use bevy_ecs::prelude::*;

/// On the last leg light is only found, not sought: its surfaces are lit by nothing.
///
/// A ray to a light would be a leg more than a way may have.
pub fn end_at_last_leg(integrator: Res<Shared<IntegratorTable>>, mut tiles: Query<(&Leg, &mut MaterialRows)>) {
    for (leg, mut list) in &mut tiles {
        if leg.0 + 1 >= integrator.legs {
            list.row.clear();
        }
    }
}

/// The stage on offer.
pub fn last_leg_stage() -> Stage {
    Stage::new("End at the last leg", TileSystems::Classify, end_at_last_leg)
        .reads::<MaterialRows>()
        .writes::<MaterialRows>()
        .table::<IntegratorTable>()
        .when(followed_evidence)
}
