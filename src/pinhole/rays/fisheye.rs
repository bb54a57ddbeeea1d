use super::{CameraRays, ScreenPoints};
use crate::extract::{ImageCircle, fisheye_evidence};
use crate::plan::{Column, Shared, Stage, StageKind, TileSystems};
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};

// ANCHOR: camera_ray_fisheye
/// The direction of a screen point of an equidistant fisheye: its angle from the axis is proportional to the point's
/// distance from the centre.
///
/// Beyond the edge of the image circle it is the direction of the edge; those pixels are masked later.
#[inline(always)]
pub fn camera_ray_fisheye(screen: DVec2, circle: &ImageCircle) -> DVec3 {
    let distance = screen.length();
    if distance == 0.0 {
        return DVec3::NEG_Z;
    }
    let angle = (distance / circle.radius).min(1.0) * circle.half_angle;
    let (sine, cosine) = libm::sincos(angle);
    DVec3::new(sine * (screen.x / distance), sine * (screen.y / distance), -cosine)
}
// ANCHOR_END: camera_ray_fisheye

/// The screen point at which a fisheye shows a direction: the inverse of `camera_ray_fisheye`.
pub fn screen_from_fisheye(direction: DVec3, circle: &ImageCircle) -> DVec2 {
    let across = libm::hypot(direction.x, direction.y);
    let angle = libm::atan2(across, -direction.z);
    let radial = if across > 0.0 { DVec2::new(direction.x, direction.y) / across } else { DVec2::X };
    radial * (angle / circle.half_angle * circle.radius)
}

/// Fills a tile's camera rays for a fisheye; their origins stay 0.
pub fn fill_fisheye(circle: Res<Shared<ImageCircle>>, mut tiles: Query<(&ScreenPoints, &mut CameraRays)>) {
    for (screen, mut rays) in &mut tiles {
        let (x, y) = screen.slices();
        let (_, _, _, dx, dy, dz) = rays.slices_mut(screen.rows());
        for row in 0..screen.rows() {
            let direction = camera_ray_fisheye(DVec2::new(x[row], y[row]), &circle);
            (dx[row], dy[row], dz[row]) = (direction.x, direction.y, direction.z);
        }
    }
}

/// The stage for fisheye cameras.
pub fn fisheye_stage() -> Stage {
    Stage::new("Generate camera rays: fisheye", TileSystems::Camera, fill_fisheye)
        .kind(StageKind::Alternative)
        .when(fisheye_evidence)
}
