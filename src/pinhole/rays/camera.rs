use super::ScreenPoints;
use crate::cameras::{
    Camera, CameraRaySlices, Listed, OrthographicWindow, PerspectiveProjection, ScreenSlices, with_cameras,
};
use crate::each::Each;
use crate::extract::lens_evidence;
use crate::plan::{Column, Evidence, Shared, Stage, StageKind, TileSystems, VectorRows, column};
use bevy_ecs::prelude::*;
use glam::DVec3;

column! {
    /// Camera rays in camera space, where the camera is at the origin and looks down −z; directions are unit vectors.
    pub struct CameraRays("camera", "camera", "scene units", Ray) {
        /// Where the ray starts.
        origin: DVec3 as [ox, oy, oz],
        /// Where it goes.
        direction: DVec3 as [dx, dy, dz],
    }
}

impl CameraRays {
    /// Paints the direction: each component from −1 to 1 is mapped to 0 to 1.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        self.direction.at(row).each(|component| (0.5 + 0.5 * component) as f32)
    }
}

/// Generates a tile's camera rays; what the camera does not write stays 0.
pub fn generate_camera_rays<C: Listed>(projection: Res<Shared<C>>, mut tiles: Query<(&ScreenPoints, &mut CameraRays)>) {
    for (screen, mut rays) in &mut tiles {
        let [x, y] = screen.slices();
        let (origin, direction) = rays.slices_mut(screen.rows());
        projection.generate(ScreenSlices { x, y }, CameraRaySlices { origin, direction });
    }
}

/// The stage for cameras of one kind, where no lens takes their place.
pub fn camera_stage<C: Listed>() -> Stage {
    Stage::new(C::NAMES.stage, TileSystems::Camera, generate_camera_rays::<C>).kind(StageKind::Alternative).when(
        |scene| {
            let camera = Evidence::of::<C::Component>(scene, &format!("{} camera", C::NAMES.noun));
            match lens_evidence(scene) {
                lens if camera.needed && lens.needed => Evidence { needed: false, ..lens },
                _ => camera,
            }
        },
    )
}

macro_rules! stages {
    ($($component:ident($camera:ty) $noun:literal,)+) => {
        /// The stages of all cameras, each with whether its rays pass through a plane or a window.
        pub fn camera_stages() -> Vec<(bool, fn() -> Stage)> {
            vec![$((<$camera>::HAS_IMAGE_PLANE, camera_stage::<$camera>)),+]
        }
    };
}
with_cameras!(stages);

/// The stage for perspective cameras without a lens.
pub fn perspective_stage() -> Stage {
    camera_stage::<PerspectiveProjection>()
}

/// The stage for orthographic cameras.
pub fn orthographic_stage() -> Stage {
    camera_stage::<OrthographicWindow>()
}
