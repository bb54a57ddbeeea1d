//! The exact oracle of a ray against a triangle.
//!
//! Reads: the f32 ray and the three f64 corners that a kernel sees, in render space. Writes: hit or miss without any
//! rounding, t and the barycentric coordinates with a relative error below 2^-300.
//! It asks where the ray intersects the plane and on which side of each edge that point lies; pinhole's kernels ask for volumes
//! between the ray and the edges, so that a mistake in one is none in the other.

use super::enclosure::Enclosure;
use super::exact::Dyadic;
use super::exact_vector::Vector;
use super::number::Number;
use glam::{DVec3, Vec3};
use std::cmp::Ordering;

/// A − B.
fn from<N: Number>(a: DVec3, b: DVec3) -> Vector<N> {
    Vector::of(a).minus(&Vector::of(b))
}

/// (B − A) × (C − A).
fn normal<N: Number>([a, b, c]: [DVec3; 3]) -> Vector<N> {
    from(b, a).cross(&from(c, a))
}

/// Where the line of a ray intersects the plane of a triangle.
struct Crossing<N> {
    /// R · N and N · (A − O), whose quotient is t.
    approach: N,
    distance: N,
    /// For each edge, N · (edge × (P − its start)) times R · N: all of the sign of R · N where P lies within.
    sides: [N; 3],
}

fn crossing<N: Number>(origin: Vec3, direction: Vec3, corners: [DVec3; 3]) -> Crossing<N> {
    let normal = normal::<N>(corners);
    let (origin, direction) = (Vector::<N>::of(origin), Vector::<N>::of(direction));
    let to = |corner: DVec3| Vector::<N>::of(corner).minus(&origin);
    let (approach, distance) = (direction.dot(&normal), normal.dot(&to(corners[0])));
    let along = direction.times(&distance);
    let side = |(start, end): (usize, usize)| {
        let edge = from::<N>(corners[end], corners[start]);
        let point = along.minus(&to(corners[start]).times(&approach));
        normal.dot(&edge.cross(&point))
    };
    Crossing { sides: [(1, 2), (2, 0), (0, 1)].map(side), approach, distance }
}

/// The t > 0 at which the ray hits the triangle, if it does; nothing where these numbers cannot tell.
fn hit<N: Number>(origin: Vec3, direction: Vec3, corners: [DVec3; 3]) -> Option<Option<N>> {
    let Crossing { approach, distance, sides } = crossing::<N>(origin, direction, corners);
    let sign = approach.sign()?;
    if sign * distance.sign()? <= 0 {
        return Some(None);
    }
    for side in &sides {
        if side.sign()? * sign < 0 {
            return Some(None);
        }
    }
    Some(Some(distance.over(&approach)))
}

/// The t > 0 at which the ray hits the triangle, edges and corners included, or nothing: also for a ray in its plane, or
/// one that starts on it.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn triangle_hit(origin: Vec3, direction: Vec3, corners: [DVec3; 3]) -> Option<Dyadic> {
    hit(origin, direction, corners).flatten()
}

/// The same t, rounded to f64 once.
#[must_use]
pub fn triangle_t(origin: Vec3, direction: Vec3, corners: [DVec3; 3]) -> Option<f64> {
    enclosed_triangle_t(origin, direction, corners)
        .unwrap_or_else(|| triangle_hit(origin, direction, corners).map(|t| t.to_f64()))
}

/// The same by enclosures; nothing where these cannot tell.
pub fn enclosed_triangle_t(origin: Vec3, direction: Vec3, corners: [DVec3; 3]) -> Option<Option<f64>> {
    match hit::<Enclosure>(origin, direction, corners)? {
        None => Some(None),
        Some(t) => t.rounded().map(Some),
    }
}

/// How far the point stands out of the triangle's plane, times the length of (B − A) × (C − A).
fn height<N: Number>(point: DVec3, corners: [DVec3; 3]) -> N {
    normal::<N>(corners).dot(&from(point, corners[0]))
}

/// How the point lies to the triangle's plane, exactly: `Greater` is on the side to which (B − A) × (C − A) points.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn side_of_triangle(point: DVec3, corners: [DVec3; 3]) -> Ordering {
    let enclosed = height::<Enclosure>(point, corners).sign();
    enclosed.unwrap_or_else(|| height::<Dyadic>(point, corners).sign()).cmp(&0)
}

/// (B − A) × (C − A), each part rounded to f64 once.
#[must_use]
pub fn exact_normal(corners: [DVec3; 3]) -> DVec3 {
    let Vector { x, y, z } = normal::<Dyadic>(corners);
    DVec3::new(x.to_f64(), y.to_f64(), z.to_f64())
}

/// The barycentric coordinates of the point where the line of the ray intersects the plane, each rounded to f64 once; nothing where it
/// goes along the plane.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn exact_weights(origin: Vec3, direction: Vec3, corners: [DVec3; 3]) -> Option<[f64; 3]> {
    let Crossing { approach, sides, .. } = crossing::<Dyadic>(origin, direction, corners);
    let normal = normal::<Dyadic>(corners);
    // The sides are areas times N · N, times R · N.
    let whole = &normal.dot(&normal) * &approach;
    (approach.sign() != 0).then(|| sides.map(|side| side.divided_by(&whole).to_f64()))
}

#[cfg(test)]
mod tests {
    use super::*;

    const HALF: [DVec3; 3] = [DVec3::new(-1.0, -1.0, -3.0), DVec3::new(1.0, -1.0, -3.0), DVec3::new(-1.0, 1.0, -3.0)];

    fn hit(origin: Vec3, direction: Vec3) -> Option<f64> {
        triangle_hit(origin, direction, HALF).map(|t| t.to_f64())
    }

    #[test]
    fn both_sides_edges_and_corners_are_hit() {
        let at = Vec3::new(-0.5, -0.25, 0.0);
        assert_eq!(hit(at, Vec3::NEG_Z), Some(3.0));
        assert_eq!(hit(at - Vec3::Z * 4.0, Vec3::Z), Some(1.0));
        assert_eq!(hit(at, Vec3::Z), None);
        assert_eq!(hit(at, Vec3::X), None);
        assert_eq!(hit(at - Vec3::Z * 3.0, Vec3::NEG_Z), None);
        for (x, y) in [(0.0, 0.0), (-1.0, 0.5), (-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0)] {
            assert_eq!(hit(Vec3::new(x, y, 0.0), Vec3::NEG_Z), Some(3.0));
        }
        for (x, y) in [(f32::MIN_POSITIVE, 0.0), (-1.0 - f32::EPSILON, 0.0), (0.5, -1.0 - f32::EPSILON)] {
            assert_eq!(hit(Vec3::new(x, y, 0.0), Vec3::NEG_Z), None, "({x}, {y})");
        }
    }

    #[test]
    fn weights_are_those_of_the_corners() {
        let weights = exact_weights(Vec3::new(-0.5, -0.25, 0.0), Vec3::NEG_Z, HALF);
        assert_eq!(weights, Some([0.375, 0.25, 0.375]));
        assert_eq!(exact_weights(Vec3::ZERO, Vec3::X, HALF), None);
        assert_eq!(exact_normal(HALF), DVec3::Z * 4.0);
    }

    #[test]
    fn sides_are_exact() {
        let at = |z: f64| side_of_triangle(DVec3::new(1e8, -1e8, z), HALF);
        assert_eq!((at(-3.0), at(-3.0 + 4e-16)), (Ordering::Equal, Ordering::Greater));
        assert_eq!(at(-3.0 - 4e-16), Ordering::Less);
    }
}
