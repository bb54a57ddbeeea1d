use super::ScreenPoints;
use crate::extract::{OrthographicWindow, PerspectiveProjection, lens_evidence};
use crate::plan::{Column, Evidence, Shared, Stage, StageKind, TileSystems, column};
use crate::scene::{OrthographicCamera, PerspectiveCamera};
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use multiversion::multiversion;

column! {
    /// Camera rays in camera space, where the camera is at the origin and looks down −z; directions are unit vectors.
    pub struct CameraRays("camera", "camera", "scene units", Ray) {
        /// Origin, x: to the right.
        ox: f64,
        /// Origin, y: upward.
        oy: f64,
        /// Origin, z: backward.
        oz: f64,
        /// Direction, x: to the right.
        dx: f64,
        /// Direction, y: upward.
        dy: f64,
        /// Direction, z: backward.
        dz: f64,
    }
}

impl CameraRays {
    /// Paints the direction: each component from −1 to 1 is mapped to 0 to 1.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.dx[row], self.dy[row], self.dz[row]].map(|component| (0.5 + 0.5 * component) as f32)
    }
}

// ANCHOR: camera_ray_perspective
/// The direction from the eye at the origin through a screen point on the image plane at z = −1.
#[inline(always)]
pub fn camera_ray_perspective(screen: DVec2, tan_half_vertical: f64) -> DVec3 {
    let point = DVec3::new(screen.x * tan_half_vertical, screen.y * tan_half_vertical, -1.0);
    point / (point.x * point.x + point.y * point.y + 1.0).sqrt()
}
// ANCHOR_END: camera_ray_perspective

// ANCHOR: camera_ray_orthographic
/// The origin, in camera space, of the ray through a screen point of an orthographic camera; its direction is −z.
#[inline(always)]
pub fn camera_ray_orthographic(screen: DVec2, half_height: f64) -> DVec3 {
    DVec3::new(screen.x * half_height, screen.y * half_height, 0.0)
}
// ANCHOR_END: camera_ray_orthographic

/// Fills a tile's camera rays for a perspective camera; their origins stay 0.
pub fn fill_perspective(
    projection: Res<Shared<PerspectiveProjection>>,
    mut tiles: Query<(&ScreenPoints, &mut CameraRays)>,
) {
    for (screen, mut rays) in &mut tiles {
        perspective_rows(screen, projection.tan_half_vertical, &mut rays);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn perspective_rows(screen: &ScreenPoints, tan_half_vertical: f64, rays: &mut CameraRays) {
    let rows = screen.rows();
    let (x, y) = screen.slices();
    let (_, _, _, dx, dy, dz) = rays.slices_mut(rows);
    for row in 0..rows {
        let direction = camera_ray_perspective(DVec2::new(x[row], y[row]), tan_half_vertical);
        (dx[row], dy[row], dz[row]) = (direction.x, direction.y, direction.z);
    }
}

/// Fills a tile's camera rays for an orthographic camera; their directions are all −z.
pub fn fill_orthographic(window: Res<Shared<OrthographicWindow>>, mut tiles: Query<(&ScreenPoints, &mut CameraRays)>) {
    for (screen, mut rays) in &mut tiles {
        let rows = screen.rows();
        let (x, y) = screen.slices();
        let (ox, oy, _, _, _, dz) = rays.slices_mut(rows);
        for row in 0..rows {
            let origin = camera_ray_orthographic(DVec2::new(x[row], y[row]), window.half_height);
            (ox[row], oy[row], dz[row]) = (origin.x, origin.y, -1.0);
        }
    }
}

/// The stage for perspective cameras without a lens.
pub fn perspective_stage() -> Stage {
    Stage::new("Generate camera rays: perspective", TileSystems::Camera, fill_perspective)
        .kind(StageKind::Alternative)
        .when(|scene| match lens_evidence(scene) {
            lens if lens.needed => Evidence { needed: false, ..lens },
            _ => Evidence::of::<PerspectiveCamera>(scene, "perspective camera"),
        })
}

/// The stage for orthographic cameras.
pub fn orthographic_stage() -> Stage {
    Stage::new("Generate camera rays: orthographic", TileSystems::Camera, fill_orthographic)
        .kind(StageKind::Alternative)
        .when(|scene| Evidence::of::<OrthographicCamera>(scene, "orthographic camera"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_centre_looks_straight_ahead_to_the_last_bit() {
        assert_eq!(camera_ray_perspective(DVec2::ZERO, 0.7), DVec3::NEG_Z);
    }

    #[test]
    fn with_a_field_of_view_of_90_degrees_the_edge_is_at_45_degrees() {
        let direction = camera_ray_perspective(DVec2::Y, crate::extract::tan_half(crate::scene::Degrees(90.0)));
        assert!((direction.y + direction.z).abs() < 1e-15 && (direction.length() - 1.0).abs() < 1e-15);
    }
}
