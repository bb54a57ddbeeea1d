use super::kind::ShapeKind;
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

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
pub(super) fn planar_slope([one, other]: [DVec3; 2], uvs: [DVec2; 3]) -> UvSlope {
    let across = one.cross(other);
    let area_squared = across.length_squared();
    // Along the first edge, the first coordinate changes by 1 and the second by 0; along the second edge, vice versa.
    let (first, second) = (other.cross(across) / area_squared, across.cross(one) / area_squared);
    let (along_one, along_other) = (uvs[1] - uvs[0], uvs[2] - uvs[0]);
    UvSlope::Planar([0, 1].map(|part| first * along_one[part] + second * along_other[part]))
}
