use serde::{Deserialize, Serialize};

/// A reconstruction filter: a sample's weight by its offset from the pixel's centre, a separable product over x and y.
///
/// Beyond its radius, in pixels, a filter is zero; a larger radius blurs more and passes less of the detail that is
/// finer than a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Filter {
    /// Constant: with a radius of 0.5, the pixel's own square.
    Box {
        /// In pixels.
        #[serde(default = "half")]
        radius: f64,
    },
    /// Linear falloff.
    Tent {
        /// In pixels.
        #[serde(default = "one")]
        radius: f64,
    },
    /// The Gaussian, shifted down so that it ends at zero.
    Gaussian {
        /// In pixels.
        #[serde(default = "one_and_a_half")]
        radius: f64,
        /// The standard deviation in pixels.
        #[serde(default = "half")]
        sigma: f64,
    },
    /// Piecewise cubic, with negative lobes that sharpen (Mitchell and Netravali 1988).
    Mitchell {
        /// In pixels.
        #[serde(default = "two")]
        radius: f64,
        /// B: more blurs more; from 0 to 1.
        #[serde(default = "third")]
        b: f64,
        /// C: more sharpens more, and rings more; from 0 to 1, with no negative lobes at 0.
        #[serde(default = "third")]
        c: f64,
    },
    /// The Blackman–Harris window, a sum of three cosines (Harris 1978).
    BlackmanHarris {
        /// In pixels.
        #[serde(default = "one_and_a_half")]
        radius: f64,
    },
}

impl Filter {
    /// The pixel's own square, with constant weight.
    pub const BOX: Self = Self::Box { radius: half() };
    /// A tent that ends at the centres of the neighbouring pixels.
    pub const TENT: Self = Self::Tent { radius: one() };
    /// The default: non-negative, with little aliasing left.
    pub const GAUSSIAN: Self = Self::Gaussian { radius: one_and_a_half(), sigma: half() };
    /// The parameters that its authors recommend, B = C = 1/3.
    pub const MITCHELL: Self = Self::Mitchell { radius: two(), b: third(), c: third() };
    /// About as wide as the Gaussian.
    pub const BLACKMAN_HARRIS: Self = Self::BlackmanHarris { radius: one_and_a_half() };

    /// All filters with their default parameters, each with its word on the command line.
    pub const ALL: [(&str, Self); 5] = [
        ("box", Self::BOX),
        ("tent", Self::TENT),
        ("gaussian", Self::GAUSSIAN),
        ("mitchell", Self::MITCHELL),
        ("blackman-harris", Self::BLACKMAN_HARRIS),
    ];

    /// Whether it has negative lobes.
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
