use super::{CameraRays, ScreenPoints};
use crate::extract::ImageFrame;
use crate::plan::{Column, Evidence, Shared, Stage, StageKind, TileSystems};
use crate::scene::EquirectangularCamera;
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

// ANCHOR: camera_ray_equirectangular
/// The direction of a screen point of an equirectangular image: x is the longitude, y the latitude.
///
/// A point beyond the upper or the lower edge, where wide filters place some, lies beyond the pole.
#[inline(always)]
pub fn camera_ray_equirectangular(screen: DVec2, aspect: f64) -> DVec3 {
    let (sine, cosine) = libm::sincos(screen.x / aspect * PI);
    let (up, across) = libm::sincos(screen.y * (PI / 2.0));
    DVec3::new(across * sine, up, -across * cosine)
}
// ANCHOR_END: camera_ray_equirectangular

/// The screen point at which an equirectangular image shows a direction: the inverse of `camera_ray_equirectangular`.
pub fn screen_from_equirectangular(direction: DVec3, aspect: f64) -> DVec2 {
    let longitude = libm::atan2(direction.x, -direction.z);
    let latitude = libm::atan2(direction.y, libm::hypot(direction.x, direction.z));
    DVec2::new(longitude / PI * aspect, latitude / (PI / 2.0))
}

/// Fills a tile's camera rays for an equirectangular camera; their origins stay 0.
pub fn fill_equirectangular(image: Res<Shared<ImageFrame>>, mut tiles: Query<(&ScreenPoints, &mut CameraRays)>) {
    for (screen, mut rays) in &mut tiles {
        let (x, y) = screen.slices();
        let (_, _, _, dx, dy, dz) = rays.slices_mut(screen.rows());
        for row in 0..screen.rows() {
            let direction = camera_ray_equirectangular(DVec2::new(x[row], y[row]), image.aspect());
            (dx[row], dy[row], dz[row]) = (direction.x, direction.y, direction.z);
        }
    }
}

/// The stage for equirectangular cameras.
pub fn equirectangular_stage() -> Stage {
    Stage::new("Generate camera rays: equirectangular", TileSystems::Camera, fill_equirectangular)
        .kind(StageKind::Alternative)
        .when(|scene| Evidence::of::<EquirectangularCamera>(scene, "equirectangular camera"))
}
