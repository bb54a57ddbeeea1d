use serde::{Deserialize, Serialize};

/// What a sample counts for, by its distance from the pixel's centre: the same along and across, multiplied.
///
/// A filter's radius, in pixels, is where it ends; a larger one blurs more, and lets less of what is finer than a pixel
/// through.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Filter {
    /// All alike: with a radius of 0.5, the pixel's own square.
    Box {
        /// In pixels.
        #[serde(default = "half")]
        radius: f64,
    },
    /// Less and less in a straight line.
    Tent {
        /// In pixels.
        #[serde(default = "one")]
        radius: f64,
    },
    /// The bell curve, lowered so that it ends at 0.
    Gaussian {
        /// In pixels.
        #[serde(default = "one_and_a_half")]
        radius: f64,
        /// The bell's standard deviation in pixels.
        #[serde(default = "half")]
        sigma: f64,
    },
    /// Cubics with negative parts, which sharpen (Mitchell and Netravali 1988).
    Mitchell {
        /// In pixels.
        #[serde(default = "two")]
        radius: f64,
        /// Their blur, from 0 to 1.
        #[serde(default = "third")]
        b: f64,
        /// Their ringing, from 0 to 1; at 0 nothing is negative.
        #[serde(default = "third")]
        c: f64,
    },
    /// A window of three cosines, smooth to its end (Harris 1978).
    BlackmanHarris {
        /// In pixels.
        #[serde(default = "one_and_a_half")]
        radius: f64,
    },
}

impl Filter {
    /// All samples of the pixel's own square alike.
    pub const BOX: Self = Self::Box { radius: half() };
    /// A tent that ends at the neighbours' centres.
    pub const TENT: Self = Self::Tent { radius: one() };
    /// The default: nothing negative, and little of what is finer than a pixel left.
    pub const GAUSSIAN: Self = Self::Gaussian { radius: one_and_a_half(), sigma: half() };
    /// The one that its authors recommend, B = C = 1/3.
    pub const MITCHELL: Self = Self::Mitchell { radius: two(), b: third(), c: third() };
    /// About as wide as the Gaussian.
    pub const BLACKMAN_HARRIS: Self = Self::BlackmanHarris { radius: one_and_a_half() };

    /// All, each as it is unless told otherwise, with the words of the command line.
    pub const ALL: [(&str, Self); 5] = [
        ("box", Self::BOX),
        ("tent", Self::TENT),
        ("gaussian", Self::GAUSSIAN),
        ("mitchell", Self::MITCHELL),
        ("blackman-harris", Self::BLACKMAN_HARRIS),
    ];

    /// Whether some samples count negatively.
    pub fn is_signed(self) -> bool {
        matches!(self, Self::Mitchell { c, .. } if c > 0.0)
    }
}

impl Default for Filter {
    fn default() -> Self {
        Self::GAUSSIAN
    }
}

const fn half() -> f64 {
    0.5
}

const fn third() -> f64 {
    1.0 / 3.0
}

const fn one() -> f64 {
    1.0
}

const fn one_and_a_half() -> f64 {
    1.5
}

const fn two() -> f64 {
    2.0
}
