//! How far a spawned ray must start from a surface.

use glam::{DVec3, Vec3};

/// The L₁ norm, |x| + |y| + |z|.
#[inline(always)]
pub fn l1_norm(v: DVec3) -> f64 {
    v.x.abs() + v.y.abs() + v.z.abs()
}

// ANCHOR: offset_bound
/// How far along its normal a hit point must be moved for a spawned ray to start certainly off the surface.
///
/// With u = 2⁻²⁴, rounding a point p to f32 moves it by at most u(|x| + |y| + |z|), and rounding the offset point by as
/// much again; twice that sum is the first term.
/// The second term bounds the error of p itself in f64, which depends on the size of the ray's origin and of the
/// shape's own numbers (a sphere's centre and radius, a plane's offset); the third covers the subnormals of f32.
/// The bound scales with the scene, because it contains no absolute length.
#[inline(always)]
pub fn offset_bound(point: DVec3, origin: DVec3, shape_size: f64) -> f32 {
    const ROUNDING: f64 = 4.0 / (1_u64 << 24) as f64;
    const COMPUTING: f64 = 1.0 / (1_u64 << 48) as f64;
    const FLOOR: f64 = f32::from_bits(8) as f64;
    (ROUNDING * l1_norm(point) + COMPUTING * (l1_norm(origin) + shape_size) + FLOOR) as f32
}

/// The origin of a ray spawned from a surface: the hit point, offset along the normal by the bound.
#[inline(always)]
pub fn offset_origin(position: Vec3, normal: Vec3, bound: f32) -> Vec3 {
    position + normal * bound
}
// ANCHOR_END: offset_bound
