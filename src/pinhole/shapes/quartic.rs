//! The first real root of a quartic in an interval, found so that no root before it can have been missed.

use super::arithmetic::Arithmetic;

/// Where f64 cannot tell a double root from none in an interval of this half width, it is left to double-double.
const NARROW: f64 = 1.0 / (1_u64 << 26) as f64;
/// Where double-double cannot either, there is a double root.
const NARROWEST: f64 = 1.0 / (1_u64 << 50) as f64;
/// How certain a root is: to this part of the distance.
const SMALL: f64 = 1.0 / (1_u64 << 26) as f64;

/// c₀ + c₁τ + … + c₄τ⁴ about another point.
#[inline(always)]
fn shifted<N: Arithmetic>(quartic: &[N; 5], by: f64) -> [N; 5] {
    let (mut c, by) = (*quartic, N::from(by));
    for first in 0..4 {
        for power in (first..4).rev() {
            c[power] = c[power] + by * c[power + 1];
        }
    }
    c
}

#[inline(always)]
fn value<N: Arithmetic>(c: &[N; 5], at: f64) -> N {
    let at = N::from(at);
    (((c[4] * at + c[3]) * at + c[2]) * at + c[1]) * at + c[0]
}

/// The smallest root in an interval, if there is one; none outside where these numbers leave that uncertain.
///
/// About its middle, an interval has no root if the constant exceeds all that the other terms can add up to; if those
/// of the derivative cannot add up to its constant either, the quartic is monotonic and the signs at the ends decide;
/// otherwise, its halves are searched, the first half first.
/// A root is to be certain relative to its distance from a point this far `before` 0.
pub(super) fn first_root<N: Arithmetic>(quartic: &[N; 5], min: f64, max: f64, before: f64) -> Option<Option<f64>> {
    let (middle, half) = (0.5 * (min + max), 0.5 * (max - min));
    let c = shifted(quartic, middle);
    let [w, ww] = [half, half * half].map(N::from);
    let (linear, square) = (c[1].abs() * w, c[2].abs() * ww);
    let (cube, fourth) = (c[3].abs() * ww * w, c[4].abs() * ww * ww);
    if (c[0].abs() - (linear + square + cube + fourth)).is_surely_positive() {
        return Some(None);
    }
    let twice = |n: N| n + n;
    if (linear - (twice(square + cube + twice(fourth)) + cube)).is_surely_positive() {
        let [sign, end] = [value(quartic, min).sign()?, value(quartic, max).sign()?];
        if sign * end > 0 || sign == 0 {
            return Some(None);
        }
        return refined(quartic, [min, max], end > 0, before).map(Some);
    }
    if half < if N::IS_LAST { NARROWEST } else { NARROW } {
        return N::IS_LAST.then_some(Some(middle));
    }
    match first_root(quartic, min, middle, before)? {
        None => first_root(quartic, middle, max, before),
        found => Some(found),
    }
}

/// The only root in an interval where the quartic is monotonic, by Newton's method kept within its bracket; none where
/// it is uncertain.
fn refined<N: Arithmetic>(c: &[N; 5], [first, last]: [f64; 2], rises: bool, before: f64) -> Option<f64> {
    const ROUNDS: u32 = 200;
    let (mut min, mut max, mut at) = (first, last, 0.5 * (first + last));
    let [_, c1, c2, c3, c4] = c.map(N::value);
    for _ in 0..ROUNDS {
        let f = value(c, at).value();
        if (f > 0.0) == rises {
            max = at;
        } else {
            min = at;
        }
        let newton = at - f / (((4.0 * c4 * at + 3.0 * c3) * at + 2.0 * c2) * at + c1);
        let next = if newton > min && newton < max { newton } else { 0.5 * (min + max) };
        let moved = (next - at).abs();
        at = next;
        if moved <= f64::EPSILON * at.abs() {
            break;
        }
    }
    if N::IS_LAST {
        return Some(at);
    }
    let off = SMALL * (before + at).abs();
    let sign = if rises { 1 } else { -1 };
    let surely = |end: f64, sign: i32| end <= first || end >= last || value(c, end).sign() == Some(sign);
    (surely(at + off, sign) && surely(at - off, -sign)).then_some(at)
}
