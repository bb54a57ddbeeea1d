use super::emitting::{AreaSample, Emitting, LightPoint, pdf_from_area};
use super::parallelogram::{Parallelogram, RectangleSeen};
use crate::sample;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_4, PI};

/// From farther away than this many of its longest radii, a disk is sampled by area.
const FAR: f64 = 3.0;
/// It is also sampled by area where its bounding rectangle subtends less than this many sr.
const MIN_SOLID_ANGLE: f64 = 1e-6;

/// A disk, or the ellipse that a non-uniform scale makes of it, as a light: its bounding rectangle with sides along its
/// axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmittingDisk(pub Parallelogram);

impl Emitting for EmittingDisk {
    const IS_CLOSED: bool = false;

    fn area(&self) -> f64 {
        FRAC_PI_4 * self.0.area()
    }

    #[inline(always)]
    fn faces(&self, point: DVec3) -> bool {
        self.0.faces(point)
    }

    fn plane_normal(&self) -> Option<DVec3> {
        Some(self.0.normal)
    }

    #[inline(always)]
    fn point(&self, from: DVec3, u: [f64; 2]) -> LightPoint {
        disk_point(&self.0, from, u)
    }

    #[inline(always)]
    fn pdf(&self, from: DVec3, at: DVec3) -> f64 {
        disk_pdf(&self.0, from, at - from)
    }

    #[inline(always)]
    fn distance(&self, from: DVec3, direction: DVec3) -> f64 {
        self.0.distance(from, direction)
    }

    #[inline(always)]
    fn spot(&self, u: [f64; 2]) -> AreaSample {
        AreaSample { area: self.area(), ..self.0.spot_at(sample::disk_point(u).point()) }
    }
}

// ANCHOR: disk_point
/// Samples a point on a disk, or on the ellipse that a non-uniform scale makes of it; `disk` is its bounding rectangle.
///
/// From far away, points are uniform over its area.
/// From nearby, the bounding rectangle is cut into strips as in [`RectangleSeen::at`], and the point is uniform in
/// solid angle over that part of its strip which is in the disk.
/// One side of a circle's bounding square faces the lit point, so that square and disk subtend nearly the same solid
/// angle even close to the rim.
#[inline(always)]
pub fn disk_point(disk: &Parallelogram, from: DVec3, u: [f64; 2]) -> LightPoint {
    match box_seen(disk, from) {
        Some(seen) => seen.in_ellipse(u),
        None => disk_area_point(disk, from, u),
    }
}
// ANCHOR_END: disk_point

/// The pdf of a direction sampled by [`disk_point`], in 1/sr; `to` is the offset to the disk's point there.
#[inline(always)]
pub fn disk_pdf(disk: &Parallelogram, from: DVec3, to: DVec3) -> f64 {
    match box_seen(disk, from) {
        Some(seen) => seen.ellipse_pdf(to),
        None => pdf_from_area(to, disk.normal, PI / 4.0 * disk.area()),
    }
}

/// The bounding rectangle of a disk, as seen from a point nearby; none from far away.
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
    (seen.solid_angle >= MIN_SOLID_ANGLE).then_some(seen)
}

/// Samples a point uniformly over the disk's area.
#[inline(always)]
fn disk_area_point(disk: &Parallelogram, from: DVec3, u: [f64; 2]) -> LightPoint {
    let ([right, up], [x, y]) = (sample::disk_point(u).point(), disk.half_edges);
    let to = disk.centre - from + x * right + y * up;
    LightPoint { to, pdf: pdf_from_area(to, disk.normal, PI / 4.0 * disk.area()) }
}
