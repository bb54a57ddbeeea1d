use super::emitting::LightPoint;
use crate::sample::disk_point;
use glam::{DMat3, DVec3};
use std::f64::consts::{PI, TAU};

// ANCHOR: cone_versine
/// 1 − cos of the angle with this squared sine, for angles up to 90°.
///
/// Written as a difference, 1 − √(1 − s²) is 0 for every sphere seen smaller than 10⁻⁸, and the light would vanish.
#[inline(always)]
pub fn cone_versine(sine_squared: f64) -> f64 {
    sine_squared / (1.0 + (1.0 - sine_squared).max(0.0).sqrt())
}
// ANCHOR_END: cone_versine

// ANCHOR: sphere_point
/// Samples a point on a sphere, uniform over the cone of directions that it subtends; from inside, over all directions.
///
/// `axis` is the offset from the lit point to the sphere's centre.
/// A cone of half angle θ subtends 2π(1 − cos θ) sr, and 1 − cos of a direction in it is uniform.
#[inline(always)]
pub fn sphere_point(axis: DVec3, radius: f64, u: [f64; 2]) -> LightPoint {
    let (dd, rr) = (axis.length_squared(), radius * radius);
    let inside = dd <= rr;
    let whole = if inside { 2.0 } else { cone_versine(rr / dd) };
    let on_disk = disk_point(u);
    let versine = on_disk.squared() * whole;
    let sine = (versine * (2.0 - versine)).max(0.0).sqrt();
    let ahead = if inside { DVec3::Z } else { axis / dd.sqrt() };
    let (right, up) = ahead.any_orthonormal_pair();
    let [x, y] = on_disk.at(sine);
    let direction = ahead * (1.0 - versine) + (right * x + up * y);
    let distance = sphere_distance(axis, radius, direction);
    LightPoint { to: direction * distance, pdf: 1.0 / (TAU * whole) }
}
// ANCHOR_END: sphere_point

/// The pdf of any direction sampled by [`sphere_point`] that hits the sphere, in 1/sr.
#[inline(always)]
pub fn sphere_pdf(axis: DVec3, radius: f64) -> f64 {
    let (dd, rr) = (axis.length_squared(), radius * radius);
    if dd <= rr { 1.0 / (4.0 * PI) } else { 1.0 / (TAU * cone_versine(rr / dd)) }
}

/// The distance at which a ray sampled towards a sphere first hits it; where rounding makes it miss, that of its
/// closest approach.
///
/// The nearer root is the product of both over the farther one, since the difference would lose digits close to the
/// sphere.
#[inline(always)]
pub fn sphere_distance(axis: DVec3, radius: f64, direction: DVec3) -> f64 {
    let (squared, rr) = (direction.length_squared(), radius * radius);
    let s = axis.dot(direction) / squared;
    let across = axis - s * direction;
    let half_chord = ((rr - across.length_squared()).max(0.0) / squared).sqrt();
    let outside = axis.length_squared() - rr;
    let farther = s + half_chord;
    if outside <= 0.0 { farther } else { outside / squared / farther }
}

/// A direction uniform over the sphere.
#[inline(always)]
pub fn sphere_direction(u: [f64; 2]) -> DVec3 {
    cone_direction(DVec3::Z, 2.0, u)
}

/// A direction uniform over the cone about an axis, `whole` being 1 − cos of its half angle.
#[inline(always)]
pub fn cone_direction(axis: DVec3, whole: f64, u: [f64; 2]) -> DVec3 {
    let on_disk = disk_point(u);
    let versine = on_disk.squared() * whole;
    let [x, y] = on_disk.at((versine * (2.0 - versine)).max(0.0).sqrt());
    let (right, up) = axis.any_orthonormal_pair();
    DMat3::from_cols(right, up, axis) * DVec3::new(x, y, 1.0 - versine)
}
