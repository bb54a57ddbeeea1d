//! A ray and the eight boxes of a node.

use super::bounding_box::BoundingBox;
use super::by_axis;
use super::wide_node::{WIDTH, WideNode};
use glam::DVec3;

use crate::each::Each;

// ANCHOR: far
/// u = 2⁻²⁴, the unit roundoff of f32.
const UNIT_ROUNDOFF: f32 = 1.0 / (1_u64 << 24) as f32;
/// 1 + 2γ₃ and a little more: what the far planes are multiplied by (Ize, *Robust BVH Ray Traversal*, 2013).
const FAR: f32 = 1.0 + 8.0 * UNIT_ROUNDOFF;
// ANCHOR_END: far
/// A direction's component below this, where the largest lies in [1, 2), counts as either sign and as 0.
const PARALLEL: f64 = 1e-30;
/// An origin farther away than this many times the extent of what is in the hierarchy is moved on to it.
const FAR_AWAY: f64 = 16.0;

/// A ray along one axis, in f32, rounded such that the interval of a slab never shrinks.
///
/// Each plane is at (plane − O) / R.
/// Where the ray enters a slab, O and 1/R are rounded such that this can only become smaller; where it leaves it, such
/// that it can only become larger, by three more roundings than there are.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct AxisRay {
    /// O and 1/R for the plane at which it enters.
    pub enter: [f32; 2],
    /// O and 1/R for the plane at which it leaves.
    pub leave: [f32; 2],
    /// Whether it goes towards smaller coordinates, and so enters slabs by their upper planes.
    pub backwards: bool,
}

impl AxisRay {
    /// A ray whose origin is at `origin` up to `error`; the largest component of the direction lies in [1/2, 4).
    ///
    /// A ray that is as good as parallel to the planes has a finite 1/R where it enters, so that a plane through the
    /// origin gives 0; where it leaves 1/R is infinite, and 0 · ∞ makes NaN, which no comparison lets through.
    #[inline(always)]
    pub fn new(origin: f64, error: f64, direction: f64) -> Self {
        let (low, high) = (-about_rounded_up(error - origin), about_rounded_up(origin + error));
        let inverse = 1.0 / direction;
        let backwards = inverse.is_sign_negative();
        let sign = if backwards { -1.0 } else { 1.0 };
        let parallel = !(direction.abs() >= PARALLEL);
        let enter = if parallel { sign * (1.0 / PARALLEL) as f32 } else { inverse as f32 };
        let leave = if parallel { sign * f32::INFINITY } else { inverse as f32 * FAR };
        let (first, last) = if backwards { (low, high) } else { (high, low) };
        Self { enter: [first, enter], leave: [last, leave], backwards }
    }
}

/// The same for several rays, component by component.
#[derive(Clone, Copy)]
struct AxisRays<const N: usize> {
    enter: [[f32; N]; 2],
    leave: [[f32; N]; 2],
    first: [u32; N],
}

impl<const N: usize> AxisRays<N> {
    const NONE: Self = Self { enter: [[0.0; N]; 2], leave: [[0.0; N]; 2], first: [0; N] };

    #[inline(always)]
    fn set(&mut self, i: usize, ray: &AxisRay) {
        (self.enter[0][i], self.enter[1][i]) = (ray.enter[0], ray.enter[1]);
        (self.leave[0][i], self.leave[1][i]) = (ray.leave[0], ray.leave[1]);
        self.first[i] = u32::from(ray.backwards);
    }
}

/// A ray as the boxes see it, such that no box is missed that the ray in f64 hits.
#[derive(Clone, Copy, Debug, Default)]
pub struct BoxRay {
    /// Which planes it enters slabs by, by axis: 0 for the lower ones, 1 for the upper ones.
    first: [u32; 3],
    /// O and 1/R for the planes at which it enters, by axis.
    enter: [[f32; 3]; 2],
    /// O and 1/R for the planes at which it leaves, by axis.
    leave: [[f32; 3]; 2],
    /// The t at which τ = 0, where the intervals of slabs are measured in τ = (t − start) · unit.
    start: f64,
    unit: f64,
}

impl BoxRay {
    /// A ray O + tR, for a hierarchy with this box.
    #[inline(always)]
    pub fn new(origin: DVec3, direction: DVec3, around: &BoundingBox) -> Self {
        let mut ray = [Self::default()];
        Self::fill([&by_axis(|axis| [origin[axis]]), &by_axis(|axis| [direction[axis]])], around, &mut ray);
        ray[0]
    }

    /// The same for `N` rays, which are given component by component, so that one instruction works on several.
    ///
    /// An origin that is far away is moved on along the ray, or f32 would not resolve the boxes from there.
    /// The direction may have any length: τ is t in units in which its largest component lies in [1, 2).
    /// A ray that is not finite has a unit that is none, so that it enters nothing.
    #[inline(always)]
    pub fn fill<const N: usize>([o, d]: [&[[f64; N]; 3]; 2], around: &BoundingBox, rays: &mut [Self]) {
        let extent = (0..3).map(|axis| f64::from(around.high[axis] - around.low[axis]));
        let extent = extent.fold(0.0, |max, extent| if extent > max { extent } else { max });
        let centre = by_axis(|axis| 0.5 * f64::from(around.doubled_centre(axis)));
        let (mut unit, mut far_away) = ([1.0; N], [false; N]);
        for i in 0..N {
            let [x, y, z] = by_axis(|axis| d[axis][i].abs());
            let largest = if x > y { x } else { y };
            // 0 for numbers, and otherwise none.
            let finite = by_axis(|axis| 0.0 * d[axis][i] + 0.0 * o[axis][i]);
            unit[i] = power_of_two_below(if largest > z { largest } else { z }) + (finite[0] + finite[1] + finite[2]);
            let far = by_axis(|axis| (centre[axis] - o[axis][i]).abs() > FAR_AWAY * extent);
            far_away[i] = far[0] | far[1] | far[2];
        }
        let (mut moved, mut error) = ([0.0; N], [0.0; N]);
        if far_away.iter().fold(false, |any, is| any | is) {
            for i in (0..N).filter(|&i| far_away[i]) {
                let [origin, direction] = [o, d].each(|of| DVec3::from(by_axis(|axis| of[axis][i])));
                (moved[i], error[i]) = moved_towards(DVec3::from(centre), extent, origin, direction / unit[i]);
            }
        }
        let mut axes = [AxisRays::<N>::NONE; 3];
        for axis in 0..3 {
            for i in 0..N {
                let direction = d[axis][i] * (1.0 / unit[i]);
                axes[axis].set(i, &AxisRay::new(o[axis][i] + moved[i] * direction, error[i], direction));
            }
        }
        for (i, ray) in rays.iter_mut().enumerate().take(N) {
            *ray = Self {
                first: by_axis(|axis| axes[axis].first[i]),
                enter: [by_axis(|axis| axes[axis].enter[0][i]), by_axis(|axis| axes[axis].enter[1][i])],
                leave: [by_axis(|axis| axes[axis].leave[0][i]), by_axis(|axis| axes[axis].leave[1][i])],
                start: moved[i] / unit[i],
                unit: unit[i],
            };
        }
    }

    /// A t_max in units of τ, rounded up by more than the error of both.
    #[inline(always)]
    pub fn limit(&self, t_max: f64) -> f32 {
        padded_limit(t_max - self.start, self.unit)
    }

    /// The same of the smallest t so far, which is negative if there is nothing more to find: then no box is entered.
    #[inline(always)]
    pub(super) fn limit_so_far(&self, t: f64) -> f32 {
        if t < 0.0 { -1.0 } else { self.limit(t) }
    }

    // ANCHOR: enters_eight
    /// The boxes of a node that the ray enters before `limit`, as a byte each, 0 or 1; `entry` receives
    /// where it enters each of them.
    ///
    /// Where a plane contains the origin and the ray, 0 · ∞ makes NaN: every comparison with it is false, so that the
    /// slab leaves the interval as it is.
    #[inline(always)]
    pub fn enters(&self, node: &WideNode, limit: f32, entry: &mut [f32; WIDTH]) -> u64 {
        let [near, far] = node.enter_and_leave(self.first);
        let mut enters = [0_u8; WIDTH];
        for child in 0..WIDTH {
            let (mut from, mut until) = (0.0, limit);
            for axis in 0..3 {
                let t = (near[axis][child] - self.enter[0][axis]) * self.enter[1][axis];
                from = if t > from { t } else { from };
                let t = (far[axis][child] - self.leave[0][axis]) * self.leave[1][axis];
                until = if t < until { t } else { until };
            }
            // The choice makes both ends of the interval part of what is stored, and so of the same vectors.
            entry[child] = if from <= until { from } else { f32::INFINITY };
            enters[child] = u8::from(from <= until);
        }
        u64::from_le_bytes(enters)
    }
    // ANCHOR_END: enters_eight

    /// Where the ray enters the boxes of a node, up to `limit`; infinite for those that it does not enter.
    ///
    /// The numbers of [`Self::enters`], for loops over many rays: each step is a loop of its own over the eight boxes,
    /// which is one instruction there. Where one ray goes on by a mask, the other form takes less time.
    #[inline(always)]
    pub(super) fn entries(&self, node: &WideNode, limit: f32, entry: &mut [f32; WIDTH]) {
        let [near, far] = node.enter_and_leave(self.first);
        let (mut from, mut until) = ([0.0; WIDTH], [limit; WIDTH]);
        for axis in 0..3 {
            let (origin, inverse) = (self.enter[0][axis], self.enter[1][axis]);
            for child in 0..WIDTH {
                let t = (near[axis][child] - origin) * inverse;
                from[child] = if t > from[child] { t } else { from[child] };
            }
            let (origin, inverse) = (self.leave[0][axis], self.leave[1][axis]);
            for child in 0..WIDTH {
                let t = (far[axis][child] - origin) * inverse;
                until[child] = if t < until[child] { t } else { until[child] };
            }
        }
        for child in 0..WIDTH {
            // A box that is entered beyond all numbers of f32 is entered.
            let finite = if from[child] < f32::MAX { from[child] } else { f32::MAX };
            entry[child] = if from[child] <= until[child] { finite } else { f32::INFINITY };
        }
    }
}

/// How far an origin is moved on along a ray, in τ, and what the rounding of that may add to it.
#[cold]
#[inline(never)]
fn moved_towards(centre: DVec3, extent: f64, origin: DVec3, direction: DVec3) -> (f64, f64) {
    const ROUNDING: f64 = 1.0 / (1_u64 << 48) as f64;
    // One extent before the centre: more than half the diagonal, so that every box lies ahead.
    let along = (centre - origin).dot(direction) / direction.length_squared() - extent;
    if !(along.is_finite() && along > 0.0) {
        return (0.0, 0.0);
    }
    (along, ROUNDING * (origin.abs().element_sum() + along * direction.abs().element_sum()))
}

/// Takes the first child off a mask of bytes, which must not be 0.
#[inline(always)]
pub fn take_first(mask: &mut u64) -> usize {
    let first = mask.trailing_zeros() / 8;
    *mask &= *mask - 1;
    first as usize % WIDTH
}

/// A t in units of τ, rounded up by more than the error of both.
#[inline(always)]
pub(super) fn padded_limit(t: f64, unit: f64) -> f32 {
    let limit = (t * unit) as f32;
    limit + limit.abs() * (8.0 * UNIT_ROUNDOFF)
}

/// A number of f32 that is at least this, and at most a few roundings more, without a branch.
///
/// It is always finite: beyond the numbers of f32 it is the last of them, which as an origin is on the same side of
/// every plane, and which keeps the planes of an empty box, which are infinite, from making NaN where a ray leaves it.
#[inline(always)]
fn about_rounded_up(x: f64) -> f32 {
    let x = if x > f64::from(f32::MIN) { x } else { f64::from(f32::MIN) };
    let x = if x < f64::from(f32::MAX) { x } else { f64::from(f32::MAX) };
    let rounded = x as f32;
    let more = rounded.abs() * (2.0 * UNIT_ROUNDOFF) + f32::MIN_POSITIVE;
    let above = rounded + if f64::from(rounded) < x { more } else { 0.0 };
    if above < f32::MAX { above } else { f32::MAX }
}

/// The power of two in (x/2, x], for a normal number x > 0; 1 where there is none.
#[inline(always)]
pub(super) fn power_of_two_below(x: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff << 52;
    let power = f64::from_bits(x.to_bits() & EXPONENT);
    if power > 0.0 && power.is_finite() { power } else { 1.0 }
}
