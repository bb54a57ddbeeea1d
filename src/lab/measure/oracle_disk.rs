//! The exact oracle of a ray against a disk.
//!
//! Reads: the f32 ray and the planar shape that a kernel sees, in render space. Writes: hit or miss without any rounding,
//! and t with a relative error below 2^-319.
//! What is exact is the disk that the table describes; that its normal is rounded to f32 is part of that.

use super::enclosure::Enclosure;
use super::exact::Dyadic;
use super::exact_vector::Vector;
use super::number::Number;
use glam::{DVec3, Vec3};
use pinhole::shapes::Planar;
use std::cmp::Ordering;

/// Where the line of a ray crosses a planar shape's plane: t is `distance` over `approach`, and the coordinates there are
/// `at` over `approach`.
pub(super) struct Crossing<N> {
    pub distance: N,
    pub approach: N,
    pub at: [N; 2],
}

impl<N: Number> Crossing<N> {
    pub fn of(origin: Vec3, direction: Vec3, planar: &Planar) -> Self {
        let f: Vector<N> = Vector::of(planar.centre).minus(&Vector::of(origin));
        let (normal, direction) = (Vector::of(planar.normal), Vector::of(direction));
        let (distance, approach) = (normal.dot(&f), normal.dot(&direction));
        let along_ray = direction.times(&distance).minus(&f.times(&approach));
        let at = planar.along.map(|along| Vector::of(along).dot(&along_ray));
        Self { distance, approach, at }
    }

    /// Whether t is above 0; nothing where these numbers cannot tell.
    pub fn is_ahead(&self) -> Option<bool> {
        Some(self.distance.sign()? * self.approach.sign()? > 0)
    }

    /// t; the approach is not 0.
    pub fn t(&self) -> N {
        self.distance.over(&self.approach)
    }
}

/// The t > 0 at which the ray hits the disk, if it does; nothing where these numbers cannot tell.
fn hit<N: Number>(origin: Vec3, direction: Vec3, planar: &Planar) -> Option<Option<N>> {
    let crossing = Crossing::<N>::of(origin, direction, planar);
    let [x, z] = &crossing.at;
    if !crossing.is_ahead()? {
        return Some(None);
    }
    let beyond = x.by(x).plus(&z.by(z)).less(&crossing.approach.by(&crossing.approach));
    Some((beyond.sign()? <= 0).then(|| crossing.t()))
}

/// The t > 0 at which the ray hits the disk, or nothing when it does not, lies along it or starts on its plane.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn disk_hit(origin: Vec3, direction: Vec3, planar: &Planar) -> Option<Dyadic> {
    hit(origin, direction, planar).flatten()
}

/// The same t, rounded to f64 once.
#[must_use]
pub fn disk_t(origin: Vec3, direction: Vec3, planar: &Planar) -> Option<f64> {
    enclosed_disk_t(origin, direction, planar)
        .unwrap_or_else(|| disk_hit(origin, direction, planar).map(|t| t.to_f64()))
}

/// The same by enclosures; nothing where these cannot tell.
pub fn enclosed_disk_t(origin: Vec3, direction: Vec3, planar: &Planar) -> Option<Option<f64>> {
    match hit::<Enclosure>(origin, direction, planar)? {
        None => Some(None),
        Some(t) => t.rounded().map(Some),
    }
}

/// n · (point − C), of no particular length.
fn height<N: Number>(point: DVec3, planar: &Planar) -> N {
    Vector::of(planar.normal).dot(&Vector::of(point).minus(&Vector::of(planar.centre)))
}

/// How a point lies to the plane of a planar shape, exactly: `Greater` is strictly on the side of its normal.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn side_of_planar(point: DVec3, planar: &Planar) -> Ordering {
    let enclosed = height::<Enclosure>(point, planar).sign();
    enclosed.unwrap_or_else(|| height::<Dyadic>(point, planar).sign()).cmp(&0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half axes 2 along x and 1 along z, five below the eye.
    fn ellipse() -> Planar {
        Planar::new(DVec3::NEG_Y * 5.0, DVec3::Y, [DVec3::X * 2.0, DVec3::Z]).expect("an area")
    }

    #[test]
    fn the_edge_is_a_hit_and_the_next_number_a_miss() {
        let at = |x: f32, z: f32| disk_hit(Vec3::new(x, 0.0, z), Vec3::NEG_Y, &ellipse()).map(|t| t.to_f64());
        assert_eq!(at(2.0, 0.0), Some(5.0));
        assert_eq!(at(0.0, -1.0), Some(5.0));
        assert_eq!(at(2.0 + 2.0 * f32::EPSILON, 0.0), None);
        assert_eq!(at(1.5, 0.75), None);
        assert_eq!(disk_hit(Vec3::ZERO, Vec3::Y, &ellipse()), None);
        assert_eq!(disk_hit(Vec3::NEG_Y * 5.0, Vec3::NEG_Y, &ellipse()), None);
        assert_eq!(disk_hit(Vec3::new(-9.0, -5.0, 0.0), Vec3::X, &ellipse()), None);
    }
}
