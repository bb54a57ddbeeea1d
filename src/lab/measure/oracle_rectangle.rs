//! The exact oracle of a ray against a rectangle.
//!
//! Reads: the f32 ray and the planar shape that a kernel sees, in render space. Writes: hit or miss without any rounding,
//! and t with a relative error below 2^-319.

use super::enclosure::Enclosure;
use super::exact::Dyadic;
use super::number::Number;
use super::oracle_disk::Crossing;
use glam::Vec3;
use pinhole::shapes::Planar;

/// The t > 0 at which the ray hits the rectangle, if it does; nothing where these numbers cannot tell.
fn hit<N: Number>(origin: Vec3, direction: Vec3, planar: &Planar) -> Option<Option<N>> {
    let crossing = Crossing::<N>::of(origin, direction, planar);
    if !crossing.is_ahead()? {
        return Some(None);
    }
    for part in &crossing.at {
        // |x| ≤ 1, times the approach and squared.
        let beyond = part.by(part).less(&crossing.approach.by(&crossing.approach));
        if beyond.sign()? > 0 {
            return Some(None);
        }
    }
    Some(Some(crossing.t()))
}

/// The t > 0 at which the ray hits the rectangle, or nothing when it does not, lies along it or starts on its plane.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn rectangle_hit(origin: Vec3, direction: Vec3, planar: &Planar) -> Option<Dyadic> {
    hit(origin, direction, planar).flatten()
}

/// The same t, rounded to f64 once.
#[must_use]
pub fn rectangle_t(origin: Vec3, direction: Vec3, planar: &Planar) -> Option<f64> {
    enclosed_rectangle_t(origin, direction, planar)
        .unwrap_or_else(|| rectangle_hit(origin, direction, planar).map(|t| t.to_f64()))
}

/// The same by enclosures; nothing where these cannot tell.
pub fn enclosed_rectangle_t(origin: Vec3, direction: Vec3, planar: &Planar) -> Option<Option<f64>> {
    match hit::<Enclosure>(origin, direction, planar)? {
        None => Some(None),
        Some(t) => t.rounded().map(Some),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn edges_and_corners_are_hits_and_the_next_number_a_miss() {
        let planar = Planar::new(DVec3::NEG_Y * 5.0, DVec3::Y, [DVec3::X * 2.0, DVec3::Z]).expect("an area");
        let at = |x: f32, z: f32| rectangle_hit(Vec3::new(x, 0.0, z), Vec3::NEG_Y, &planar).map(|t| t.to_f64());
        assert_eq!(at(2.0, -1.0), Some(5.0));
        assert_eq!(at(-2.0, 0.25), Some(5.0));
        assert_eq!(at(2.0 + 2.0 * f32::EPSILON, 0.0), None);
        assert_eq!(at(2.0, 1.0 + f32::EPSILON), None);
    }
}
