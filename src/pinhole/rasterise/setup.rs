//! Triangles are set up several at once: their pixels, whether they cover a sample, and the plane of their nearness.

use super::bins::Extent;
use super::spaces::{ClipPoint, Projection};
use super::triangle::{Edge, NearnessPlane, RasterTriangle, SUBPIXELS};
use multiversion::multiversion;

use crate::each::Each;

/// How many triangles are set up at once.
const AT_ONCE: usize = 32;
/// The most pixels of a triangle that is tested at all of their centres before it is kept.
const FEW: i32 = 4;

type Lanes = [f64; AT_ONCE];
type Whole = [i32; AT_ONCE];

/// The shape that a triangle belongs to, and its number there.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Whose {
    pub shape: u32,
    pub primitive: u32,
    pub row: u32,
}

/// What triangles are set up for: an image, and how far from a pixel's centre its samples may be, in 1/256 of a pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Image<'s> {
    pub projection: &'s Projection,
    pub margin: i32,
}

/// The triangles of a run before they are sorted into bins, and the pixels that each may cover.
#[derive(Debug, Default)]
pub(super) struct Unsorted {
    pub triangles: Vec<RasterTriangle>,
    pub extents: Vec<Extent>,
}

/// Triangles that wait to be set up together.
#[derive(Debug)]
pub(super) struct Waiting {
    /// In 1/256 of a pixel, corner by corner.
    raster: [[Whole; 2]; 3],
    /// The corners of the triangle's plane in clip space, without w.
    clip: [[Lanes; 3]; 3],
    /// How near the corners are.
    nearness: [Lanes; 3],
    whose: [Whose; AT_ONCE],
    count: usize,
}

/// What becomes of them.
#[derive(Debug)]
struct Ready {
    /// The second and third corner, in the order that makes the area positive.
    raster: [[Whole; 2]; 2],
    extent: [[Whole; 2]; 2],
    coefficients: [Lanes; 3],
    range: [Lanes; 2],
    /// 1 where it may cover a sample, and has a plane.
    kept: Whole,
}

const NONE: Lanes = [0.0; AT_ONCE];
const NO: Whole = [0; AT_ONCE];

impl Waiting {
    pub fn new() -> Self {
        let (clip, nearness) = ([[NONE; 3]; 3], [NONE; 3]);
        Self { raster: [[NO; 2]; 3], clip, nearness, whose: [Whose::default(); AT_ONCE], count: 0 }
    }

    /// Adds a triangle; its plane is that through the clip points.
    #[inline(always)]
    pub fn push(
        &mut self,
        raster: [[i32; 2]; 3],
        (clip, nearness): ([ClipPoint; 3], [f64; 3]),
        whose: Whose,
        (image, into): (Image<'_>, &mut Unsorted),
    ) {
        let lane = self.count;
        for corner in 0..3 {
            let ClipPoint { x, y, depth, .. } = clip[corner];
            self.raster[corner][0][lane] = raster[corner][0];
            self.raster[corner][1][lane] = raster[corner][1];
            self.clip[corner][0][lane] = x;
            self.clip[corner][1][lane] = y;
            self.clip[corner][2][lane] = depth;
            self.nearness[corner][lane] = nearness[corner];
        }
        self.whose[lane] = whose;
        self.count += 1;
        if self.count == AT_ONCE {
            self.finish(image, into);
        }
    }

    /// Sets up those that wait, and appends the ones that may cover a sample, in their order.
    pub fn finish(&mut self, image: Image<'_>, into: &mut Unsorted) {
        let mut ready =
            Ready { raster: [[NO; 2]; 2], extent: [[NO; 2]; 2], coefficients: [NONE; 3], range: [NONE; 2], kept: NO };
        set_up(self, image, &mut ready);
        for lane in 0..self.count {
            if ready.kept[lane] == 0 {
                continue;
            }
            let corner = |of: &[Whole; 2]| [of[0][lane], of[1][lane]];
            let [[left, right], [top, bottom]] =
                ready.extent.each_ref().each(corner).each(|ends| ends.each(|end| end as u32));
            let Whose { shape, primitive, row } = self.whose[lane];
            let coefficients = ready.coefficients.each_ref().each(|part| part[lane]);
            into.triangles.push(RasterTriangle {
                corners: [corner(&self.raster[0]), corner(&ready.raster[0]), corner(&ready.raster[1])],
                shape,
                primitive,
                row,
                plane: NearnessPlane { coefficients, range: ready.range.each_ref().each(|end| end[lane]) },
            });
            into.extents.push([[left, right], [top, bottom]]);
        }
        self.count = 0;
    }
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn set_up(waiting: &Waiting, image: Image<'_>, ready: &mut Ready) {
    let (half, size) = (image.projection.half, image.projection.size);
    let (sizes, margin) = ([size.x as i32, size.y as i32], image.margin);
    for lane in 0..AT_ONCE {
        let corner = |of: &[Whole; 2]| [of[0][lane], of[1][lane]];
        let [a, b, c] = [corner(&waiting.raster[0]), corner(&waiting.raster[1]), corner(&waiting.raster[2])];
        let across = |from: [i32; 2], to: [i32; 2]| [f64::from(to[0] - from[0]), f64::from(to[1] - from[1])];
        let (ab, ac) = (across(a, b), across(a, c));
        let area = ab[0] * ac[1] - ab[1] * ac[0];
        let swap = |one: i32, other: i32| if area < 0.0 { other } else { one };
        let (b, c) = ([swap(b[0], c[0]), swap(b[1], c[1])], [swap(c[0], b[0]), swap(c[1], b[1])]);
        let [columns, lines] =
            [pixels([a[0], b[0], c[0]], margin, sizes[0]), pixels([a[1], b[1], c[1]], margin, sizes[1])];
        let in_image = (columns[0] <= columns[1]) & (lines[0] <= lines[1]);
        let covers = (margin > 0) | may_cover([a, b, c], columns, lines);
        for axis in 0..2 {
            ready.raster[0][axis][lane] = b[axis];
            ready.raster[1][axis][lane] = c[axis];
            ready.extent[0][axis][lane] = columns[axis];
            ready.extent[1][axis][lane] = lines[axis];
        }

        let camera = |of: &[Lanes; 3]| [of[0][lane] * half.x, of[1][lane] * half.y, -of[2][lane]];
        let camera = [camera(&waiting.clip[0]), camera(&waiting.clip[1]), camera(&waiting.clip[2])];
        let coefficients = NearnessPlane::coefficients(image.projection, camera);
        for part in 0..3 {
            ready.coefficients[part][lane] = coefficients[part];
        }
        let [a, b, c] = [waiting.nearness[0][lane], waiting.nearness[1][lane], waiting.nearness[2][lane]];
        let [low, high] = if a < b { [a, b] } else { [b, a] };
        ready.range[0][lane] = if c < low { c } else { low };
        ready.range[1][lane] = if c > high { c } else { high };
        let finite = |part: f64| part.abs() < f64::INFINITY;
        let has_plane = finite(coefficients[0]) & finite(coefficients[1]) & finite(coefficients[2]);
        ready.kept[lane] = i32::from((area != 0.0) & in_image & covers & has_plane);
    }
}

/// The first and last pixel along an axis whose centres are within a distance of three coordinates, in an image of so
/// many; the first is beyond the last if there is none.
#[inline(always)]
pub(super) fn pixels([a, b, c]: [i32; 3], margin: i32, size: i32) -> [i32; 2] {
    const { assert!(SUBPIXELS == 256.0) };
    let (min, max) = (lesser(lesser(a, b), c), -lesser(lesser(-a, -b), -c));
    let (first, last) = ((min - margin + 127) >> 8, (max + margin - 128) >> 8);
    [-lesser(-first, 0), lesser(last, size - 1)]
}

#[inline(always)]
fn lesser(one: i32, other: i32) -> i32 {
    if one < other { one } else { other }
}

/// Whether a sample may be inside; only a triangle of few pixels is tested, for a large one covers some.
#[inline(always)]
fn may_cover([a, b, c]: [[i32; 2]; 3], [left, right]: [i32; 2], [top, bottom]: [i32; 2]) -> bool {
    let corner = [left << 8, top << 8];
    let edges = [Edge::new(a, b, corner), Edge::new(b, c, corner), Edge::new(c, a, corner)];
    let (width, count) = (right - left + 1, (right - left + 1) * (bottom - top + 1));
    let mut covers = count > FEW;
    for pixel in 0..FEW {
        // Of few pixels, one line of up to four, or two or more lines of one or two.
        let across = if width == 1 { 0 } else { if width == 2 { pixel & 1 } else { pixel } };
        let down = if width == 1 { pixel } else { if width == 2 { pixel >> 1 } else { 0 } };
        let [x, y] = [across, down].each(|pixels| (f64::from(pixels) + 0.5) * SUBPIXELS);
        let inside = (edges[0].at(x, y) >= 0.0) & (edges[1].at(x, y) >= 0.0) & (edges[2].at(x, y) >= 0.0);
        covers |= inside & (pixel < count);
    }
    covers
}
