//! The reader's function in the picture of chapter 02: camera rays of length 1.

use super::question::Vector;
use bevy_ecs::prelude::*;
use pinhole::extract::PerspectiveProjection;
use pinhole::plan::{Column, Shared};
use pinhole::rays;
use pinhole::rays::{CameraRays, ScreenPoints};
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};

/// The vector from the eye to a point of the image plane, brought to length 1 by the reader's function.
pub fn mine(ask: Ask<Vector, Option<Vector>>, _: &Setting<'_>) -> StandIn {
    StandIn::after(
        rays::perspective_stage,
        move |camera: Res<Shared<PerspectiveProjection>>,
              mut tiles: Query<(RowPlaces, &ScreenPoints, &mut CameraRays)>| {
            for (place, screen, mut rays) in &mut tiles {
                for row in 0..screen.rows() {
                    let tangent = camera.tan_half_vertical;
                    let point = [screen.x[row] * tangent, screen.y[row] * tangent, -1.0];
                    if let Some(direction) = ask.at(place, row, point) {
                        // Where there is no direction, no ray leaves.
                        (rays.dx[row], rays.dy[row], rays.dz[row]) = direction.unwrap_or_default().into();
                    }
                }
            }
        },
    )
}
