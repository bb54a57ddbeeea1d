//! Vectors of exact numbers, and of enclosed ones.

use super::enclosure::Enclosure;
use super::exact::{Dyadic, UNIT_ROUNDOFF_F32 as U};
use super::number::Number;
use glam::Vec3;

/// A point or a vector of three numbers, in whatever space its source was.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Vector<N> {
    /// The x component.
    pub x: N,
    /// The y component.
    pub y: N,
    /// The z component.
    pub z: N,
}

/// A vector of exact numbers.
pub type ExactVector = Vector<Dyadic>;

/// A vector of enclosed numbers.
pub type EnclosedVector = Vector<Enclosure>;

impl<N: Number> Vector<N> {
    /// The exact value of three floating point numbers, f32 or f64.
    ///
    /// # Panics
    /// When a component is not finite.
    #[must_use]
    pub fn of<T: Into<f64>>(components: impl Into<[T; 3]>) -> Self {
        let [x, y, z] = components.into().map(|component| N::of(component.into()));
        Self { x, y, z }
    }

    /// The scalar product.
    #[must_use]
    pub fn dot(&self, other: &Self) -> N {
        self.x.by(&other.x).plus(&self.y.by(&other.y)).plus(&self.z.by(&other.z))
    }

    /// The vector product.
    #[must_use]
    pub fn cross(&self, other: &Self) -> Self {
        let area = |a: &N, b: &N, c: &N, d: &N| a.by(d).less(&b.by(c));
        Self {
            x: area(&self.y, &self.z, &other.y, &other.z),
            y: area(&self.z, &self.x, &other.z, &other.x),
            z: area(&self.x, &self.y, &other.x, &other.y),
        }
    }

    /// This vector minus the other.
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        Self { x: self.x.less(&other.x), y: self.y.less(&other.y), z: self.z.less(&other.z) }
    }

    /// Each component times the factor.
    #[must_use]
    pub fn times(&self, factor: &N) -> Self {
        Self { x: self.x.by(factor), y: self.y.by(factor), z: self.z.by(factor) }
    }

    /// The length, good enough for the size of an error; nothing where that cannot be told.
    #[must_use]
    pub fn length_about(&self) -> Option<f64> {
        self.dot(self).about().map(f64::sqrt)
    }
}

impl ExactVector {
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

/// The angle between a normal and the exact one, in u; infinite where it points the other way.
///
/// Nothing where these numbers cannot tell, which exact ones always can.
fn angle<N: Number>(normal: Vec3, exact: &Vector<N>) -> Option<f64> {
    let normal = Vector::of(normal);
    if normal.dot(exact).sign()? <= 0 {
        return Some(f64::INFINITY);
    }
    let lengths = normal.dot(&normal).by(&exact.dot(exact)).about()?.sqrt();
    Some(normal.cross(exact).length_about()? / lengths / U)
}

/// The angles of two normals, by enclosures where these can tell and exactly where not.
pub fn angles(
    [first, second]: [Vec3; 2],
    enclosed: Option<EnclosedVector>,
    exact: impl FnOnce() -> Option<ExactVector>,
) -> Option<[f64; 2]> {
    let told = enclosed.and_then(|truth| Some([angle(first, &truth)?, angle(second, &truth)?]));
    told.or_else(|| {
        let truth = exact()?;
        Some([angle(first, &truth)?, angle(second, &truth)?])
    })
}
