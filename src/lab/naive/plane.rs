//! Ray against plane as the textbooks have it.

use glam::Vec3;

// ANCHOR: naive_hit_plane_f32
/// The t where the ray intersects the plane normal · x = offset, in f32, with two constants of the
/// textbooks: a ray is called parallel when |normal · direction| is at most 1e-6, and a hit too
/// near when t is at most 1e-3.
///
/// Both constants have a size, and a scene has none: seen flat, a floor ends at a horizon that is
/// too near, and a model in kilometres, or a direction that is not of unit length, loses surfaces
/// right before the eye.
#[must_use]
pub fn hit_f32(origin: Vec3, direction: Vec3, normal: Vec3, offset: f32) -> Option<f32> {
    let approach = normal.dot(direction);
    if approach.abs() <= 1e-6 {
        return None;
    }
    let t = (offset - normal.dot(origin)) / approach;
    (t > 1e-3).then_some(t)
}
// ANCHOR_END: naive_hit_plane_f32

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::oracle_plane::plane_hit;
    use crate::measure::ray_aim::plane_of_any_offset;

    #[test]
    fn a_floor_is_hit_from_above() {
        assert_eq!(hit_f32(Vec3::ZERO, Vec3::NEG_Y, Vec3::Y, -2.0), Some(2.0));
        assert_eq!(hit_f32(Vec3::ZERO, Vec3::Y, Vec3::Y, -2.0), None);
    }

    #[test]
    fn its_constants_lose_surfaces() {
        assert_eq!(hit_f32(Vec3::ZERO, Vec3::new(1.0, -1e-6, 0.0), Vec3::Y, -2.0), None);
        assert_eq!(hit_f32(Vec3::ZERO, Vec3::NEG_Y, Vec3::Y, -1e-3), None);
        const RAYS: u64 = 4000;
        let wrong = |index| {
            let (ray, plane) = plane_of_any_offset(12, index, 8.0);
            let plane = plane.rounded_to_f32();
            let naive = hit_f32(ray.origin, ray.direction, plane.normal.as_vec3(), plane.offset as f32);
            naive.is_some() != plane_hit(ray.origin, ray.direction, plane).is_some()
        };
        let wrong = (0..RAYS).filter(|index| wrong(*index)).count();
        eprintln!("{RAYS} rays at planes of any offset, {wrong} misclassified by the textbook in f32");
        assert!(wrong > 0, "the textbook is expected to break");
    }
}
