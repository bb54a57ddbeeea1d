//! Where a camera ray hits the plane of a raster triangle.

use super::spaces::Projection;
use super::triangle::{NearnessPlane, within};
use glam::{DMat3, DVec3};

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
        let [right, up, back] = [0, 1, 2].map(|row| camera_from_world.row(row));
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
