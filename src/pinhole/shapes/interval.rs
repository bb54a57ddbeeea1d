/// A t with an interval that contains its exact value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interval {
    /// The value as computed.
    pub t: f64,
    /// No more than the exact value.
    pub least: f64,
    /// No less than it.
    pub most: f64,
}

impl Interval {
    #[inline(always)]
    pub fn new(t: f64, error: f64) -> Self {
        Self { t, least: t - error, most: t + error }
    }

    /// The larger of each number; a NaN is never taken over, for comparisons with it are false.
    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        let larger = |a: f64, b: f64| if b > a { b } else { a };
        Self { t: larger(self.t, other.t), least: larger(self.least, other.least), most: larger(self.most, other.most) }
    }

    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        let smaller = |a: f64, b: f64| if b < a { b } else { a };
        Self {
            t: smaller(self.t, other.t),
            least: smaller(self.least, other.least),
            most: smaller(self.most, other.most),
        }
    }
}
