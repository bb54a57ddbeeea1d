//! The reader's function in the picture of chapter 11: directions that were told in another program's axes.

use super::question::{Input, Vector};
use bevy_ecs::prelude::*;
use pinhole::plan::Column;
use pinhole::rays;
use pinhole::rays::CameraRays;
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};

/// Every camera ray's direction, told with x left, y down and z ahead, and turned back by the reader's function.
pub fn mine(ask: Ask<Input, Vector>, _: &Setting<'_>) -> StandIn {
    StandIn::after(rays::perspective_stage, move |mut tiles: Query<(RowPlaces, &mut CameraRays)>| {
        for (place, mut rays) in &mut tiles {
            for row in 0..rays.rows() {
                let theirs = [-rays.dx[row], -rays.dy[row], -rays.dz[row]];
                if let Some(direction) = ask.at(place, row, (theirs, false, false, true)) {
                    (rays.dx[row], rays.dy[row], rays.dz[row]) = direction.into();
                }
            }
        }
    })
}
