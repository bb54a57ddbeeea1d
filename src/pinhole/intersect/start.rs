use super::hits::NO_PRIMITIVE;
use super::{HitPrimitives, Hits, NO_SHAPE};
use crate::extract::shape_evidence;
use crate::plan::{Column, Stage, TileSystems};
use crate::rays::WorldRays;
use bevy_ecs::prelude::*;

/// Sets every row of a tile's hits to a miss.
pub fn start_hits(mut tiles: Query<(&WorldRays, &mut Hits, Option<&mut HitPrimitives>)>) {
    for (rays, mut hits, primitives) in &mut tiles {
        if let Some(mut primitives) = primitives {
            primitives.slices_mut(rays.rows()).fill(NO_PRIMITIVE);
        }
        let (t, shape) = hits.slices_mut(rays.rows());
        t.fill(f64::INFINITY);
        shape.fill(NO_SHAPE);
    }
}

/// The stage that runs this system.
pub fn start_stage() -> Stage {
    Stage::new("Clear hits", TileSystems::Start, start_hits).when(shape_evidence)
}
