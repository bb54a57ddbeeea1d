//! A point of the world is projected onto the image: camera → clip → NDC → raster, the inverse of what camera rays are made
//! by.

use super::triangle::{NearnessPlane, within};
use crate::cameras::{ImageFrame, RaySpread};
use crate::each::Each;
use crate::extract::{CameraAxes, camera_spread, no_plane_to_rasterise};
use crate::plan::{Census, Table};
use crate::scene::SceneError;
use glam::{DMat3, DVec2, DVec3};

/// What projects points: the camera's axes and the extent of its image plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    /// Rows: the camera's axes as unit vectors in world space.
    pub camera_from_world: DMat3,
    /// Half the width and height of the image plane at distance 1, or of the orthographic window.
    pub half: DVec2,
    /// Whether all rays start at the eye; otherwise they are parallel.
    pub is_perspective: bool,
    /// The resolution: pixels from left to right and from top to bottom.
    pub size: DVec2,
}

/// A point in clip space: homogeneous coordinates of the image plane, with the depth beside them.
///
/// What is in the image satisfies −w ≤ x ≤ w and −w ≤ y ≤ w, which is linear even behind the camera, where the division
/// by w would mirror the point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ClipPoint {
    /// To the right.
    pub x: f64,
    /// Upward.
    pub y: f64,
    /// Depth along the camera's axis, in scene units; positive in front of the camera.
    pub depth: f64,
    /// What x and y are divided by: the depth for a perspective camera, 1 for an orthographic one.
    pub w: f64,
}

// ANCHOR: projection
/// Transforms a point from camera space to clip space.
///
/// The screen's edges become ±w: x is scaled by the plane's half width, y by its half height.
#[inline(always)]
pub fn clip_from_camera(camera: DVec3, half: DVec2, is_perspective: bool) -> ClipPoint {
    let depth = -camera.z;
    ClipPoint { x: camera.x / half.x, y: camera.y / half.y, depth, w: if is_perspective { depth } else { 1.0 } }
}

/// Transforms a point from clip space to NDC: the perspective division, and y turned downward.
#[inline(always)]
pub fn ndc_from_clip(clip: ClipPoint) -> DVec2 {
    DVec2::new(0.5 + 0.5 * (clip.x / clip.w), 0.5 - 0.5 * (clip.y / clip.w))
}

/// Transforms a point from NDC to raster space, by the image's size in pixels.
#[inline(always)]
pub fn raster_from_ndc(ndc: DVec2, size: DVec2) -> DVec2 {
    ndc * size
}
// ANCHOR_END: projection

impl Projection {
    /// The clip point of a point in render space.
    #[inline(always)]
    pub fn clip(&self, point: DVec3) -> ClipPoint {
        clip_from_camera(self.camera_from_world * point, self.half, self.is_perspective)
    }

    /// The raster point of a clip point in front of the camera.
    #[inline(always)]
    pub fn raster(&self, clip: ClipPoint) -> DVec2 {
        raster_from_ndc(ndc_from_clip(clip), self.size)
    }

    /// How near a clip point is: the depth's reciprocal for a perspective camera, and otherwise the negative depth.
    #[inline(always)]
    pub fn nearness(&self, clip: ClipPoint) -> f64 {
        if self.is_perspective { 1.0 / clip.depth } else { -clip.depth }
    }

    /// The point in camera space of a clip point.
    #[inline(always)]
    pub fn camera(&self, clip: ClipPoint) -> DVec3 {
        DVec3::new(clip.x * self.half.x, clip.y * self.half.y, -clip.depth)
    }
}

impl Table for Projection {
    const NAME: &'static str = "projection";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let image = scene.table::<ImageFrame>()?;
        let (is_perspective, half_height) = match camera_spread(scene)? {
            RaySpread::Central(half_height) => (true, half_height),
            RaySpread::Parallel(half_height) => (false, half_height),
            RaySpread::Angular(_) => return no_plane_to_rasterise(scene),
        };
        Ok(Self {
            camera_from_world: scene.table::<CameraAxes>()?.world_from_camera.transpose(),
            half: DVec2::new(half_height * image.aspect(), half_height),
            is_perspective,
            size: image.size(),
        })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

// Where a camera ray hits the plane of a raster triangle.

/// What takes rays of the image to homogeneous raster coordinates: with the pixels to the right and downward, each times
/// w, and w last.
///
/// For a perspective camera w is the depth; for an orthographic one raster coordinates are not divided, and the depth is
/// given in place of w.
#[derive(Clone, Copy, Debug)]
pub(super) struct RayProjection {
    /// The linear part.
    raster_from_world: DMat3,
    /// Where an orthographic camera's axis is in the image, in pixels.
    centre: DVec3,
    is_perspective: bool,
}

impl RayProjection {
    /// That of an image.
    pub fn new(&Projection { camera_from_world, half, is_perspective, size }: &Projection) -> Self {
        let [right, up, back] = [0, 1, 2].each(|row| camera_from_world.row(row));
        let centre = 0.5 * size;
        let (right, down) = (centre.x / half.x * right, -centre.y / half.y * up);
        let rows = match is_perspective {
            true => [right - centre.x * back, down - centre.y * back, -back],
            false => [right, down, -back],
        };
        let raster_from_world = DMat3::from_cols(rows[0], rows[1], rows[2]).transpose();
        Self { raster_from_world, centre: centre.extend(0.0), is_perspective }
    }

    /// The t at which a ray hits a plane; never nearer or farther than the triangle's vertices.
    ///
    /// Nearness is linear in the raster point. With q the sum of the plane's coefficients times the direction's
    /// homogeneous coordinates, and o that of the origin's, the perspective ray starts at the eye and has the nearness
    /// 1 / (t w) = q / w at t; the orthographic one has the depth o_w + t w there, which the plane says is −(o + t q).
    #[inline(always)]
    pub fn t(&self, [origin, direction]: [DVec3; 2], plane: &NearnessPlane) -> f64 {
        let along = self.raster_from_world * direction;
        let [right, down, at_corner] = plane.coefficients;
        let [nearest, farthest] = [plane.range[1], plane.range[0]];
        if self.is_perspective {
            let q = right * along.x + down * along.y + at_corner * along.z;
            return 1.0 / within(q, [farthest * along.z, nearest * along.z]);
        }
        let start = self.raster_from_world * origin + self.centre;
        let nearness = right * start.x + down * start.y + at_corner;
        let t = -(nearness + start.z) / (right * along.x + down * along.y + along.z);
        within(t, [(-nearest - start.z) / along.z, (-farthest - start.z) / along.z])
    }
}
