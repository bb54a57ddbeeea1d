use super::Radiance;
use crate::extract::{ImageCircle, fisheye_evidence};
use crate::plan::{Column, Shared, Stage, StageKind, TileSystems};
use crate::rays::ScreenPoints;
use bevy_ecs::prelude::*;
use glam::DVec2;

/// Whether a screen point is within the image circle of a fisheye camera, edge included.
#[inline(always)]
pub fn in_image_circle(screen: DVec2, circle: &ImageCircle) -> bool {
    screen.length() <= circle.radius
}

/// Blackens the samples outside a fisheye's image circle; they still count, so that its edge is antialiased.
pub fn mask_image_circle(circle: Res<Shared<ImageCircle>>, mut tiles: Query<(&ScreenPoints, &mut Radiance)>) {
    for (screen, mut radiance) in &mut tiles {
        let (x, y) = screen.slices();
        let (r, g, b) = radiance.slices_mut(screen.rows());
        for row in 0..screen.rows() {
            if !in_image_circle(DVec2::new(x[row], y[row]), &circle) {
                (r[row], g[row], b[row]) = (0.0, 0.0, 0.0);
            }
        }
    }
}

/// The stage that runs [`mask_image_circle`].
pub fn image_circle_stage() -> Stage {
    Stage::new("Mask the image circle", TileSystems::Mask, mask_image_circle)
        .kind(StageKind::Alternative)
        .when(fisheye_evidence)
}
