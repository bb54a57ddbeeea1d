//! Vectors of exact numbers.

use super::exact::Dyadic;

/// A point or a vector of three exact numbers, in whatever space its source was.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExactVector {
    /// The x component.
    pub x: Dyadic,
    /// The y component.
    pub y: Dyadic,
    /// The z component.
    pub z: Dyadic,
}

impl ExactVector {
    /// The exact value of three floating point numbers, f32 or f64.
    ///
    /// # Panics
    /// When a component is not finite.
    #[must_use]
    pub fn of<T: Into<f64>>(components: impl Into<[T; 3]>) -> Self {
        let [x, y, z] = components.into().map(Dyadic::of);
        Self { x, y, z }
    }

    /// The scalar product, exactly.
    #[must_use]
    pub fn dot(&self, other: &Self) -> Dyadic {
        &(&(&self.x * &other.x) + &(&self.y * &other.y)) + &(&self.z * &other.z)
    }

    /// The vector product, exactly.
    #[must_use]
    pub fn cross(&self, other: &Self) -> Self {
        let area = |a: &Dyadic, b: &Dyadic, c: &Dyadic, d: &Dyadic| &(a * d) - &(b * c);
        Self {
            x: area(&self.y, &self.z, &other.y, &other.z),
            y: area(&self.z, &self.x, &other.z, &other.x),
            z: area(&self.x, &self.y, &other.x, &other.y),
        }
    }

    /// This vector minus the other, exactly.
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        Self { x: &self.x - &other.x, y: &self.y - &other.y, z: &self.z - &other.z }
    }

    /// Each component times the factor, exactly.
    #[must_use]
    pub fn times(&self, factor: &Dyadic) -> Self {
        Self { x: &self.x * factor, y: &self.y * factor, z: &self.z * factor }
    }

    /// The length times itself, rounded to f64 once.
    #[must_use]
    pub fn squared_length(&self) -> f64 {
        self.dot(self).to_f64()
    }

    /// The length, with a relative error below 2^-319.
    #[must_use]
    pub fn length(&self) -> Dyadic {
        self.dot(self).square_root()
    }
}
