use super::LightPoint;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

// ANCHOR: cone_versine
/// 1 − cos of the angle whose sine squared this is, for angles up to 90°.
///
/// Written as a difference, 1 − √(1 − s²) is 0 for every sphere seen smaller than 10⁻⁸: a light that has gone out.
#[inline(always)]
pub fn cone_versine(sine_squared: f64) -> f64 {
    sine_squared / (1.0 + (1.0 - sine_squared).max(0.0).sqrt())
}
// ANCHOR_END: cone_versine

// ANCHOR: sphere_point
/// A point of a sphere, chosen evenly over the cone of directions that it fills; from inside, evenly over all directions.
///
/// `axis` leads from the lit point to the sphere's centre.
/// A cone of half angle θ fills 2π(1 − cos θ) sr, and 1 − cos of a direction in it is spread evenly.
#[inline(always)]
pub fn sphere_point(axis: DVec3, radius: f64, u: [f64; 2]) -> LightPoint {
    let (dd, rr) = (axis.length_squared(), radius * radius);
    let inside = dd <= rr;
    let whole = if inside { 2.0 } else { cone_versine(rr / dd) };
    let versine = u[0] * whole;
    let (sine, turn) = ((versine * (2.0 - versine)).max(0.0).sqrt(), TAU * u[1]);
    let ahead = if inside { DVec3::Z } else { axis / dd.sqrt() };
    let (right, up) = ahead.any_orthonormal_pair();
    let (up_share, right_share) = libm::sincos(turn);
    let direction = ahead * (1.0 - versine) + (right * right_share + up * up_share) * sine;
    let distance = sphere_distance(axis, radius, direction);
    LightPoint { to: direction * distance, pdf: 1.0 / (TAU * whole) }
}
// ANCHOR_END: sphere_point

/// How likely [`sphere_point`] was to choose any one direction that meets the sphere, in 1/sr.
#[inline(always)]
pub fn sphere_pdf(axis: DVec3, radius: f64) -> f64 {
    let (dd, rr) = (axis.length_squared(), radius * radius);
    if dd <= rr { 1.0 / (4.0 * PI) } else { 1.0 / (TAU * cone_versine(rr / dd)) }
}

/// Where a ray aimed at a sphere meets it first; where rounding made it pass by, where it comes nearest.
///
/// The nearer root is the product of both over the farther, for their difference would lose digits close to the sphere.
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
