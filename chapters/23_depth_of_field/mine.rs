//! The reader's function in the picture of chapter 23: the rays of a thin lens.

use super::question::Input;
use bevy_ecs::prelude::*;
use pinhole::extract::{LensTable, PerspectiveProjection};
use pinhole::plan::{Column, Shared};
use pinhole::rays;
use pinhole::rays::{CameraRays, LensPoints, ScreenPoints};
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};

/// Directions of rays from points of the lens.
pub fn mine(ask: Ask<Input, [f64; 3]>, _: &Setting<'_>) -> StandIn {
    StandIn::after(
        rays::lens_stage,
        move |(camera, lens): (Res<Shared<PerspectiveProjection>>, Res<Shared<LensTable>>),
              mut tiles: Query<(RowPlaces, &ScreenPoints, &LensPoints, &mut CameraRays)>| {
            for (place, screen, points, mut rays) in &mut tiles {
                for row in 0..screen.rows() {
                    let (at, point) = ([screen.x[row], screen.y[row]], [points.x[row], points.y[row]]);
                    let asked = (at, camera.tan_half_vertical, point, lens.focus_distance);
                    if let Some(direction) = ask.at(place, row, asked) {
                        (rays.dx[row], rays.dy[row], rays.dz[row]) = direction.into();
                    }
                }
            }
        },
    )
}
