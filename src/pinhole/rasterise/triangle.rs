//! A triangle in raster space: vertices in fixed point, edge functions, and depth as a plane.

use super::spaces::{ClipPoint, Projection};
use glam::DVec2;

use crate::each::Each;

/// The steps of a pixel to which vertices and samples are rounded.
pub const SUBPIXELS: f64 = 256.0;

/// A triangle that covers some of the image, as tiles rasterise it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RasterTriangle {
    /// The vertices in raster space, in 1/256 of a pixel, such that the area is positive.
    pub corners: [[i32; 2]; 3],
    /// The shape's number.
    pub shape: u32,
    /// The number of the triangle within its shape, where that consists of several.
    pub primitive: u32,
    /// The row of the shape in its table.
    pub row: u32,
    /// The triangle's plane, which says how near each raster point is.
    pub plane: NearnessPlane,
}

/// How near a triangle is at each raster point: a linear function of the point.
///
/// For a perspective camera that is the depth's reciprocal, since depth itself is not linear across the image; for an
/// orthographic one it is the negative depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearnessPlane {
    /// Per pixel to the right, per pixel downward, and at the image's top left corner.
    pub coefficients: [f64; 3],
    /// The least and the greatest nearness of a vertex, beyond which rounding must not lead.
    pub range: [f64; 2],
}

impl NearnessPlane {
    /// The plane through three clip points; none if it holds the eye, so that it is seen from the side.
    pub fn through(projection: &Projection, corners: [ClipPoint; 3]) -> Option<Self> {
        let coefficients = Self::coefficients(projection, corners.each(|corner| projection.camera(corner).into()));
        let nearness = corners.each(|corner| projection.nearness(corner));
        let range = [
            nearness.into_iter().fold(f64::INFINITY, f64::min),
            nearness.into_iter().fold(f64::NEG_INFINITY, f64::max),
        ];
        coefficients.iter().all(|part| part.is_finite()).then_some(Self { coefficients, range })
    }

    /// The coefficients of the plane through three points in camera space, not all finite if it holds the eye.
    ///
    /// With a normal n and n · P = d, the point of a plane at a depth z on the ray (x, y, −1) is z (x, y, −1), so
    /// 1/z = n · (x, y, −1) / d.
    #[inline(always)]
    pub(super) fn coefficients(projection: &Projection, [a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
        let ([bx, by, bz], [cx, cy, cz]) = (difference(b, a), difference(c, a));
        let [x, y, z] = [by * cz - cy * bz, bz * cx - cz * bx, bx * cy - cx * by];
        let distance = x * a[0] + y * a[1] + z * a[2];
        let (right, up) = (x * projection.half.x, y * projection.half.y);
        let [right, up, at_centre, whole] = match projection.is_perspective {
            true => [right, up, -z, distance],
            false => [-right, -up, distance, z],
        };
        let (width, height) = (projection.size.x, projection.size.y);
        [2.0 * right / width / whole, -2.0 * up / height / whole, (at_centre - right + up) / whole]
    }

    /// The nearness at a raster point.
    #[inline(always)]
    pub fn at(&self, raster: DVec2) -> f64 {
        let [right, down, at_corner] = self.coefficients;
        within(right * raster.x + down * raster.y + at_corner, self.range)
    }
}

#[inline(always)]
fn difference([ax, ay, az]: [f64; 3], [bx, by, bz]: [f64; 3]) -> [f64; 3] {
    [ax - bx, ay - by, az - bz]
}

/// A number, or the end of a range that it is beyond.
#[inline(always)]
pub fn within(number: f64, [min, max]: [f64; 2]) -> f64 {
    let number = if number < min { min } else { number };
    if number > max { max } else { number }
}

/// A raster coordinate in 1/256 of a pixel.
#[inline(always)]
pub fn fixed(raster: DVec2) -> [i32; 2] {
    [raster.x, raster.y].each(|coordinate| {
        let steps = coordinate * SUBPIXELS + 0.5;
        // A cast rounds towards 0, and calls no function as `floor` would.
        let towards_0 = steps as i32;
        towards_0 - i32::from(f64::from(towards_0) > steps)
    })
}

// ANCHOR: edge_function
/// The edge function of a point: twice the area of the triangle from, to, point; positive to the right of the edge.
#[inline(always)]
pub fn edge_function(from: [i32; 2], to: [i32; 2], point: [i32; 2]) -> i64 {
    let [fx, fy] = from.each(i64::from);
    let [tx, ty] = to.each(i64::from);
    let [px, py] = point.each(i64::from);
    (tx - fx) * (py - fy) - (ty - fy) * (px - fx)
}
// ANCHOR_END: edge_function

// ANCHOR: is_top_left
/// Whether a point exactly on an edge belongs to the triangle: on the left edges and on the top ones.
///
/// The interior is to the right of each edge, with y downward: an edge upward is a left one, and a level edge to the
/// right is a top one.
/// The neighbour passes a common edge in the other direction, where it is neither, so each point belongs to one of them.
#[inline(always)]
pub fn is_top_left(from: [i32; 2], to: [i32; 2]) -> bool {
    to[1] < from[1] || (to[1] == from[1] && to[0] > from[0])
}
// ANCHOR_END: is_top_left

/// An edge function as a·x + b·y + c about the corner of a tile, in 1/256 of a pixel; a sample is inside where it is at
/// least 0.
///
/// All of its values are whole numbers below 2⁵³, which f64 holds exactly, so the order of additions changes nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// Per 1/256 of a pixel to the right.
    pub a: f64,
    /// Per 1/256 of a pixel downward.
    pub b: f64,
    /// At the tile's corner; one less where samples on the edge do not belong to the triangle.
    pub c: f64,
}

impl Edge {
    /// The edge function of an edge, about this corner of a tile.
    #[inline(always)]
    pub fn new(from: [i32; 2], to: [i32; 2], corner: [i32; 2]) -> Self {
        let own = |point: [i32; 2]| [f64::from(point[0] - corner[0]), f64::from(point[1] - corner[1])];
        let ([fx, fy], [tx, ty]) = (own(from), own(to));
        let (a, b) = (fy - ty, tx - fx);
        Self { a, b, c: -(a * fx + b * fy) - f64::from(u8::from(!is_top_left(from, to))) }
    }

    /// Its value.
    #[inline(always)]
    pub fn at(&self, x: f64, y: f64) -> f64 {
        self.a * x + self.b * y + self.c
    }
}
