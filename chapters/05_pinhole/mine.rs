//! The reader's function in the picture of chapter 05: the rays of a pinhole camera.

use super::question::Input;
use bevy_ecs::prelude::*;
use pinhole::extract::PerspectiveProjection;
use pinhole::plan::{Column, Shared};
use pinhole::rays;
use pinhole::rays::{CameraRays, ScreenPoints};
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};

/// Directions of camera rays.
pub fn mine(ask: Ask<Input, [f64; 3]>, _: &Setting<'_>) -> StandIn {
    StandIn::after(
        rays::perspective_stage,
        move |camera: Res<Shared<PerspectiveProjection>>,
              mut tiles: Query<(RowPlaces, &ScreenPoints, &mut CameraRays)>| {
            for (place, screen, mut rays) in &mut tiles {
                for row in 0..screen.rows() {
                    let asked = ([screen.x[row], screen.y[row]], camera.tan_half_vertical);
                    if let Some(direction) = ask.at(place, row, asked) {
                        (rays.dx[row], rays.dy[row], rays.dz[row]) = direction.into();
                    }
                }
            }
        },
    )
}
