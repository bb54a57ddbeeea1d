//! Disks and rectangles as first attempts have them.

use super::plane::hit_f32 as hit_plane_f32;
use glam::Vec3;

// ANCHOR: naive_hit_disk_f32
/// The t where the ray hits a disk, in f32: the textbook's plane, then the hit point's distance from the centre.
///
/// The hit point is off by the rounding of its coordinates, which grow with the distance while the disk does not; and a
/// floor keeps the plane's two constants.
#[must_use]
pub fn hit_disk_f32(origin: Vec3, direction: Vec3, centre: Vec3, normal: Vec3, along: [Vec3; 2]) -> Option<f32> {
    let (t, [x, z]) = crossing_f32(origin, direction, centre, normal, along)?;
    (x * x + z * z <= 1.0).then_some(t)
}
// ANCHOR_END: naive_hit_disk_f32

/// The t where the ray hits a rectangle, in f32, the same way.
#[must_use]
pub fn hit_rectangle_f32(origin: Vec3, direction: Vec3, centre: Vec3, normal: Vec3, along: [Vec3; 2]) -> Option<f32> {
    let (t, [x, z]) = crossing_f32(origin, direction, centre, normal, along)?;
    (x.abs() <= 1.0 && z.abs() <= 1.0).then_some(t)
}

fn crossing_f32(
    origin: Vec3,
    direction: Vec3,
    centre: Vec3,
    normal: Vec3,
    along: [Vec3; 2],
) -> Option<(f32, [f32; 2])> {
    let t = hit_plane_f32(origin, direction, normal, normal.dot(centre))?;
    let point = origin + t * direction;
    Some((t, along.map(|along| along.dot(point - centre))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_by_they_are_right_and_far_away_they_are_not() {
        let along = [Vec3::X, Vec3::Z];
        let below = Vec3::NEG_Y * 5.0;
        let at = |x: f32| hit_disk_f32(Vec3::X * x, Vec3::NEG_Y, below, Vec3::Y, along);
        assert_eq!((at(0.5), at(1.5)), (Some(5.0), None));
        assert_eq!(hit_rectangle_f32(Vec3::new(0.9, 0.0, 0.9), Vec3::NEG_Y, below, Vec3::Y, along), Some(5.0));
        assert_eq!(hit_rectangle_f32(Vec3::new(0.9, 0.0, 1.1), Vec3::NEG_Y, below, Vec3::Y, along), None);
        let far = Vec3::new(1e8, -5.0, 0.0);
        let beside = hit_disk_f32(Vec3::X * 1e8, Vec3::new(0.6, -0.8, 0.0), far, Vec3::Y, along);
        assert!(beside.is_some(), "3.75 beside the centre counts as within 1");
    }
}
