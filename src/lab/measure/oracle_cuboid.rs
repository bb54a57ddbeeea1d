//! The exact oracle of a ray against a cuboid.
//!
//! Reads: the f32 ray and the slabs that a kernel sees, in render space. Writes: hit or miss and the face without any
//! rounding, and t with a relative error below 2^-319.

use super::enclosure::Enclosure;
use super::exact::Dyadic;
use super::exact_vector::Vector;
use super::number::Number;
use glam::{DVec3, Vec3};
use pinhole::shapes::Slabs;

/// A t as a quotient, the lower number above 0, and the axis of its face.
#[derive(Clone)]
struct Fraction<N> {
    over: N,
    under: N,
    axis: usize,
}

impl<N: Number> Fraction<N> {
    fn sign_of_less(&self, other: &Self) -> Option<i32> {
        self.over.by(&other.under).less(&other.over.by(&self.under)).sign()
    }
}

/// The nearest t > 0 on a face and that face's axis, the first where several are hit at once; nothing where these
/// numbers cannot tell.
fn hit<N: Number>(origin: Vec3, direction: Vec3, slabs: &Slabs) -> Option<Option<(N, usize)>> {
    let f: Vector<N> = Vector::of(slabs.centre).minus(&Vector::of(origin));
    let direction = Vector::of(direction);
    let (mut enters, mut leaves): (Option<Fraction<N>>, Option<Fraction<N>>) = (None, None);
    let nothing = || N::of(0.0);
    for axis in 0..3 {
        let normal = Vector::of(slabs.normal[axis]);
        let (middle, approach, half) = (normal.dot(&f), normal.dot(&direction), N::of(slabs.half[axis]));
        let sign = approach.sign()?;
        let (middle, approach) =
            if sign < 0 { (nothing().less(&middle), nothing().less(&approach)) } else { (middle, approach) };
        let (near, far) = (middle.less(&half), middle.plus(&half));
        if sign == 0 {
            if near.sign()? > 0 || far.sign()? < 0 {
                return Some(None);
            }
            continue;
        }
        let near = Fraction { over: near, under: approach.clone(), axis };
        let far = Fraction { over: far, under: approach, axis };
        enters = match enters {
            Some(before) if near.sign_of_less(&before)? <= 0 => Some(before),
            _ => Some(near),
        };
        leaves = match leaves {
            Some(before) if far.sign_of_less(&before)? >= 0 => Some(before),
            _ => Some(far),
        };
    }
    let (Some(enters), Some(leaves)) = (enters, leaves) else { return Some(None) };
    if enters.sign_of_less(&leaves)? > 0 {
        return Some(None);
    }
    for found in [enters, leaves] {
        if found.over.sign()? > 0 {
            return Some(Some((found.over.over(&found.under), found.axis)));
        }
    }
    Some(None)
}

/// The nearest t > 0 at which the ray hits a face of the cuboid, from outside or inside, and the axis of that face, the
/// first where several are hit at once; nothing when it hits none.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn cuboid_hit(origin: Vec3, direction: Vec3, slabs: &Slabs) -> Option<(Dyadic, usize)> {
    hit(origin, direction, slabs).flatten()
}

/// The same, t rounded to f64 once.
#[must_use]
pub fn cuboid_t(origin: Vec3, direction: Vec3, slabs: &Slabs) -> Option<(f64, usize)> {
    enclosed_cuboid_t(origin, direction, slabs)
        .unwrap_or_else(|| cuboid_hit(origin, direction, slabs).map(|(t, axis)| (t.to_f64(), axis)))
}

/// The same by enclosures; nothing where these cannot tell.
pub fn enclosed_cuboid_t(origin: Vec3, direction: Vec3, slabs: &Slabs) -> Option<Option<(f64, usize)>> {
    match hit::<Enclosure>(origin, direction, slabs)? {
        None => Some(None),
        Some((t, axis)) => t.rounded().map(|t| Some((t, axis))),
    }
}

/// The largest of the signs of |nᵢ · (point − C)| − hᵢ.
fn side<N: Number>(point: DVec3, slabs: &Slabs) -> Option<i32> {
    let from_centre: Vector<N> = Vector::of(point).minus(&Vector::of(slabs.centre));
    let mut largest = -1;
    for (&normal, &half) in slabs.normal.iter().zip(&slabs.half) {
        let along = Vector::of(normal).dot(&from_centre);
        let beyond = along.by(&along).less(&N::of(half).by(&N::of(half)));
        largest = largest.max(beyond.sign()?);
    }
    Some(largest)
}

/// 1 where the point lies outside the cuboid, −1 inside, 0 on a face, exactly.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn side_of_cuboid(point: DVec3, slabs: &Slabs) -> i32 {
    side::<Enclosure>(point, slabs).or_else(|| side::<Dyadic>(point, slabs)).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use pinhole::shapes::cuboid_t as pinhole_t;

    /// Half edges 1, 2, 4.
    fn brick() -> Slabs {
        Slabs::new(DVec3::ZERO, DVec3::AXES, [DVec3::X, DVec3::Y * 2.0, DVec3::Z * 4.0])
    }

    #[test]
    fn faces_edges_and_corners_are_hits_and_the_next_number_a_miss() {
        let hit = |origin, direction| cuboid_hit(origin, direction, &brick()).map(|(t, axis)| (t.to_f64(), axis));
        assert_eq!(hit(Vec3::new(3.0, 2.0, 4.0), Vec3::NEG_X), Some((2.0, 0)));
        assert_eq!(hit(Vec3::new(3.0, 2.0 + f32::EPSILON * 2.0, 4.0), Vec3::NEG_X), None);
        assert_eq!(hit(Vec3::new(0.0, 0.0, 9.0), Vec3::NEG_Z), Some((5.0, 2)));
        assert_eq!(hit(Vec3::ZERO, Vec3::NEG_Y), Some((2.0, 1)));
        assert_eq!(hit(Vec3::new(2.0, 3.0, 0.0), Vec3::new(-1.0, -1.0, 0.0)), Some((1.0, 0)));
        assert_eq!(hit(Vec3::new(1.0, 0.0, 0.0), Vec3::X), None);
        assert_eq!(hit(Vec3::new(1.0, 0.0, 0.0), Vec3::NEG_X), Some((2.0, 0)));
        assert_eq!(hit(Vec3::ZERO, Vec3::ZERO), None);
        assert_eq!(side_of_cuboid(DVec3::new(1.0, 2.0, 4.0), &brick()), 0);
        assert_eq!(side_of_cuboid(DVec3::new(1.0, 2.0, 4.0 + 1e-15), &brick()), 1);
        assert_eq!(side_of_cuboid(DVec3::new(0.9, -1.9, 3.9), &brick()), -1);
    }

    #[test]
    fn signs_of_zeros_and_rays_of_no_meaning_change_nothing() {
        let mut tried = 0;
        for x in [-1.0_f32, -0.0, 0.0, 1.0] {
            for y in [-1.0_f32, -0.0, 0.0, 1.0] {
                for z in [-1.0_f32, -0.0, 0.0, 1.0] {
                    for origin in
                        [[0.0_f32, 0.0, 0.0], [1.0, 0.0, 0.0], [-1.0, 2.0, 0.5], [3.0, 2.0, 4.0], [-3.0, -2.0, -4.0]]
                    {
                        let (origin, direction) = (Vec3::from(origin), Vec3::new(x, y, z));
                        let exact = cuboid_t(origin, direction, &brick()).map_or(f64::INFINITY, |(t, _)| t);
                        assert_eq!(
                            pinhole_t(origin.as_dvec3(), direction.as_dvec3(), &brick()),
                            exact,
                            "{origin} {direction}"
                        );
                        tried += 1;
                    }
                }
            }
        }
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for axis in DVec3::AXES {
                assert_eq!(pinhole_t(axis * bad, DVec3::X, &brick()), f64::INFINITY);
                assert_eq!(pinhole_t(DVec3::ONE, DVec3::ONE + axis * bad, &brick()), f64::INFINITY);
            }
        }
        eprintln!("cuboids: {tried} rays along axes, in faces and nowhere");
    }
}
