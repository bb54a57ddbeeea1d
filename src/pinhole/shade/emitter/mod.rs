//! Sampling points on area lights, as seen from a point that they illuminate, and the pdfs of these points.
//!
//! Reads: a light's shape, the lit point, and a point of the unit square.
//! Gives: the offset to a point on the light and its pdf per unit of solid angle at the lit point, in 1/sr, f64.
//! Space: any one space; the renderer uses render space.

mod cuboid;
mod disk;
mod leave;
mod parallelogram;
mod sphere;
mod triangle;

pub use cuboid::{CuboidSeen, cuboid_distance, cuboid_pdf, cuboid_point};
pub use disk::{disk_pdf, disk_point};
pub use leave::{
    LeavingPoint, MAX_TARGETS_SOLID_ANGLE, cone_direction, direction_to_targets, leaving_point, sphere_direction,
};
pub use parallelogram::{
    RectangleSeen, parallelogram_area_pdf, parallelogram_area_point, parallelogram_pdf, parallelogram_point,
};
pub use sphere::{cone_versine, sphere_distance, sphere_pdf, sphere_point};
pub use triangle::{
    TriangleSeen, triangle_area_pdf, triangle_area_point, triangle_pdf, triangle_point, triangle_solid_angle,
};

use crate::extract::Emitter;
use glam::DVec3;

/// A point sampled on a light, as seen from the lit point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LightPoint {
    /// The offset from the lit point, in scene units.
    pub to: DVec3,
    /// Its pdf in 1/sr; 0 where the light is seen edge-on.
    pub pdf: f64,
}

impl LightPoint {
    /// No point, for a light seen edge-on.
    pub const NONE: Self = Self { to: DVec3::ZERO, pdf: 0.0 };
}

/// The point of a light for a point of the unit square.
#[inline(always)]
pub fn point_on(emitter: &Emitter, from: DVec3, u: [f64; 2]) -> LightPoint {
    match emitter {
        Emitter::Sphere { centre, radius } => sphere_point(*centre - from, *radius, u),
        Emitter::Rectangle(rectangle) => parallelogram_point(rectangle, from, u),
        Emitter::Disk(disk) => disk_point(disk, from, u),
        Emitter::Triangle { corners, .. } => triangle_point(corners, from, u),
        Emitter::Cuboid(cuboid) => cuboid_point(cuboid, from, u),
    }
}

/// The pdf with which [`point_on`] samples the direction to a point of the light, in 1/sr.
#[inline(always)]
pub fn pdf_towards(emitter: &Emitter, from: DVec3, at: DVec3) -> f64 {
    match emitter {
        Emitter::Sphere { centre, radius } => sphere_pdf(*centre - from, *radius),
        Emitter::Rectangle(rectangle) => parallelogram_pdf(rectangle, from, at - from),
        Emitter::Disk(disk) => disk_pdf(disk, from, at - from),
        Emitter::Triangle { corners, .. } => triangle_pdf(corners, from, at - from),
        Emitter::Cuboid(cuboid) => cuboid_pdf(cuboid, from, at - from),
    }
}

/// The distance to a light along a ray sampled towards it; rounding of the direction may make the ray miss slightly.
///
/// In units of the direction's length.
#[inline(always)]
pub fn distance_to(emitter: &Emitter, from: DVec3, direction: DVec3) -> f64 {
    match emitter {
        Emitter::Sphere { centre, radius } => sphere_distance(*centre - from, *radius, direction),
        Emitter::Rectangle(planar) | Emitter::Disk(planar) => {
            planar.normal.dot(planar.centre - from) / planar.normal.dot(direction)
        }
        Emitter::Triangle { corners, normal } => normal.dot(corners[0] - from) / normal.dot(direction),
        Emitter::Cuboid(cuboid) => cuboid_distance(cuboid, from, direction),
    }
}

// ANCHOR: pdf_from_area
/// The pdf per unit of solid angle of a point uniform over a planar area: d² / (A cos θ), with θ at the light.
///
/// 0 where the area is seen edge-on, since it subtends no solid angle.
#[inline(always)]
pub fn pdf_from_area(to: DVec3, unit_normal: DVec3, area: f64) -> f64 {
    // Not yet divided by d.
    let cosine = unit_normal.dot(to).abs();
    if cosine > 0.0 { to.length_squared() * to.length() / (area * cosine) } else { 0.0 }
}
// ANCHOR_END: pdf_from_area

/// The angle in [0, π] with a sine and a cosine in this ratio.
#[inline(always)]
fn angle_of(sine: f64, cosine: f64) -> f64 {
    libm::atan2(sine, cosine)
}
