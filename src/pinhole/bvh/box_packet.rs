//! A packet of rays and the boxes of a node.
//!
//! At inner nodes intervals of origins and directions stand for all of the rays, which makes one slab test of
//! sixty-four; before a leaf the rays are tested eight at a time.

use super::by_axis;
use super::slab_test::{AxisRay, padded_limit, power_of_two_below};
use super::wide_node::{WIDTH, WideNode};

/// The rays that are tested side by side.
pub const ROW: usize = 8;
/// The rows of a packet.
pub const ROWS: usize = 8;
/// The rays of a packet.
pub const PACKET: usize = ROW * ROWS;

/// A number for each ray of a packet.
pub type PerRay<T> = [[T; ROW]; ROWS];

/// The rays of a packet as boxes see them, each as a [`BoxRay`](super::BoxRay) is.
#[derive(Clone, Debug, Default)]
pub struct BoxPacket {
    /// Which planes all of them enter slabs by, by axis: 0 for the lower ones, 1 for the upper ones.
    first: [u32; 3],
    /// O and 1/R for the planes at which they enter, by axis.
    enter: [[PerRay<f32>; 2]; 3],
    /// O and 1/R for the planes at which they leave, by axis.
    leave: [[PerRay<f32>; 2]; 3],
    /// The same for all rays at once: the O that makes the interval of a slab largest, and the bounds of 1/R.
    all_enter: [(f32, [f32; 2]); 3],
    all_leave: [(f32, [f32; 2]); 3],
    /// τ over t.
    unit: f64,
}

#[inline(always)]
fn min(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

#[inline(always)]
fn max(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// The least and the greatest number of a packet, of which none is NaN.
#[inline(always)]
fn bounds(of: &PerRay<f32>) -> [f32; 2] {
    let (mut low, mut high) = (of[0], of[0]);
    for row in &of[1..] {
        for i in 0..ROW {
            (low[i], high[i]) = (min(low[i], row[i]), max(high[i], row[i]));
        }
    }
    [low.into_iter().fold(low[0], min), high.into_iter().fold(high[0], max)]
}

impl BoxPacket {
    /// Sets its rays, which must be finite; the signs of their directions must agree, and the sizes of their largest
    /// components, one of which is `largest`, to within a factor of 2.
    #[inline(always)]
    pub fn set(&mut self, origin: &[PerRay<f64>; 3], direction: &[PerRay<f64>; 3], largest: f64) {
        self.unit = power_of_two_below(largest.abs());
        let scale = 1.0 / self.unit;
        for axis in 0..3 {
            for row in 0..ROWS {
                for i in 0..ROW {
                    let ray = AxisRay::new(origin[axis][row][i], 0.0, direction[axis][row][i] * scale);
                    for part in 0..2 {
                        self.enter[axis][part][row][i] = ray.enter[part];
                        self.leave[axis][part][row][i] = ray.leave[part];
                    }
                }
            }
            let first = usize::from(direction[axis][0][0].is_sign_negative());
            self.first[axis] = first as u32;
            let [enter, leave] = [&self.enter[axis], &self.leave[axis]];
            self.all_enter[axis] = (bounds(&enter[0])[1 - first], bounds(&enter[1]));
            // The larger magnitude comes last: where it is infinite, 0 · ∞ = NaN must be the last operand in `enters`.
            let [low, high] = bounds(&leave[1]);
            self.all_leave[axis] = (bounds(&leave[0])[first], if first == 1 { [high, low] } else { [low, high] });
        }
    }

    /// A t_max in units of τ, rounded up by more than the error of both.
    #[inline(always)]
    pub fn limit(&self, t_max: f64) -> f32 {
        padded_limit(t_max, self.unit)
    }

    // ANCHOR: packet_enters
    /// The boxes of a node that any ray may enter before `limit`, as a byte each; `entry` receives a τ before
    /// which none enters it.
    ///
    /// No box is missed that one of the rays hits, since every step of the slab test is monotonic in O and in 1/R, in
    /// f32 too.
    /// Only a far plane's product can be NaN: `max` passes it on, and `min` drops it, so that it is no bound.
    #[inline(always)]
    pub fn enters(&self, node: &WideNode, limit: f32, entry: &mut [f32; WIDTH]) -> u64 {
        let [enter, leave] = node.enter_and_leave(self.first);
        let mut enters = [0_u8; WIDTH];
        for child in 0..WIDTH {
            let (mut from, mut until) = (0.0, limit);
            for axis in 0..3 {
                let (origin, inverse) = self.all_enter[axis];
                let near = enter[axis][child] - origin;
                from = max(min(near * inverse[0], near * inverse[1]), from);
                let (origin, inverse) = self.all_leave[axis];
                let far = leave[axis][child] - origin;
                until = min(max(far * inverse[0], far * inverse[1]), until);
            }
            entry[child] = from;
            enters[child] = u8::from(from <= until);
        }
        u64::from_le_bytes(enters)
    }
    // ANCHOR_END: packet_enters

    /// Whether any ray of a row enters the box of one child before its own limit.
    #[inline(always)]
    pub fn row_enters(&self, node: &WideNode, child: usize, row: usize, limits: &[f32; ROW]) -> bool {
        let [near, far] = node.enter_and_leave(self.first);
        let (near, far) = (by_axis(|axis| near[axis][child]), by_axis(|axis| far[axis][child]));
        let mut enters = [0_u8; ROW];
        for i in 0..ROW {
            let (mut from, mut until) = (0.0, limits[i]);
            for axis in 0..3 {
                let [enter, leave] = [&self.enter[axis], &self.leave[axis]];
                from = max((near[axis] - enter[0][row][i]) * enter[1][row][i], from);
                until = min((far[axis] - leave[0][row][i]) * leave[1][row][i], until);
            }
            enters[i] = u8::from(from <= until);
        }
        u64::from_le_bytes(enters) != 0
    }
}
