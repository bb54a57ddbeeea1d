//! Planar shapes and slabs in double-double: for the few intersections that f64 leaves uncertain.

use super::cuboid::Slabs;
use super::double_double::{DoubleDouble, add, dot, exact, multiply, negated, offset};
use super::planar::Planar;
use glam::DVec3;

/// Where a ray crosses the plane of a planar shape: t is `distance` / `approach`, and the coordinates are `at` /
/// `approach`.
struct DoubleDoubleCrossing {
    distance: DoubleDouble,
    approach: DoubleDouble,
    at: [DoubleDouble; 2],
}

impl DoubleDoubleCrossing {
    fn of(origin: DVec3, direction: DVec3, planar: &Planar) -> Self {
        let (f, d, n) = (offset(origin, planar.centre), exact(direction), exact(planar.normal));
        let (distance, approach) = (dot(n, f), dot(n, d));
        let scaled = [0, 1, 2].map(|axis| add(multiply(d[axis], distance), negated(multiply(f[axis], approach))));
        Self { distance, approach, at: planar.along.map(|along| dot(exact(along), scaled)) }
    }

    /// t if it is positive and the point is inside the shape, or infinity.
    fn t_if(&self, inside: bool) -> f64 {
        let t = self.distance.0 / self.approach.0;
        if inside && t > 0.0 && t < f64::INFINITY { t } else { f64::INFINITY }
    }
}

/// The t > 0 at which O + tR hits a disk, or infinity; computed to about 100 bits, then rounded.
#[cold]
#[inline(never)]
pub fn double_double_disk_t(origin: DVec3, direction: DVec3, planar: &Planar) -> f64 {
    let crossing = DoubleDoubleCrossing::of(origin, direction, planar);
    let [x, z] = crossing.at.map(|coordinate| multiply(coordinate, coordinate));
    let beyond = add(add(x, z), negated(multiply(crossing.approach, crossing.approach)));
    crossing.t_if(beyond.0 <= 0.0)
}

/// The t > 0 at which O + tR hits a rectangle, or infinity; computed to about 100 bits, then rounded.
#[cold]
#[inline(never)]
pub fn double_double_rectangle_t(origin: DVec3, direction: DVec3, planar: &Planar) -> f64 {
    let crossing = DoubleDoubleCrossing::of(origin, direction, planar);
    let max = magnitude(crossing.approach);
    crossing.t_if(crossing.at.iter().all(|&coordinate| add(magnitude(coordinate), negated(max)).0 <= 0.0))
}

/// A t as a quotient with positive denominator, and the axis of the face there.
#[derive(Clone, Copy)]
struct Fraction {
    numerator: DoubleDouble,
    denominator: DoubleDouble,
    axis: usize,
}

impl Fraction {
    /// A number with the sign of the difference to another t.
    fn minus(&self, other: &Self) -> f64 {
        add(multiply(self.numerator, other.denominator), negated(multiply(other.numerator, self.denominator))).0
    }

    fn t(&self) -> f64 {
        self.numerator.0 / self.denominator.0
    }
}

/// The smallest t > 0 at which O + tR intersects a face of a cuboid, or infinity, computed to about 100 bits, then
/// rounded; and the axis of that face.
///
/// At an edge or a vertex it is the first of the axes.
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
        let (near, far) = (
            Fraction { numerator: near, denominator: approach, axis },
            Fraction { numerator: far, denominator: approach, axis },
        );
        enters = Some(enters.filter(|enters| near.minus(enters) <= 0.0).unwrap_or(near));
        leaves = Some(leaves.filter(|leaves| far.minus(leaves) >= 0.0).unwrap_or(far));
    }
    let (Some(enters), Some(leaves)) = (enters, leaves) else { return MISS };
    let found = if enters.numerator.0 > 0.0 { enters } else { leaves };
    let t = found.t();
    if enters.minus(&leaves) <= 0.0 && t > 0.0 && t < f64::INFINITY { (t, found.axis) } else { MISS }
}

fn magnitude(a: DoubleDouble) -> DoubleDouble {
    if a.0 < 0.0 { negated(a) } else { a }
}
