//! The reader's function in the picture of chapter 04: the rays of an orthographic camera.

use super::question::{Input, Ray};
use bevy_ecs::prelude::*;
use pinhole::extract::OrthographicWindow;
use pinhole::plan::{Column, Shared};
use pinhole::rays;
use pinhole::rays::{CameraRays, ScreenPoints};
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};

/// Origins and directions of camera rays.
pub fn mine(ask: Ask<Input, Ray>, _: &Setting<'_>) -> StandIn {
    StandIn::after(
        rays::orthographic_stage,
        move |view: Res<Shared<OrthographicWindow>>, mut tiles: Query<(RowPlaces, &ScreenPoints, &mut CameraRays)>| {
            for (place, screen, mut rays) in &mut tiles {
                for row in 0..screen.rows() {
                    let asked = ([screen.x[row], screen.y[row]], 2.0 * view.half_height);
                    if let Some((origin, direction)) = ask.at(place, row, asked) {
                        (rays.ox[row], rays.oy[row], rays.oz[row]) = origin.into();
                        (rays.dx[row], rays.dy[row], rays.dz[row]) = direction.into();
                    }
                }
            }
        },
    )
}
