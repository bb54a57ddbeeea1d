//! Boxes as first attempts have them: the ray taken to the unit cube, in f32.

use glam::Vec3;

/// Half spacing of f32 numbers from 1 on.
const U: f32 = 1.0 / (1_u32 << 24) as f32;

// ANCHOR: naive_hit_cuboid_f32
/// The t where the ray hits the cube from −1 to 1, in f32, by slabs and the minimum and maximum of the processor.
///
/// A ray in the plane of a face multiplies 0 by ∞. `f32::min` and `f32::max` both pass over what is not a number and return
/// the other face's infinity: the ray counts as one that misses.
/// Edges are lost or gained by the rounding of each quotient.
#[must_use]
pub fn hit_f32(origin: Vec3, direction: Vec3) -> Option<f32> {
    nearest(slabs(origin, direction), 1.0)
}

fn slabs(origin: Vec3, direction: Vec3) -> [f32; 2] {
    let inverse = direction.recip();
    let (mut enters, mut leaves) = (f32::NEG_INFINITY, f32::INFINITY);
    for axis in 0..3 {
        let first = (-1.0 - origin[axis]) * inverse[axis];
        let second = (1.0 - origin[axis]) * inverse[axis];
        enters = enters.max(first.min(second));
        leaves = leaves.min(first.max(second));
    }
    [enters, leaves]
}
// ANCHOR_END: naive_hit_cuboid_f32

/// The same, the far side farther by 1 + 2γ₃ (Ize 2013): made for boxes about other things, where too many hits cost time
/// only; as a shape, the box has grown.
#[must_use]
pub fn hit_widened_f32(origin: Vec3, direction: Vec3) -> Option<f32> {
    nearest(slabs(origin, direction), 1.0 + 2.0 * (3.0 * U / (1.0 - 3.0 * U)))
}

fn nearest([enters, leaves]: [f32; 2], far: f32) -> Option<f32> {
    if enters > leaves * far {
        return None;
    }
    [enters, leaves].into_iter().find(|&t| t > 0.0 && t < f32::INFINITY)
}

/// The axis of the face that a hit point lies on: the first whose coordinate is within 1e-4 of 1.
///
/// A hit beside an edge is within it of two faces, and far away no point is within it of any.
#[must_use]
pub fn face_by_epsilon(point: Vec3) -> Option<usize> {
    (0..3).find(|&axis| (point[axis].abs() - 1.0).abs() < 1e-4)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn from_before_a_face_all_is_well() {
        assert_eq!(hit_f32(Vec3::new(0.25, 0.5, 5.0), Vec3::NEG_Z), Some(4.0));
        assert_eq!(hit_f32(Vec3::ZERO, Vec3::X), Some(1.0));
        assert_eq!(hit_f32(Vec3::new(0.25, 1.5, 5.0), Vec3::NEG_Z), None);
        assert_eq!(face_by_epsilon(Vec3::new(0.25, 0.5, 1.0)), Some(2));
    }

    #[test]
    fn in_the_plane_of_a_face_every_ray_is_lost() {
        let along = |y: f32, zero: f32| hit_f32(Vec3::new(0.0, y, 5.0), Vec3::new(0.0, zero, -1.0));
        assert_eq!((along(1.0, 0.0), along(1.0, -0.0)), (None, None));
        assert_eq!((along(-1.0, 0.0), along(-1.0, -0.0)), (None, None));
        assert_eq!(hit_widened_f32(Vec3::new(0.0, 1.0, 5.0), Vec3::NEG_Z), None);
        assert_eq!(face_by_epsilon(Vec3::new(1.0 - 1e-5, 0.5, 1.0)), Some(0), "the face at z = 1 was hit");
    }
}
