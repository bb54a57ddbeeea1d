//! Points of the world on the image, as a textbook has it: chapters 6 to 9 in the other direction; and what goes wrong
//! without clipping, and with a depth that is taken for linear.

use glam::{DVec2, DVec3};

// ANCHOR: plain_raster_from_world
/// Where the image shows a point in front of the camera, in pixels.
///
/// The axes are the camera's in the world, unit vectors to the right, up and back; `tan_half` is the tangent of half the
/// vertical angle.
#[must_use]
pub fn raster_from_world(point: DVec3, eye: DVec3, axes: [DVec3; 3], tan_half: f64, size: DVec2) -> DVec2 {
    // World to camera: subtract the eye, then see how far it is along each axis.
    let [x, y, z] = axes.map(|axis| axis.dot(point - eye));
    // Camera to clip: w is the depth, and the image's edges are at ±w.
    let clip = DVec2::new(x / (tan_half * size.x / size.y), y / tan_half);
    let w = -z;
    // Clip to NDC: divide, and turn y downward.
    let ndc = DVec2::new(0.5 + 0.5 * clip.x / w, 0.5 - 0.5 * clip.y / w);
    // NDC to raster: to pixels.
    ndc * size
}
// ANCHOR_END: plain_raster_from_world

// ANCHOR: plain_clip_edge
/// The part of an edge in camera space that is in front of the near plane.
#[must_use]
pub fn clip_edge([from, to]: [DVec3; 2], near: f64) -> Option<[DVec3; 2]> {
    let (at_from, at_to) = (-from.z - near, -to.z - near);
    let crossing = || from + (to - from) * (at_from / (at_from - at_to));
    match (at_from >= 0.0, at_to >= 0.0) {
        (true, true) => Some([from, to]),
        (true, false) => Some([from, crossing()]),
        (false, true) => Some([crossing(), to]),
        (false, false) => None,
    }
}
// ANCHOR_END: plain_clip_edge

// ANCHOR: depth_between
/// The depth at a place between two points of the image, 0 at the first and 1 at the second: 1/z is linear there.
#[must_use]
pub fn depth_between([first, second]: [f64; 2], place: f64) -> f64 {
    1.0 / ((1.0 - place) / first + place / second)
}
// ANCHOR_END: depth_between

/// The part of a line of the image inside a picture from (0, 0) to its size.
#[must_use]
pub fn clip_to_picture([mut from, mut to]: [DVec2; 2], size: DVec2) -> Option<[DVec2; 2]> {
    for (axis, sign, edge) in [(0, 1.0, 0.0), (0, -1.0, size.x), (1, 1.0, 0.0), (1, -1.0, size.y)] {
        let side = |point: DVec2| edge + sign * point[axis];
        let (at_from, at_to) = (side(from), side(to));
        let crossing = from + (to - from) * (at_from / (at_from - at_to));
        match (at_from >= 0.0, at_to >= 0.0) {
            (true, true) => {}
            (true, false) => to = crossing,
            (false, true) => from = crossing,
            (false, false) => return None,
        }
    }
    Some([from, to])
}

/// Whether a point is inside a convex polygon, its corners in either direction.
#[must_use]
pub fn is_inside(corners: &[DVec2], point: DVec2) -> bool {
    let areas = (0..corners.len()).map(|corner| {
        let [from, to] = [corners[corner], corners[(corner + 1) % corners.len()]];
        (to - from).perp_dot(point - from)
    });
    let (mut left, mut right) = (false, false);
    for area in areas {
        (left, right) = (left | (area > 0.0), right | (area < 0.0));
    }
    !corners.is_empty() && left != right
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat3;
    use pinhole::cameras::camera_ray_perspective;
    use pinhole::rasterise::{clip_from_camera, ndc_from_clip, raster_from_ndc};
    use pinhole::rays::{ndc_from_raster, screen_from_ndc};

    /// Chapters 6 to 9 forwards, from a pixel to a point on its ray; then back.
    #[test]
    fn a_point_on_a_ray_comes_back_to_where_the_ray_went_through() {
        let (eye, tan_half, size) = (DVec3::new(3.0, -1.0, 2.0), 0.4, DVec2::new(480.0, 270.0));
        let turn = DMat3::from_cols_array(&[2.0, 2.0, 1.0, -2.0, 1.0, 2.0, 1.0, -2.0, 2.0]) * (1.0 / 3.0);
        for step in 0..200 {
            let raster = size * DVec2::new((f64::from(step) * 0.618).fract(), (f64::from(step) * 0.414).fract());
            let screen = screen_from_ndc(ndc_from_raster(raster, size), size.x / size.y);
            let point = eye + turn * camera_ray_perspective(screen, tan_half) * (0.1 + f64::from(step));
            let axes = [turn.x_axis, turn.y_axis, turn.z_axis];
            assert!((raster_from_world(point, eye, axes, tan_half, size) - raster).length() < 1e-9);
            let clip = clip_from_camera(turn.transpose() * (point - eye), DVec2::new(16.0 / 9.0, 1.0) * tan_half, true);
            assert!((raster_from_ndc(ndc_from_clip(clip), size) - raster).length() < 1e-9);
        }
    }

    #[test]
    fn the_page_s_numbers() {
        // A camera at (0, 1, 4) that looks along −z, with half a unit to the image's upper edge at distance 1.
        let (eye, size) = (DVec3::new(0.0, 1.0, 4.0), DVec2::new(200.0, 100.0));
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let raster = |point| raster_from_world(point, eye, axes, 0.5, size);
        assert_eq!(raster(DVec3::new(1.0, 2.0, 0.0)), DVec2::new(125.0, 25.0));
        // As far behind the camera: turned about the image's middle.
        assert_eq!(raster(DVec3::new(1.0, 2.0, 8.0)), DVec2::new(75.0, 75.0));
        assert!((depth_between([2.0, 10.0], 0.5) - 10.0 / 3.0).abs() < 1e-15);
        let edge = [DVec3::new(0.0, -1.0, -3.0), DVec3::new(0.0, -1.0, 1.0)];
        assert_eq!(clip_edge(edge, 1.0), Some([edge[0], DVec3::new(0.0, -1.0, -1.0)]));
        assert_eq!(clip_edge([edge[1], edge[1] * 2.0], 1.0), None);
    }

    #[test]
    fn lines_and_polygons_of_the_image() {
        let size = DVec2::new(4.0, 2.0);
        let line = [DVec2::new(-2.0, 1.0), DVec2::new(8.0, 1.0)];
        assert_eq!(clip_to_picture(line, size), Some([DVec2::new(0.0, 1.0), DVec2::new(4.0, 1.0)]));
        assert_eq!(clip_to_picture(line.map(|point| point + DVec2::Y * 3.0), size), None);
        let square = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
        assert!(is_inside(&square, DVec2::splat(0.5)) && !is_inside(&square, DVec2::splat(1.5)));
        assert!(!is_inside(&[], DVec2::ZERO));
    }
}
