//! Boxes around shapes, and how far a ray starts from a surface.

use glam::{DVec3, Vec3};

/// An axis-aligned box that contains a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The corner of minimum x, y and z.
    pub min: DVec3,
    /// The corner of maximum x, y and z.
    pub max: DVec3,
}

impl Bounds {
    /// All of space.
    pub const ALL: Self = Self { min: DVec3::NEG_INFINITY, max: DVec3::INFINITY };

    /// A box with this half size about a centre, enlarged by more than rounding can have lost: by 2⁻²⁴ of the largest
    /// extent, which holds for shapes up to ten million times as long as they are thick, and by 2⁻⁵⁰ of the position.
    pub fn about(centre: DVec3, half_size: DVec3) -> Self {
        const OF_SIZE: f64 = 1.0 / (1_u64 << 24) as f64;
        const OF_POSITION: f64 = 1.0 / (1_u64 << 50) as f64;
        let half_size =
            half_size + DVec3::splat(half_size.max_element() * OF_SIZE) + (centre.abs() + half_size) * OF_POSITION;
        Self { min: centre - half_size, max: centre + half_size }
    }

    /// Whether two boxes have a point in common.
    pub fn overlaps(&self, other: &Self) -> bool {
        !(other.max.cmplt(self.min) | self.max.cmplt(other.min)).any()
    }

    /// Whether a point is in it or on its surface.
    #[inline(always)]
    pub fn contains(&self, point: DVec3) -> bool {
        !(point.cmplt(self.min) | self.max.cmplt(point)).any()
    }

    /// The smallest box around both.
    pub fn joined(&self, other: &Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The centre and radius of the sphere through its corners.
    pub fn sphere_around(&self) -> (DVec3, f64) {
        (0.5 * (self.min + self.max), 0.5 * (self.max - self.min).length())
    }
}

// How far a spawned ray must start from a surface.

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
