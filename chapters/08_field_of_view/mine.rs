//! The reader's function in the picture of chapter 08: how wide the camera sees.

use super::question::Input;
use bevy_ecs::prelude::*;
use glam::DVec2;
use pinhole::extract::tan_half;
use pinhole::plan::Column;
use pinhole::rays;
use pinhole::rays::{CameraRays, ScreenPoints, camera_ray_perspective};
use pinhole::scene::{Degrees, PerspectiveCamera};
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};

/// Directions of camera rays, by the vertical angle that the reader's function makes of the scene's.
pub fn mine(ask: Ask<Input, f64>, setting: &Setting<'_>) -> StandIn {
    let size = setting.resolution();
    let PerspectiveCamera { fov, axis } = setting.camera().copied().unwrap_or_default();
    StandIn::after(rays::perspective_stage, move |mut tiles: Query<(RowPlaces, &ScreenPoints, &mut CameraRays)>| {
        for (place, screen, mut rays) in &mut tiles {
            let Some(vertical) = ask.at(place, 0, (fov.0, axis, size.width, size.height)) else { continue };
            let tangent = tan_half(Degrees(vertical));
            for row in 0..screen.rows() {
                let direction = camera_ray_perspective(DVec2::new(screen.x[row], screen.y[row]), tangent);
                (rays.dx[row], rays.dy[row], rays.dz[row]) = direction.into();
            }
        }
    })
}
