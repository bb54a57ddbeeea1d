//! The reader's function in the picture of chapter 27: light that is connected to the camera.

use super::question::Input;
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use pinhole::extract::CameraJoinTable;
use pinhole::plan::{Column, Shared};
use pinhole::rays::join_camera;
use pinhole::shade;
use pinhole::shade::LightRays;
use pinhole_lab::exercise::{Ask, Setting, StandIn};

/// What pixels get of the light that reaches a surface from a light; rows are paths here, and no pixel is known yet.
pub fn mine(ask: Ask<Input, f64>, _: &Setting<'_>) -> StandIn {
    StandIn::after(
        shade::camera_join_stage,
        move |camera: Res<Shared<CameraJoinTable>>, mut tiles: Query<&mut LightRays>| {
            for mut rays in &mut tiles {
                for ray in 0..rays.rows() {
                    let from = DVec3::new(f64::from(rays.ox[ray]), f64::from(rays.oy[ray]), f64::from(rays.oz[ray]));
                    let Some(joined) = join_camera(&camera, DVec2::ZERO, from) else { continue };
                    let point = (camera.camera_from_world * from).into();
                    let asked = (point, camera.half_height, camera.size.y);
                    let Some(fraction) = ask.once(asked) else { continue };
                    let more = (fraction / joined.importance) as f32;
                    let rays = &mut *rays;
                    [&mut rays.r, &mut rays.g, &mut rays.b].into_iter().for_each(|part| part[ray] *= more);
                }
            }
        },
    )
}
