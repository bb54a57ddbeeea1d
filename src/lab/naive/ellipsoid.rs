//! Scaled spheres as first attempts have them: everything transformed alike.

use glam::{DMat3, DVec3, Mat3, Vec3};

// ANCHOR: naive_normal_as_direction
/// A normal taken to the world by the matrix that takes directions there.
///
/// Right for turns and even scales, which is where most scenes end.
/// Scaled unevenly, the normal leans towards the long axis where it should lean away from it, and light falls on the
/// wrong side of an egg.
#[must_use]
pub fn normal_as_direction(world_from_object: DMat3, normal: DVec3) -> DVec3 {
    (world_from_object * normal).normalize()
}
// ANCHOR_END: naive_normal_as_direction

// ANCHOR: naive_renormalised
/// The ray taken to the unit sphere, its direction made a unit vector there as "rays have unit directions".
///
/// The distance that comes back is one of the object's space: compared with the distances of other things, it makes
/// large things too near and small ones too far.
#[must_use]
pub fn hit_renormalised(origin: DVec3, direction: DVec3, centre: DVec3, unit_from_world: DMat3) -> Option<f64> {
    let from_centre = unit_from_world * (origin - centre);
    let direction = (unit_from_world * direction).normalize();
    let half_b = -from_centre.dot(direction);
    let passing = from_centre + half_b * direction;
    let discriminant = 1.0 - passing.dot(passing);
    if discriminant < 0.0 {
        return None;
    }
    [half_b - discriminant.sqrt(), half_b + discriminant.sqrt()].into_iter().find(|t| *t > 0.0)
}
// ANCHOR_END: naive_renormalised

/// The quadratic from school in the space of the unit sphere, in f32.
///
/// What the sphere loses at a thousand radii is lost here at a few, because the short axis is the unit and the long one
/// sets the distance.
#[must_use]
pub fn hit_f32(origin: Vec3, direction: Vec3, centre: Vec3, unit_from_world: Mat3) -> Option<f32> {
    super::sphere::hit_f32(unit_from_world * (origin - centre), unit_from_world * direction, Vec3::ZERO, 1.0)
}

// ANCHOR: naive_look_at
/// The axes of something that looks from `eye` to `target`, as first look-at functions have them.
///
/// Nothing asks whether there is a direction at all.
#[must_use]
pub fn look_at_unchecked(eye: DVec3, target: DVec3, up: DVec3) -> DMat3 {
    let back = (eye - target).normalize();
    let right = up.cross(back).normalize();
    DMat3::from_cols(right, back.cross(right), back)
}
// ANCHOR_END: naive_look_at

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_even_scale_hides_all_of_it() {
        let (centre, double) = (DVec3::new(0.0, 0.0, -6.0), DMat3::from_diagonal(DVec3::splat(2.0)));
        assert_eq!(normal_as_direction(double, DVec3::Y), DVec3::Y);
        let half = double.inverse();
        let t = hit_f32(Vec3::ZERO, Vec3::NEG_Z, centre.as_vec3(), half.as_mat3());
        assert_eq!(t, Some(4.0));
        assert_eq!(look_at_unchecked(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y), DMat3::IDENTITY);
    }

    #[test]
    fn an_uneven_scale_shows_it() {
        let stretched = DMat3::from_diagonal(DVec3::new(1.0, 4.0, 1.0));
        let oblique = DVec3::new(0.6, 0.8, 0.0);
        let right = (stretched.inverse().transpose() * oblique).normalize();
        assert!(normal_as_direction(stretched, oblique).dot(right) < 0.6, "the normal leans the wrong way");
        let half = DMat3::from_diagonal(DVec3::splat(0.5));
        let t = hit_renormalised(DVec3::ZERO, DVec3::NEG_Z, DVec3::new(0.0, 0.0, -6.0), half);
        assert_eq!(t, Some(2.0), "the sphere begins at 4");
        assert!(look_at_unchecked(DVec3::ZERO, DVec3::NEG_Z, DVec3::Z).is_nan());
    }
}
