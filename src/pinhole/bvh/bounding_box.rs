use crate::each::Each;
use glam::DVec3;

/// An axis-aligned bounding box in f32, as the nodes of a hierarchy hold it.
///
/// The default is the empty box, which contains nothing and which every ray misses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundingBox {
    /// The corner of minimum x, y and z.
    pub low: [f32; 3],
    /// The corner of maximum x, y and z.
    pub high: [f32; 3],
}

impl Default for BoundingBox {
    fn default() -> Self {
        Self { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] }
    }
}

impl BoundingBox {
    /// The smallest box of f32 coordinates around one of f64 coordinates.
    pub fn around(low: DVec3, high: DVec3) -> Self {
        Self { low: low.to_array().each(rounded_down), high: high.to_array().each(rounded_up) }
    }

    /// Enlarges it such that it contains another.
    #[inline(always)]
    pub fn enclose(&mut self, other: &Self) {
        // An ordered comparison, where glam's and the standard library's ask after NaN too.
        for axis in 0..3 {
            self.low[axis] = if other.low[axis] < self.low[axis] { other.low[axis] } else { self.low[axis] };
            self.high[axis] = if other.high[axis] > self.high[axis] { other.high[axis] } else { self.high[axis] };
        }
    }

    /// Half its surface area, to which the probability that a ray hits it is proportional; 0 for the empty box.
    #[inline(always)]
    pub fn half_area(&self) -> f32 {
        let [x, y, z] = [0, 1, 2].map(|axis| self.high[axis] - self.low[axis]);
        if x >= 0.0 { x * y + y * z + z * x } else { 0.0 }
    }

    /// Twice its centre along an axis.
    #[inline(always)]
    pub fn doubled_centre(&self, axis: usize) -> f32 {
        self.low[axis] + self.high[axis]
    }
}

/// The largest number of f32 that is at most this.
#[inline(always)]
pub fn rounded_down(x: f64) -> f32 {
    let rounded = x as f32;
    if f64::from(rounded) > x { rounded.next_down() } else { rounded }
}

/// The smallest number of f32 that is at least this.
#[inline(always)]
pub fn rounded_up(x: f64) -> f32 {
    let rounded = x as f32;
    if f64::from(rounded) < x { rounded.next_up() } else { rounded }
}
