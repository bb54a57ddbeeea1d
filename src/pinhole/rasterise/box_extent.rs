//! The rectangle of the image that a box covers, and how near it is, with room for the rounding of rays.

use super::bins::Extent;
use super::clip::crossing;
use super::spaces::{ClipPoint, Projection, clip_from_camera};
use crate::bvh::by_axis;
use crate::each::Each;
use crate::shapes::{Bounds, Shape};
use glam::{DVec2, DVec3};

/// The depth of the near plane, as a fraction of the distance of the box's farthest corner.
const NEAR: f64 = 1.0 / (1_u64 << 20) as f64;

/// The greatest n for which the bound of a ray's rounding holds, with room to spare.
const LONGEST: f64 = (1_u32 << 22) as f64;

/// What is certain of a shape because of a box around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BoxExtent {
    /// No sample's ray hits it in another pixel.
    pub pixels: Extent,
    /// No ray hits it at a smaller t.
    pub nearest: f64,
}

/// What boxes are projected by.
pub(super) struct BoxExtents<'s> {
    projection: &'s Projection,
    /// Samples are at most this far from the centres of their pixels, in pixels.
    margin: f64,
    /// Pixels to a unit of the image plane at distance 1, or of the window.
    per_unit: f64,
    /// The greatest n of the image's rays, or the greatest |o|.
    greatest: f64,
}

impl<'s> BoxExtents<'s> {
    /// Those of an image whose samples are so far from the centres of their pixels at most.
    pub fn new(projection: &'s Projection, margin: f64) -> Self {
        let Projection { half, size, is_perspective, .. } = *projection;
        let corner = half * (DVec2::ONE + 2.0 * margin / size);
        let greatest = if is_perspective { (1.0 + corner.length_squared()).sqrt() } else { corner.length() };
        Self { projection, margin, per_unit: (size / (2.0 * half)).max_element(), greatest }
    }

    /// That of a shape; none where no ray hits it.
    ///
    /// A box along the axes of the world, and one along the camera's about a sphere around the shape: each encloses it,
    /// and whichever is narrower limits the rectangle on that side.
    pub fn of_shape(&self, shape: &impl Shape) -> Option<BoxExtent> {
        let camera_from_world = self.projection.camera_from_world;
        let Some(bounds) = shape.bounds() else {
            return Some(BoxExtent { pixels: self.pixels(&Seen::ALL)?, nearest: 0.0 });
        };
        let mut extent = self.of_box(&bounds, |corner| camera_from_world * corner)?;
        if let Some((centre, radius)) = shape.bounding_sphere() {
            let around = Bounds::about(camera_from_world * centre, DVec3::splat(radius));
            let around = self.of_box(&around, |corner| corner)?;
            let nearest = extent.nearest.max(around.nearest);
            extent = BoxExtent { pixels: both(extent.pixels, around.pixels)?, nearest };
        }
        Some(extent)
    }

    /// That of anything in a box, whose corners are taken to camera space.
    fn of_box(&self, bounds: &Bounds, to_camera: impl Fn(DVec3) -> DVec3) -> Option<BoxExtent> {
        let Bounds { min, max } = *bounds;
        let Projection { half, is_perspective, .. } = *self.projection;
        let farthest = min.abs().max(max.abs()).length();
        let corner = |number: usize| {
            let point = DVec3::from(by_axis(|axis| if number >> axis & 1 == 0 { min[axis] } else { max[axis] }));
            clip_from_camera(to_camera(point), half, is_perspective)
        };
        let corners: [ClipPoint; 8] = [0, 1, 2, 3, 4, 5, 6, 7].each(corner);
        let mut seen = Seen { min: DVec2::INFINITY, max: DVec2::NEG_INFINITY };
        let finite = corners.iter().all(|corner| (corner.x + corner.y + corner.depth).is_finite());
        let (near, closest) = (NEAR * farthest, DVec3::ZERO.max(min).min(max).length());
        // What a ray of the image hits before the near plane is closer to the eye than half of that.
        let is_close = closest <= 2.0 * self.greatest * near;
        if !finite || (is_perspective && (is_close || near < f64::MIN_POSITIVE || self.greatest > LONGEST)) {
            return Some(BoxExtent { pixels: self.pixels(&Seen::ALL)?, nearest: 0.0 });
        }
        let rounding = self.rounding(farthest);
        let nearest = if is_perspective {
            seen.add_in_front(self.projection, &corners, near);
            closest * (1.0 - NEAR)
        } else {
            let depth = corners.iter().fold(f64::INFINITY, |min, corner| min.min(corner.depth));
            if corners.iter().any(|corner| corner.depth >= -rounding) {
                corners.iter().for_each(|&corner| seen.add(self.projection.raster(corner)));
            }
            depth - 2.0 * rounding
        };
        let room = DVec2::splat(rounding * self.per_unit + self.margin);
        let pixels = self.pixels(&Seen { min: seen.min - room, max: seen.max + room })?;
        Some(BoxExtent { pixels, nearest })
    }

    // ANCHOR: rounding
    /// How far on the image, in units of the plane at distance 1 or of the window, the rounding of a ray to f32 may take
    /// it from its sample, where no corner of the box is farther from the eye than this.
    ///
    /// Let u = 2⁻²⁴ and P be the point of the box at which the ray hits a shape.
    ///
    /// *Perspective.* The origin is 0, without error; the direction d, of unit length, is off by a δ with |δ| ≤ u.
    /// In camera space d = (X, Y, −1) / n, where (X, Y) is the sample on the plane and n² = 1 + X² + Y².
    /// P is projected to X′ = (X / n + δx) / (1 / n − δz), so that |X′ − X| ≤ un √(1 + X²) / (1 − un) < 2un², where
    /// un < ½.
    ///
    /// *Orthographic.* The origin o is off by u |o| and the direction by u; after a length t ≤ |P| + |o| the ray is off by
    /// less than u (|P| + 2 |o|), which is doubled.
    ///
    /// That leaves u for what is computed in f64: 2⁻⁵⁰ of the same lengths, or 2⁻³⁰ for a corner at the near plane.
    ///
    /// The smallest t is off by 2u of itself for the length of the direction and by 2u for the kernel, which is less than
    /// 2⁻²⁰; of an orthographic camera by u |o| besides, which together is less than twice this distance.
    fn rounding(&self, farthest: f64) -> f64 {
        const TWO_U: f64 = 1.0 / (1_u64 << 23) as f64;
        match self.projection.is_perspective {
            true => TWO_U * self.greatest * self.greatest,
            false => TWO_U * (farthest + 2.0 * self.greatest),
        }
    }
    // ANCHOR_END: rounding

    /// The pixels of the image whose centres are in a rectangle.
    fn pixels(&self, &Seen { min, max }: &Seen) -> Option<Extent> {
        let along = |axis: usize| {
            let first = (min[axis] - 0.5).ceil().max(0.0);
            let last = (max[axis] - 0.5).floor().min(self.projection.size[axis] - 1.0);
            (first <= last).then_some([first as u32, last as u32])
        };
        Some([along(0)?, along(1)?])
    }
}

/// The pixels that two rectangles have in common.
fn both(one: Extent, other: Extent) -> Option<Extent> {
    let along = |axis: usize| {
        let [first, last] = [one[axis][0].max(other[axis][0]), one[axis][1].min(other[axis][1])];
        (first <= last).then_some([first, last])
    };
    Some([along(0)?, along(1)?])
}

/// A rectangle of raster space.
struct Seen {
    min: DVec2,
    max: DVec2,
}

impl Seen {
    const ALL: Self = Self { min: DVec2::NEG_INFINITY, max: DVec2::INFINITY };

    #[inline(always)]
    fn add(&mut self, point: DVec2) {
        (self.min, self.max) = (self.min.min(point), self.max.max(point));
    }

    /// Adds what is left of a box by the near plane: the corners in front of it, and where it crosses edges.
    #[inline(always)]
    fn add_in_front(&mut self, projection: &Projection, corners: &[ClipPoint; 8], near: f64) {
        let in_front = corners.each(|corner| corner.depth >= near);
        for (corner, in_front) in corners.iter().zip(in_front) {
            if in_front {
                self.add(projection.raster(*corner));
            }
        }
        if in_front.contains(&true) && in_front.contains(&false) {
            for (from, to) in (0..8).flat_map(|from| [1, 2, 4].each(|bit| (from, from | bit))) {
                let (inside, outside) = if in_front[from] { (from, to) } else { (to, from) };
                if in_front[inside] && !in_front[outside] {
                    let depth = |number: usize| corners[number].depth - near;
                    self.add(projection.raster(crossing(
                        corners[inside],
                        depth(inside),
                        corners[outside],
                        depth(outside),
                    )));
                }
            }
        }
    }
}
