use std::f64::consts::{FRAC_PI_4, TAU};

use crate::each::Each;

/// A number so large that f64 has no binary places left beside it: what is added to it is rounded to whole numbers.
pub(crate) const NO_PLACES: f64 = 1.5 * (1_u64 << 52) as f64;

/// Coefficients of the series of sin x / x and of cos x in powers of −x²: 1/3!, 1/5!, … and 1/2!, 1/4!, ….
const SINE: [f64; 7] = series([3, 5, 7, 9, 11, 13, 15]);
const COSINE: [f64; 8] = series([2, 4, 6, 8, 10, 12, 14, 16]);

/// 1 over the factorials of whole numbers up to 20.
pub(crate) const fn series<const N: usize>(of: [u64; N]) -> [f64; N] {
    let mut inverse = [0.0; N];
    let mut place = 0;
    while place < N {
        let (mut product, mut factor) = (1_u64, 1);
        while factor <= of[place] {
            product *= factor;
            factor += 1;
        }
        inverse[place] = 1.0 / product as f64;
        place += 1;
    }
    inverse
}

// ANCHOR: circle_point
/// The point of the unit circle at a fraction u of a full turn: cos 2πu and sin 2πu, each within 1.5 · 2⁻⁵³.
///
/// u less the nearest quarter of a turn is exact and at most an eighth, where few terms of the series suffice; the quarter
/// says which of the two is which, and with what sign.
/// There is no branch and no table, so that one loop computes the points of many rows at once, with the same bits on every
/// machine.
#[inline(always)]
pub fn circle_point(u: f64) -> [f64; 2] {
    let shifted = 4.0 * u + NO_PLACES;
    let quarter = shifted.to_bits();
    let x = (u - 0.25 * (shifted - NO_PLACES)) * TAU;
    let (sine, cosine) = sine_and_cosine(x);
    let is_odd = quarter & 1 != 0;
    let (across, up) = if is_odd { (sine, cosine) } else { (cosine, sine) };
    let negative = |is_so: bool, of: f64| if is_so { -of } else { of };
    [negative((quarter ^ (quarter >> 1)) & 1 != 0, across), negative(quarter & 2 != 0, up)]
}
// ANCHOR_END: circle_point

/// The greatest number of 24 binary places below 1.
const LAST: f64 = 1.0 - 1.0 / (1 << 24) as f64;

// ANCHOR: disk_point
/// The point of the unit disk for a point of the unit square, preserving area and adjacency: the concentric mapping
/// (Shirley and Chiu 1997).
///
/// Concentric squares become circles: the distance from the centre determines the radius, the position along the
/// square's side the angle.
/// Samples that are well distributed over the square thus stay so over the disk, which a radius √u and an angle 2πv would
/// make long slices of.
/// Numbers are taken to be the lower ends of intervals of 2⁻²⁴, and mapped from their middles, so that no point is on the
/// rim or at the centre.
#[inline(always)]
pub fn disk_point(u: [f64; 2]) -> DiskPoint {
    let [a, b] = u.each(|u| (2.0 * u - LAST).min(LAST));
    let is_wide = a.abs() > b.abs();
    let (radius, along) = if is_wide { (a, b) } else { (b, a) };
    let ratio = if radius == 0.0 { 0.0 } else { along / radius };
    let (sine, cosine) = sine_and_cosine(ratio * FRAC_PI_4);
    DiskPoint { radius, direction: if is_wide { [cosine, sine] } else { [sine, cosine] } }
}
// ANCHOR_END: disk_point

/// The point of the unit square that [`disk_point`] maps to where this fraction of the disk's area is nearer to the centre,
/// at this fraction of a full turn.
pub fn square_of_disk(fraction: f64, turn: f64) -> [f64; 2] {
    let (radius, quarter) = (fraction.sqrt(), libm::round(4.0 * turn));
    let along = radius * 2.0 * (4.0 * turn - quarter);
    let at = match quarter as u32 % 4 {
        0 => [radius, along],
        1 => [-along, radius],
        2 => [-radius, -along],
        _ => [along, -radius],
    };
    at.each(|of| 0.5 * (LAST + of))
}

/// A point of the unit disk: so far in a direction, or against it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiskPoint {
    /// The distance from the centre, negative where the point lies against the direction.
    pub radius: f64,
    /// A unit vector.
    pub direction: [f64; 2],
}

impl DiskPoint {
    /// The point within whose distance from the centre this fraction of the area lies, at this fraction of a full turn.
    #[inline(always)]
    pub fn polar(fraction: f64, turn: f64) -> Self {
        Self { radius: fraction.sqrt(), direction: circle_point(turn) }
    }

    /// The square of the distance from the centre, which is uniform.
    #[inline(always)]
    pub fn squared(self) -> f64 {
        self.radius * self.radius
    }

    /// The point at another distance from the centre on the same side of it.
    #[inline(always)]
    pub fn at(self, distance: f64) -> [f64; 2] {
        let signed = distance.copysign(self.radius);
        self.direction.each(|part| signed * part)
    }

    /// The point.
    #[inline(always)]
    pub fn point(self) -> [f64; 2] {
        self.direction.each(|part| self.radius * part)
    }
}

// ANCHOR: sine_and_cosine
/// Sine and cosine of an angle up to an eighth of a turn either way.
#[inline(always)]
fn sine_and_cosine(x: f64) -> (f64, f64) {
    let y = -x * x;
    (x + x * y * summed(&SINE, y), 1.0 + y * summed(&COSINE, y))
}

/// The sum of a series' terms, from the smallest.
#[inline(always)]
fn summed<const N: usize>(coefficients: &[f64; N], y: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, coefficient| sum * y + coefficient)
}
// ANCHOR_END: sine_and_cosine

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_square_s_point_is_mapped_to_the_disk_s() {
        let mut worst = 0.0_f64;
        for (fraction, turn) in (0..4096).map(|at| (f64::from(at % 64) / 64.0, f64::from(at / 64) / 64.0)) {
            let [own, polar] =
                [disk_point(square_of_disk(fraction, turn)), DiskPoint::polar(fraction, turn)].map(DiskPoint::point);
            worst = worst.max((own[0] - polar[0]).abs()).max((own[1] - polar[1]).abs());
        }
        eprintln!("disk: 4096 points, worst {worst:.1e}");
        assert!(worst < 1e-15, "{worst}");
    }

    /// Against libm's sine and cosine of what is left after the nearest quarter, on a grid and at the ends of every quarter.
    #[test]
    fn points_are_on_the_circle_to_the_last_digits() {
        let eighths = (0..=8).map(|eighth| f64::from(eighth) / 8.0);
        let beside = eighths.flat_map(|u| [u - 1.0 / f64::from(1 << 24), u, u + 1.0 / f64::from(1 << 24)]);
        let grid = (0..1_u32 << 18).map(|n| f64::from(n << 6 | 37) / f64::from(1 << 24));
        let (mut tried, mut worst) = (0, 0.0_f64);
        for u in grid.chain(beside) {
            // The angle itself would be rounded by more than is asked for here.
            let quarter = libm::round(4.0 * u);
            let (sine, cosine) = libm::sincos((u - 0.25 * quarter) * TAU);
            let expected = match quarter as i64 & 3 {
                0 => [cosine, sine],
                1 => [-sine, cosine],
                2 => [-cosine, -sine],
                _ => [sine, -cosine],
            };
            let own = circle_point(u);
            for (own, expected) in own.into_iter().zip(expected) {
                worst = worst.max((own - expected).abs() * (1_u64 << 53) as f64);
            }
            tried += 1;
        }
        eprintln!("circle: {tried} points, worst {worst:.2} · 2⁻⁵³ from libm's");
        assert!(worst <= 1.5, "{worst}");
        assert_eq!([0.0, 0.25, 0.5, 0.75].map(circle_point), [[1.0, 0.0], [-0.0, 1.0], [-1.0, -0.0], [0.0, -1.0]]);
    }
}
