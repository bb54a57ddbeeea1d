use super::cells::FilterCells;
use super::kernel::Kernel;

/// The box filter.
#[derive(Clone, Copy, Debug)]
pub struct BoxKernel {
    /// In pixels.
    pub radius: f64,
}

impl Kernel for BoxKernel {
    const HAS_CLOSED_FORM: bool = true;

    fn radius(self) -> f64 {
        self.radius
    }

    fn value(self, _x: f64) -> f64 {
        1.0
    }

    fn area(self, x: f64) -> f64 {
        x
    }

    #[inline(always)]
    fn offset(self, u: f64, _cells: &FilterCells) -> (f64, bool) {
        (box_offset(u, self.radius), false)
    }
}

/// Samples the box filter of that radius: maps u in [0, 1) to an offset from the pixel's centre, linearly.
#[inline(always)]
pub fn box_offset(u: f64, radius: f64) -> f64 {
    (2.0 * u - 1.0) * radius
}
