//! Lenses as first thought of: the focus measured along each ray, the opening filled unevenly.

use glam::{DVec2, DVec3};
use std::f64::consts::PI;

// ANCHOR: focus_along_the_ray
/// The direction from a lens point to the point that lies `focus_distance` along the pinhole's own ray.
///
/// Those points form a sphere about the eye: at the image's edge something nearer is sharp than at its middle.
#[must_use]
pub fn focus_along_the_ray(screen: DVec2, tan_half_vertical: f64, lens: DVec2, focus_distance: f64) -> DVec3 {
    let along = DVec3::new(screen.x * tan_half_vertical, screen.y * tan_half_vertical, -1.0).normalize();
    (along * focus_distance - lens.extend(0.0)).normalize()
}
// ANCHOR_END: focus_along_the_ray

/// A point of the disk by pinhole's mapping, which these are compared with.
#[must_use]
pub fn onto_disk(u: DVec2) -> DVec2 {
    pinhole::sample::disk_point(u.into()).point().into()
}

// ANCHOR: radius_at_random
/// A point of the disk by a random angle and a random radius: half of all points land on the inner quarter of the area.
#[must_use]
pub fn radius_at_random(u: DVec2) -> DVec2 {
    let angle = 2.0 * PI * u.x;
    DVec2::new(libm::cos(angle), libm::sin(angle)) * u.y
}
// ANCHOR_END: radius_at_random

/// A point of the square about the disk, brought onto its edge where it lies outside.
#[must_use]
pub fn square_onto_disk(u: DVec2) -> DVec2 {
    let at = 2.0 * u - DVec2::ONE;
    if at.length() > 1.0 { at.normalize() } else { at }
}
