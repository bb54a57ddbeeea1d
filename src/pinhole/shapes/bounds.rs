//! The axis-aligned bounding box of each finite shape.

use glam::DVec3;

/// An axis-aligned box that contains a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The corner of minimum x, y and z.
    pub least: DVec3,
    /// The corner of maximum x, y and z.
    pub most: DVec3,
}

impl Bounds {
    /// All of space.
    pub const ALL: Self = Self { least: DVec3::NEG_INFINITY, most: DVec3::INFINITY };

    /// A box with this half size about a centre, enlarged by more than rounding can have lost: by 2⁻²⁴ of the largest
    /// extent, which holds for shapes up to ten million times as long as they are thick, and by 2⁻⁵⁰ of the position.
    pub fn about(centre: DVec3, half_size: DVec3) -> Self {
        const OF_SIZE: f64 = 1.0 / (1_u64 << 24) as f64;
        const OF_POSITION: f64 = 1.0 / (1_u64 << 50) as f64;
        let half_size =
            half_size + DVec3::splat(half_size.max_element() * OF_SIZE) + (centre.abs() + half_size) * OF_POSITION;
        Self { least: centre - half_size, most: centre + half_size }
    }

    /// Whether two boxes have a point in common.
    pub fn overlaps(&self, other: &Self) -> bool {
        !(other.most.cmplt(self.least) | self.most.cmplt(other.least)).any()
    }

    /// Whether a point is in it or on its surface.
    #[inline(always)]
    pub fn contains(&self, point: DVec3) -> bool {
        !(point.cmplt(self.least) | self.most.cmplt(point)).any()
    }

    /// The smallest box around both.
    pub fn joined(&self, other: &Self) -> Self {
        Self { least: self.least.min(other.least), most: self.most.max(other.most) }
    }

    /// The centre and radius of the sphere through its corners.
    pub fn sphere_around(&self) -> (DVec3, f64) {
        (0.5 * (self.least + self.most), 0.5 * (self.most - self.least).length())
    }
}
