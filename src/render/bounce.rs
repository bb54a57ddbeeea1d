use crate::plan::Bounce;
use bevy_ecs::prelude::*;

/// Runs the schedule of further legs `legs` times: the loop inside a sample.
pub fn follow_bounces(world: &mut World, legs: u32) {
    for _ in 0..legs {
        world.run_schedule(Bounce);
    }
}
