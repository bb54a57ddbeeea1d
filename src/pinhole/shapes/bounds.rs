//! The axis-aligned bounding box of each finite shape.

use glam::DVec3;

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
