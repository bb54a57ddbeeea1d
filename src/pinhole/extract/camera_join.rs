use super::cameras::camera_spread;
use super::integrator::no_image_plane;
use super::{CameraAxes, FilterTable, LensTable, lens_evidence, radius_of};
use crate::cameras::{ImageFrame, RaySpread};
use crate::plan::{Census, Table};
use crate::scene::SceneError;
use glam::{DMat3, DVec2};

/// The camera's projection in the reverse direction, for connecting points to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraJoinTable {
    /// Rows: the camera's axes as unit vectors in world space.
    pub camera_from_world: DMat3,
    /// Whether its rays start at the eye or on its lens; otherwise they start on the orthographic window and are
    /// parallel.
    pub is_perspective: bool,
    /// Half the height of the image plane at distance 1, or of the orthographic window.
    pub half_height: f64,
    /// Distance from the eye to the plane of focus along the camera's axis, in scene units; infinite without a lens.
    pub focus_distance: f64,
    /// The resolution: pixels from left to right and from top to bottom.
    pub size: DVec2,
    /// How far outside the image a point still contributes to pixels through their filter, in pixels.
    pub margin: f64,
}

impl CameraJoinTable {
    /// The area of a pixel on the image plane at distance 1, or on the orthographic window in square scene units.
    #[inline(always)]
    pub fn pixel_area(&self) -> f64 {
        let side = 2.0 * self.half_height / self.size.y;
        side * side
    }
}

impl Table for CameraJoinTable {
    const NAME: &'static str = "join to the camera";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let image = scene.table::<ImageFrame>()?;
        let (is_perspective, half_height) = match camera_spread(scene)? {
            RaySpread::Central(half_height) => (true, half_height),
            RaySpread::Parallel(half_height) => (false, half_height),
            RaySpread::Angular(_) => return no_image_plane(scene),
        };
        let lens = lens_evidence(scene).needed.then(|| scene.table::<LensTable>()).transpose()?;
        Ok(Self {
            camera_from_world: scene.table::<CameraAxes>()?.world_from_camera.transpose(),
            is_perspective,
            half_height,
            focus_distance: lens.map_or(f64::INFINITY, |lens| lens.focus_distance),
            size: image.size(),
            margin: radius_of(scene.table::<FilterTable>()?.filter),
        })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}
