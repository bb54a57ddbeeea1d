use super::parallelogram::RectangleSeen;
use super::{LightPoint, pdf_from_area};
use crate::extract::Parallelogram;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// From farther than this many of its longest radii a disk is aimed at by its area.
const FAR: f64 = 3.0;
/// And where the box about it fills less than this many sr.
const LEAST_SOLID_ANGLE: f64 = 1e-6;

// ANCHOR: disk_point
/// A point of a disk, or of the ellipse that uneven scales make of one; `disk` is the box about it.
///
/// From afar evenly over its area.
/// From near, the box about it is cut into stripes as [`RectangleSeen::at`] does, and the point is chosen evenly over the
/// directions of that part of its stripe that lies in the disk.
/// One side of a circle's box is turned to the lit point, so that box and disk fill nearly the same directions even close
/// to the rim.
#[inline(always)]
pub fn disk_point(disk: &Parallelogram, from: DVec3, u: [f64; 2]) -> LightPoint {
    match box_seen(disk, from) {
        Some(seen) => seen.in_ellipse(u),
        None => disk_area_point(disk, from, u),
    }
}
// ANCHOR_END: disk_point

/// How likely [`disk_point`] was to choose a direction, in 1/sr; `to` leads to the disk's point there.
#[inline(always)]
pub fn disk_pdf(disk: &Parallelogram, from: DVec3, to: DVec3) -> f64 {
    match box_seen(disk, from) {
        Some(seen) => seen.ellipse_pdf(to),
        None => pdf_from_area(to, disk.normal, PI / 4.0 * disk.area()),
    }
}

/// The box about a disk, as seen from a point near it; none from afar.
#[inline(always)]
fn box_seen(disk: &Parallelogram, from: DVec3) -> Option<RectangleSeen> {
    let [x, y] = disk.half_edges;
    let (xx, yy) = (x.length_squared(), y.length_squared());
    let away = from - disk.centre;
    if away.length_squared() > FAR * FAR * xx.max(yy) {
        return None;
    }
    let is_circle = (xx - yy).abs() <= 1e-9 * xx;
    let along = away - disk.normal * disk.normal.dot(away);
    let half_edges = match (along / xx.sqrt()).try_normalize() {
        Some(along) if is_circle => [along * xx.sqrt(), disk.normal.cross(along) * xx.sqrt()],
        _ => [x, y],
    };
    let seen = RectangleSeen::new(disk.centre, half_edges, from);
    (seen.solid_angle >= LEAST_SOLID_ANGLE).then_some(seen)
}

/// A point of a disk, evenly over its area: circles of the square become circles of the disk (Shirley and Chiu 1997).
#[inline(always)]
fn disk_area_point(disk: &Parallelogram, from: DVec3, u: [f64; 2]) -> LightPoint {
    let [a, b] = u.map(|u| 2.0 * u - 1.0);
    let (radius, turn) = if a * a > b * b {
        (a, FRAC_PI_4 * (b / a))
    } else if b != 0.0 {
        (b, FRAC_PI_2 - FRAC_PI_4 * (a / b))
    } else {
        (0.0, 0.0)
    };
    let [x, y] = disk.half_edges;
    let (sine, cosine) = libm::sincos(turn);
    let to = disk.centre - from + x * (radius * cosine) + y * (radius * sine);
    LightPoint { to, pdf: pdf_from_area(to, disk.normal, PI / 4.0 * disk.area()) }
}
