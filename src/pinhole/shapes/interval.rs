/// A t with an interval that contains its exact value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interval {
    /// The value as computed.
    pub t: f64,
    /// No more than the exact value.
    pub min: f64,
    /// No less than it.
    pub max: f64,
}

impl Interval {
    #[inline(always)]
    pub fn new(t: f64, error: f64) -> Self {
        Self { t, min: t - error, max: t + error }
    }

    /// The larger of each number; a NaN is never taken over, for comparisons with it are false.
    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        let larger = |a: f64, b: f64| if b > a { b } else { a };
        Self { t: larger(self.t, other.t), min: larger(self.min, other.min), max: larger(self.max, other.max) }
    }

    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        let smaller = |a: f64, b: f64| if b < a { b } else { a };
        Self { t: smaller(self.t, other.t), min: smaller(self.min, other.min), max: smaller(self.max, other.max) }
    }
}
