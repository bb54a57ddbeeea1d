//! Where a shadow ray starts, as the textbooks have it.

use glam::Vec3;

/// The start of a shadow ray: hits at or before `t_min` do not count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShadowStart {
    /// The origin, in scene units.
    pub origin: Vec3,
    /// The smallest t that is left out, in lengths of the direction.
    pub t_min: f32,
}

// ANCHOR: naive_starts
/// The hit point itself.
///
/// The point is rounded, so about half of all points lie behind their own surface, which then
/// shadows them: the picture is covered in specks, "shadow acne".
#[must_use]
pub fn start_at_hit(position: Vec3) -> ShadowStart {
    ShadowStart { origin: position, t_min: 0.0 }
}

/// The hit point, leaving out everything up to t = 1e-3 (Ray Tracing in One Weekend has this
/// constant).
///
/// It suits scenes of about its own size: at coordinates of 10^5 the rounding is larger and the
/// specks return, and in a scene of 10^-3 whole objects cast no shadow.
#[must_use]
pub fn start_after_constant(position: Vec3) -> ShadowStart {
    ShadowStart { origin: position, t_min: 1e-3 }
}
// ANCHOR_END: naive_starts

// ANCHOR: naive_shadow_origin
/// The hit point moved off its surface by 1e-4 along the unit normal.
///
/// One constant cannot serve every size: where f32 numbers are further apart than 1e-4, from about
/// 2000 units on, the addition often changes nothing, and next to things smaller than 1e-4 it jumps
/// over them.
#[must_use]
pub fn start_off_surface(position: Vec3, normal: Vec3) -> ShadowStart {
    ShadowStart { origin: position + normal * 1e-4, t_min: 0.0 }
}
// ANCHOR_END: naive_shadow_origin

// ANCHOR: naive_reach
/// How far a shadow ray looks: without end.
///
/// The wall behind a light then keeps its light away from everything before the wall.
#[must_use]
pub fn t_max_without_end(_distance: f64) -> f32 {
    f32::INFINITY
}

/// How far a shadow ray looks: to the light, at this distance.
///
/// The distance and the direction are rounded, so a light that hangs close before a wall is half the time found to be
/// behind it.
#[must_use]
pub fn t_max_to_light(distance: f64) -> f32 {
    distance as f32
}
// ANCHOR_END: naive_reach

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;
    use crate::measure::oracle_sphere::{Sphere, strictly_outside};
    use glam::DVec3;

    /// How many points of a unit sphere at `offset` start inside it, with the specks that follow.
    fn inside(points: u64, offset: f64, start: impl Fn(Vec3, Vec3) -> ShadowStart) -> usize {
        let sphere = Sphere { centre: DVec3::splat(offset), radius: 1.0 };
        let starts_inside = |index| {
            let normal = Draws::new(13, index).unit_vector();
            let start = start((sphere.centre + normal).as_vec3(), normal.as_vec3());
            !strictly_outside(start.origin.as_dvec3(), sphere)
        };
        (0..points).filter(|index| starts_inside(*index)).count()
    }

    #[test]
    fn constants_fail_away_from_the_origin() {
        const POINTS: u64 = 4000;
        let bare = inside(POINTS, 1e5, |position, _| start_at_hit(position));
        let near = inside(POINTS, 1.0, start_off_surface);
        let away = inside(POINTS, 1e5, start_off_surface);
        eprintln!("{POINTS} points at 1e5, {bare} start inside bare, {away} off by 1e-4 ({near} of them at 1)");
        assert!(bare > POINTS as usize / 4 && away > POINTS as usize / 4);
        assert_eq!(near, 0);
        assert_eq!(start_after_constant(Vec3::X).t_min, 1e-3);
    }
}
