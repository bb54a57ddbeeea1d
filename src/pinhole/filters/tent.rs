use super::cells::FilterCells;
use super::kernel::Kernel;

/// The tent filter.
#[derive(Clone, Copy, Debug)]
pub struct TentKernel {
    /// In pixels.
    pub radius: f64,
}

impl Kernel for TentKernel {
    const HAS_CLOSED_FORM: bool = true;

    fn radius(self) -> f64 {
        self.radius
    }

    fn value(self, x: f64) -> f64 {
        1.0 - x / self.radius
    }

    fn area(self, x: f64) -> f64 {
        x * (1.0 - x / (2.0 * self.radius))
    }

    #[inline(always)]
    fn offset(self, u: f64, _cells: &FilterCells) -> (f64, bool) {
        (tent_offset(u, self.radius), false)
    }
}

// ANCHOR: tent_offset
/// Samples the tent filter of that radius by inverting its CDF, a parabola on each side.
#[inline(always)]
pub fn tent_offset(u: f64, radius: f64) -> f64 {
    let side = 2.0 * u - 1.0;
    (radius * (1.0 - (1.0 - side.abs()).sqrt())).copysign(side)
}
// ANCHOR_END: tent_offset
