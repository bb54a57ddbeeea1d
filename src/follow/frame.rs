use glam::{DMat3, DVec3};

// ANCHOR: frame_of
/// Two directions across a unit normal, and the normal: the columns of a rotation.
///
/// Without a root and without a branch on which way the normal points (Duff et al. 2017).
#[inline(always)]
pub fn frame_of(normal: DVec3) -> DMat3 {
    let sign = 1.0_f64.copysign(normal.z);
    let a = -1.0 / (sign + normal.z);
    let b = normal.x * normal.y * a;
    DMat3::from_cols(
        DVec3::new(1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x),
        DVec3::new(b, sign + normal.y * normal.y * a, -normal.y),
        normal,
    )
}
// ANCHOR_END: frame_of

// ANCHOR: cosine_direction
/// A direction about +z, as densely as its cosine: two numbers from 0 to below 1 make a point of the unit disk, and the
/// hemisphere's point above it is the direction (Malley).
///
/// Its density is z / π.
#[inline(always)]
pub fn cosine_direction([u, v]: [f64; 2]) -> DVec3 {
    let (radius, angle) = (u.sqrt(), std::f64::consts::TAU * v);
    DVec3::new(radius * libm::cos(angle), radius * libm::sin(angle), (1.0 - u).sqrt())
}
// ANCHOR_END: cosine_direction

/// Whether two directions leave a surface on the same side of it.
#[inline(always)]
pub fn same_side(normal: DVec3, a: DVec3, b: DVec3) -> bool {
    normal.dot(a) * normal.dot(b) > 0.0
}
