//! Texture coordinates of shapes, and their gradients: u to the right and v down, as seen from outside with +y up.

use super::kind::ShapeKind;
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_1_PI, PI, TAU};

use crate::each::Each;

/// The uv of a point of a sphere, given in object space at any distance from the centre.
///
/// u is the longitude over 2π: 0 at −z, ¼ at −x, ½ at +z, ¾ at +x; v is the polar angle from +y over π.
/// At the poles the longitude is undefined, and u is 0.
#[inline(always)]
pub fn sphere_uv(own: DVec3) -> [f64; 2] {
    // 0 − x is never −0, so that the seam does not depend on the sign of a zero.
    let longitude = libm::atan2(0.0 - own.x, 0.0 - own.z) / TAU;
    let across = libm::sqrt(own.x * own.x + own.z * own.z);
    let from_top = libm::atan2(across, own.y) * FRAC_1_PI;
    [if longitude < 0.0 { longitude + 1.0 } else { longitude }, if from_top < 1.0 { from_top } else { 1.0 }]
}

/// The uv of a point of a disk or a rectangle from its two coordinates: 0 to 1 from edge to edge along each.
///
/// A disk uses the uv of its bounding square: polar coordinates would have a seam and a singularity, and the squares of
/// a checkerboard would not remain square.
#[inline(always)]
pub fn planar_uv(at: [f64; 2]) -> [f64; 2] {
    at.each(|coordinate| within_unit(0.5 + 0.5 * coordinate))
}

/// The two unit vectors, in a plane's object space, along which its u and v increase.
///
/// They are those of the cuboid face with the same normal or nearly so, projected onto the plane.
pub fn plane_axes(normal: DVec3) -> [DVec3; 2] {
    let unit = (normal / normal.abs().max_element()).normalize();
    let size = unit.abs();
    let axis = if size.y >= size.x && size.y >= size.z {
        1
    } else if size.z >= size.x {
        2
    } else {
        0
    };
    let [right, _] = face_axes(axis, unit[axis] < 0.0);
    let u = (right - right.dot(unit) * unit).normalize();
    [u, u.cross(unit)]
}

/// The directions of u and v on the face of a cuboid across an axis, at its negative or positive end: u to the right
/// and v down as seen from outside with +y up; on top u along +x and v along +z, on the bottom v along −z.
#[inline(always)]
pub fn face_axes(axis: usize, negative: bool) -> [DVec3; 2] {
    let outward = DVec3::AXES[axis] * if negative { -1.0 } else { 1.0 };
    let u = if axis == 1 { DVec3::X } else { DVec3::Y.cross(outward) };
    [u, u.cross(outward)]
}

/// Clamps to [0, 1]; NaN becomes 0.
#[inline(always)]
pub(super) fn within_unit(coordinate: f64) -> f64 {
    if coordinate > 1.0 {
        1.0
    } else if coordinate > 0.0 {
        coordinate
    } else {
        0.0
    }
}

/// The gradients of u and v along a shape's surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum UvSlope {
    /// There are none.
    #[default]
    Nowhere,
    /// Constant gradients, per scene unit in world space.
    Planar([DVec3; 2]),
    /// Those of longitude and latitude about the origin of the shape's object space.
    Round,
    /// Those of cuboid faces, by axis, per scene unit in world space.
    Faces([DVec3; 3]),
    /// Those of the primitive that was hit, of which each has its own.
    OfPrimitive,
    /// Those of a kind that computes them in its object space, with two numbers of the shape.
    Own(ShapeKind, [f64; 2]),
}

/// The axis of a vector's largest component; y where none is.
#[inline(always)]
pub fn most_of(v: DVec3) -> usize {
    let size = v.abs();
    if size.y >= size.x && size.y >= size.z {
        1
    } else if size.z >= size.x {
        2
    } else {
        0
    }
}

/// The change of longitude over 2π and of the polar angle over π along an offset from a point.
///
/// These are the derivatives of the two arc tangents.
#[inline(always)]
pub(super) fn round_step(own: DVec3, step: DVec3) -> DVec3 {
    let across_squared = own.x * own.x + own.z * own.z;
    let across = across_squared.sqrt();
    let outward = (own.x * step.x + own.z * step.z) / across;
    let longitude = (own.z * step.x - own.x * step.z) / across_squared;
    let from_top = (own.y * outward - across * step.y) / (across_squared + own.y * own.y);
    DVec3::new(longitude / TAU, from_top / PI, 0.0)
}

/// The gradients of a triangle with these two edges from its first corner, from u and v of its corners.
#[inline(always)]
pub(super) fn planar_slope([one, other]: [DVec3; 2], uvs: [DVec2; 3]) -> UvSlope {
    let across = one.cross(other);
    let area_squared = across.length_squared();
    // Along the first edge, the first coordinate changes by 1 and the second by 0; along the second edge, vice versa.
    let (first, second) = (other.cross(across) / area_squared, across.cross(one) / area_squared);
    let (along_one, along_other) = (uvs[1] - uvs[0], uvs[2] - uvs[0]);
    UvSlope::Planar([0, 1].each(|part| first * along_one[part] + second * along_other[part]))
}

#[cfg(test)]
mod uv_tests {
    use super::*;
    use std::f64::consts::PI;

    fn close(found: [f64; 2], expected: [f64; 2]) -> bool {
        (found[0] - expected[0]).abs() < 1e-14 && (found[1] - expected[1]).abs() < 1e-14
    }

    #[test]
    fn a_plane_has_the_axes_of_the_face_that_is_nearest() {
        let mut faces = [0; 3];
        for index in 0..3000 {
            let normal = crate::measure::draws::Draws::new(2802, index).unit_vector();
            let axis = normal.abs().max_position();
            let face = face_axes(axis, normal[axis] < 0.0)[0];
            let [u, v] = plane_axes(3.0 * normal);
            let along = (face - face.dot(normal) * normal).normalize();
            assert!((u - along).length() < 1e-12, "{normal}: {u} for {along}");
            assert!((v - u.cross(normal)).length() < 1e-12, "{normal}: {v}");
            faces[axis] += 1;
        }
        eprintln!("axes of planes: {faces:?} normals nearest to x, y and z");
        assert!(faces.iter().all(|&count| count > 500));
    }

    #[test]
    fn a_sphere_has_its_middle_at_plus_z_and_its_seam_at_minus_z() {
        for (own, uv) in [
            (DVec3::NEG_Z, [0.0, 0.5]),
            (DVec3::NEG_X, [0.25, 0.5]),
            (DVec3::Z, [0.5, 0.5]),
            (DVec3::X, [0.75, 0.5]),
            (DVec3::Y, [0.0, 0.0]),
            (DVec3::NEG_Y, [0.0, 1.0]),
            (DVec3::new(-0.0, 1.0, -0.0), [0.0, 0.0]),
            (DVec3::new(-0.0, 0.0, 3.0), [0.5, 0.5]),
            (DVec3::new(0.0, 2.0, 2.0), [0.5, 0.25]),
        ] {
            assert!(close(sphere_uv(own), uv), "{own}: {:?}", sphere_uv(own));
        }
    }

    #[test]
    fn longitude_and_latitude_survive_a_round_trip_up_to_poles_and_seam() {
        let mut tried = 0;
        for step in 0..200 {
            for row in 0..=100 {
                let (u, v) = (f64::from(step) / 200.0, f64::from(row) / 100.0);
                let (longitude, from_top) = (u * TAU, v * PI);
                let across = libm::sin(from_top);
                let own =
                    DVec3::new(-libm::sin(longitude) * across, libm::cos(from_top), -libm::cos(longitude) * across)
                        * 1e-8;
                let [found_u, found_v] = sphere_uv(own);
                let off = (found_u - u).abs();
                assert!((found_v - v).abs() < 1e-14, "{u} {v}: {found_v}");
                assert!(row == 0 || row == 100 || off.min(1.0 - off) < 1e-13, "{u} {v}: {found_u}");
                assert!((0.0..=1.0).contains(&found_u) && (0.0..=1.0).contains(&found_v));
                tried += 1;
            }
        }
        for tiny in [f64::MIN_POSITIVE, 1e-300, 1e-17] {
            for own in [DVec3::new(tiny, 1.0, -1.0), DVec3::new(-tiny, -1.0, tiny), DVec3::new(tiny, 0.0, -tiny)] {
                assert!(sphere_uv(own).iter().all(|coordinate| (0.0..=1.0).contains(coordinate)), "{own}");
            }
        }
        eprintln!("sphere uv: {tried} points survive the round trip");
    }

    #[test]
    fn a_plane_is_parametrised_in_its_own_units() {
        assert_eq!(plane_axes(DVec3::Y * 3.0), [DVec3::X, DVec3::Z]);
        assert_eq!(plane_axes(DVec3::Z), [DVec3::X, DVec3::NEG_Y]);
        assert_eq!(plane_axes(DVec3::X * 1e-20), [DVec3::NEG_Z, DVec3::NEG_Y]);
        for normal in [DVec3::new(0.3, 1.0, -0.2), DVec3::new(1.0, 1.0, 1.0), DVec3::new(-1.0, 0.2, 0.9)] {
            let [u, v] = plane_axes(normal);
            let unit = normal.normalize();
            assert!((u.length() - 1.0).abs() < 1e-15 && (v.length() - 1.0).abs() < 1e-15);
            assert!(u.dot(v).abs() < 1e-15 && u.dot(unit).abs() < 1e-15);
            // u is to the right and v down, so the third axis points at the viewer.
            assert!((v.cross(u) - unit).length() < 1e-15);
        }
    }

    #[test]
    fn planar_shapes_run_from_0_to_1() {
        assert_eq!(planar_uv([1.0 + 1e-15, -1.0 - 1e-15]), [1.0, 0.0]);
        assert_eq!(planar_uv([f64::NAN, -0.5]), [0.0, 0.25]);
    }
}
