//! Flat pieces and slabs in pairs of f64: for the few rays whose verdict f64 alone leaves in doubt.

use super::double_double::{DoubleDouble, add, dot, multiply, negated};
use crate::extract::{Planar, Slabs, two_sum};
use glam::DVec3;

/// Where a ray crosses the plane of a flat piece: t is `distance` / `approach`, and so are the coordinates times `approach`.
struct DoubleDoubleCrossing {
    distance: DoubleDouble,
    approach: DoubleDouble,
    at: [DoubleDouble; 2],
}

impl DoubleDoubleCrossing {
    fn of(origin: DVec3, direction: DVec3, planar: &Planar) -> Self {
        let (f, d, n) = (offset(origin, planar.centre), exact(direction), exact(planar.normal));
        let (distance, approach) = (dot(n, f), dot(n, d));
        let way = [0, 1, 2].map(|axis| add(multiply(d[axis], distance), negated(multiply(f[axis], approach))));
        Self { distance, approach, at: planar.along.map(|along| dot(exact(along), way)) }
    }

    /// t where it is above 0 and the coordinates pass, or infinity.
    fn t_if(&self, inside: bool) -> f64 {
        let t = self.distance.0 / self.approach.0;
        if inside && t > 0.0 && t < f64::INFINITY { t } else { f64::INFINITY }
    }
}

/// The t > 0 at which O + tR meets a disk, or infinity, to about 100 bits before rounding.
#[cold]
#[inline(never)]
pub fn double_double_disk_t(origin: DVec3, direction: DVec3, planar: &Planar) -> f64 {
    let crossing = DoubleDoubleCrossing::of(origin, direction, planar);
    let [x, z] = crossing.at.map(|part| multiply(part, part));
    let beyond = add(add(x, z), negated(multiply(crossing.approach, crossing.approach)));
    crossing.t_if(beyond.0 <= 0.0)
}

/// The t > 0 at which O + tR meets a rectangle, or infinity, to about 100 bits before rounding.
#[cold]
#[inline(never)]
pub fn double_double_rectangle_t(origin: DVec3, direction: DVec3, planar: &Planar) -> f64 {
    let crossing = DoubleDoubleCrossing::of(origin, direction, planar);
    let most = magnitude(crossing.approach);
    crossing.t_if(crossing.at.iter().all(|&part| add(magnitude(part), negated(most)).0 <= 0.0))
}

/// A t as a quotient of two numbers, the lower one above 0; and the axis of the face where it is.
#[derive(Clone, Copy)]
struct Fraction {
    over: DoubleDouble,
    under: DoubleDouble,
    axis: usize,
}

impl Fraction {
    /// The sign of this less another.
    fn less(&self, other: &Self) -> f64 {
        add(multiply(self.over, other.under), negated(multiply(other.over, self.under))).0
    }

    fn t(&self) -> f64 {
        self.over.0 / self.under.0
    }
}

/// The smallest t > 0 at which O + tR lies on a face of a cuboid, or infinity, to about 100 bits before rounding; and the
/// axis of that face.
///
/// Where two faces are met at once, the axis is the first of theirs.
#[cold]
#[inline(never)]
pub fn double_double_cuboid_t(origin: DVec3, direction: DVec3, slabs: &Slabs) -> (f64, usize) {
    const MISS: (f64, usize) = (f64::INFINITY, 0);
    let (f, d) = (offset(origin, slabs.centre), exact(direction));
    let (mut enters, mut leaves): (Option<Fraction>, Option<Fraction>) = (None, None);
    for axis in 0..3 {
        let n = exact(slabs.normal[axis]);
        let (mut middle, mut approach, half) = (dot(n, f), dot(n, d), (slabs.half[axis], 0.0));
        if approach.0 < 0.0 {
            (middle, approach) = (negated(middle), negated(approach));
        }
        let (near, far) = (add(middle, negated(half)), add(middle, half));
        if approach.0 == 0.0 {
            if near.0 > 0.0 || far.0 < 0.0 {
                return MISS;
            }
            continue;
        }
        let (near, far) =
            (Fraction { over: near, under: approach, axis }, Fraction { over: far, under: approach, axis });
        enters = Some(enters.filter(|enters| near.less(enters) <= 0.0).unwrap_or(near));
        leaves = Some(leaves.filter(|leaves| far.less(leaves) >= 0.0).unwrap_or(far));
    }
    let (Some(enters), Some(leaves)) = (enters, leaves) else { return MISS };
    let found = if enters.over.0 > 0.0 { enters } else { leaves };
    let t = found.t();
    if enters.less(&leaves) <= 0.0 && t > 0.0 && t < f64::INFINITY { (t, found.axis) } else { MISS }
}

/// C − O, exactly.
fn offset(origin: DVec3, centre: DVec3) -> [DoubleDouble; 3] {
    [0, 1, 2].map(|axis| two_sum(centre[axis], -origin[axis]))
}

fn exact(v: DVec3) -> [DoubleDouble; 3] {
    v.to_array().map(|part| (part, 0.0))
}

fn magnitude(a: DoubleDouble) -> DoubleDouble {
    if a.0 < 0.0 { negated(a) } else { a }
}
