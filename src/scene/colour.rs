use glam::DVec3;
use serde::{Deserialize, Serialize};

/// Red, green and blue in linear Rec. 709: twice the value is twice the light.
///
/// Which quantity it measures (an albedo, a radiance, an intensity) is stated by the field that holds it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(from = "[f64; 3]", into = "[f64; 3]")]
pub struct Rgb {
    /// Red.
    pub r: f64,
    /// Green.
    pub g: f64,
    /// Blue.
    pub b: f64,
}

impl Rgb {
    /// No light at all.
    pub const BLACK: Self = Self::grey(0.0);

    /// A colour from its three components.
    pub const fn new(r: f64, g: f64, b: f64) -> Self {
        Self { r, g, b }
    }

    /// The same value in all three components.
    pub const fn grey(value: f64) -> Self {
        Self::new(value, value, value)
    }

    /// The components as an array, in order.
    pub const fn to_array(self) -> [f64; 3] {
        [self.r, self.g, self.b]
    }

    /// The components as a vector, for arithmetic.
    pub const fn to_vec(self) -> DVec3 {
        DVec3::new(self.r, self.g, self.b)
    }
}

impl From<[f64; 3]> for Rgb {
    fn from([r, g, b]: [f64; 3]) -> Self {
        Self::new(r, g, b)
    }
}

impl From<Rgb> for [f64; 3] {
    fn from(colour: Rgb) -> Self {
        colour.to_array()
    }
}
