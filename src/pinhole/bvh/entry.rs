//! What the builder sorts: boxes that one vector minimum unites, each with the number of its primitive.

use super::bounding_box::BoundingBox;

use crate::each::{Each, lanes};

/// A bounding box as eight numbers: the lower corner, one to spare, the negated upper corner, and one to spare.
///
/// Since the upper corner is negated, the union of two boxes is one minimum of eight lanes.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub struct PackedBox(pub [f32; 8]);

impl PackedBox {
    /// The box that contains nothing.
    pub const EMPTY: Self = Self([f32::INFINITY; 8]);

    /// Enlarges it such that it contains another.
    #[inline(always)]
    pub fn enclose(&mut self, Self(other): &Self) {
        let own = self.0;
        self.0 = lanes(|i| if other[i] < own[i] { other[i] } else { own[i] });
    }

    /// Twice its centre, as a box that holds only this point.
    #[inline(always)]
    fn doubled_centre(&self) -> Self {
        Self(lanes(|i| self.0[i] - self.0[i ^ 4]))
    }

    /// Its extent along an axis.
    #[inline(always)]
    pub fn extent(&self, axis: usize) -> f32 {
        -(self.0[4 + axis] + self.0[axis])
    }

    /// Half its surface area, to which the probability that a ray hits it is proportional; it must not be empty.
    #[inline(always)]
    pub fn half_area(&self) -> f32 {
        let [x, y, z] = [0, 1, 2].each(|axis| self.extent(axis));
        x * (y + z) + y * z
    }

    /// The same box as a node holds it.
    pub fn unpacked(&self) -> BoundingBox {
        let [x, y, z, _, minus_x, minus_y, minus_z, _] = self.0;
        BoundingBox { low: [x, y, z], high: [-minus_x, -minus_y, -minus_z] }
    }
}

/// A primitive's box, and in the first number to spare the bits of the primitive's number.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub struct Entry(pub PackedBox);

impl Entry {
    /// The entry of a primitive.
    pub fn new(&BoundingBox { low, high }: &BoundingBox, number: u32) -> Self {
        Self(PackedBox([low[0], low[1], low[2], f32::from_bits(number), -high[0], -high[1], -high[2], 0.0]))
    }

    /// The primitive's number.
    pub fn number(&self) -> u32 {
        self.0.0[3].to_bits()
    }
}

/// What the division of a set of entries needs to know: their box and the box of their doubled centres.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    /// The box around the primitives.
    pub around: PackedBox,
    /// The box around twice their centres.
    pub centres: PackedBox,
}

impl Extent {
    const EMPTY: Self = Self { around: PackedBox::EMPTY, centres: PackedBox::EMPTY };

    /// The extent of these entries.
    #[inline(always)]
    pub fn of(entries: &[Entry]) -> Self {
        // Two chains of minima, since each minimum waits for the one before it.
        let (mut even, mut odd) = (Self::EMPTY, Self::EMPTY);
        let pairs = entries.chunks_exact(2);
        pairs.remainder().iter().for_each(|entry| even.add(entry));
        for pair in pairs {
            even.add(&pair[0]);
            odd.add(&pair[1]);
        }
        even.around.enclose(&odd.around);
        even.centres.enclose(&odd.centres);
        even
    }

    #[inline(always)]
    fn add(&mut self, entry: &Entry) {
        self.around.enclose(&entry.0);
        self.centres.enclose(&entry.0.doubled_centre());
    }
}
