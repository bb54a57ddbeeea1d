//! The nearest triangle at each sample of a tile.

use super::table::RasterTriangles;
use super::triangle::{Edge, RasterTriangle, SUBPIXELS, within};
use crate::each::{Each, set_length};
use crate::plan::Column;
use crate::rays::{RasterPoints, Tile};
use multiversion::multiversion;
use std::hint::select_unpredictable;

/// How many samples are tested at once; a triangle is tested at more samples than its own rather than at fewer at once.
const SAMPLES: usize = 4;
/// The number of no triangle.
const NONE: f64 = -1.0;

/// The samples of a tile, how near the nearest triangle is at each, and which one that is.
///
/// All numbers are f64, whole where they are numbers of triangles or of steps, so that one loop handles several samples
/// at once; the columns have room for as many, even where a tile has fewer rows.
#[derive(Debug, Default)]
pub struct Cover {
    x: Vec<f64>,
    y: Vec<f64>,
    nearness: Vec<f64>,
    nearest: Vec<f64>,
}

impl Cover {
    /// Finds the nearest triangle at each sample of a tile; `pixel_of` says which pixel of the tile a row belongs to
    /// where it is not that of its number.
    pub fn fill(&mut self, table: &RasterTriangles, tile: &Tile, raster: &RasterPoints, in_order: bool) {
        let rows = raster.rows();
        let room = rows.max(SAMPLES);
        for column in [&mut self.x, &mut self.y] {
            set_length(column, room, || 0.0);
        }
        self.nearness.clear();
        set_length(&mut self.nearness, room, || f64::NEG_INFINITY);
        self.nearest.clear();
        set_length(&mut self.nearest, room, || NONE);
        cover(self, table, (tile, raster), in_order);
    }

    /// The nearest triangle of a row.
    #[inline(always)]
    pub fn nearest(&self, row: usize) -> Option<usize> {
        (self.nearest[row] >= 0.0).then(|| self.nearest[row] as usize)
    }
}

/// Tests the samples near each triangle of the tile's bins.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn cover(own: &mut Cover, table: &RasterTriangles, (tile, raster): (&Tile, &RasterPoints), in_order: bool) {
    let corner = [tile.x, tile.y].each(|pixels| f64::from(pixels) * SUBPIXELS);
    for ((points, corner), steps) in raster.slices().into_iter().zip(corner).zip([&mut own.x, &mut own.y]) {
        for (point, step) in points.iter().zip(steps) {
            // Rounded before the corner is taken away, so that no tile's size or place changes a sample.
            *step = (point * SUBPIXELS + 0.5).floor() - corner;
        }
    }
    for (triangles, first, list) in table.lists_near(tile) {
        for &place in list {
            let triangle = &triangles[place as usize];
            let Some([[left, right], [top, bottom]]) = table.pixels_of(triangle, tile) else { continue };
            let of_tile = TileTriangle::new(triangle, tile, first + place as usize);
            if !in_order {
                own.keep_nearest(&of_tile, 0..own.x.len());
                continue;
            }
            for line in top..=bottom {
                let start = line * tile.width as usize;
                own.keep_nearest(&of_tile, start + left..start + right + 1);
            }
        }
    }
}

/// A triangle as the samples of one tile are tested against it.
struct TileTriangle {
    edges: [Edge; 3],
    nearness: [f64; 3],
    range: [f64; 2],
    number: f64,
}

impl TileTriangle {
    #[inline(always)]
    fn new(triangle: &RasterTriangle, tile: &Tile, number: usize) -> Self {
        let [a, b, c] = triangle.corners;
        let corner = [tile.x, tile.y].each(|pixels| pixels as i32 * SUBPIXELS as i32);
        let [right, down, at_corner] = triangle.plane.coefficients;
        let own = at_corner + right * f64::from(tile.x) + down * f64::from(tile.y);
        Self {
            edges: [Edge::new(a, b, corner), Edge::new(b, c, corner), Edge::new(c, a, corner)],
            nearness: [right / SUBPIXELS, down / SUBPIXELS, own],
            range: triangle.plane.range,
            number: number as f64,
        }
    }
}

impl Cover {
    /// Keeps the triangle at the samples of some rows that are inside it and where nothing is nearer; and at some of the
    /// rows beside them, so that it is always as many at once.
    #[inline(always)]
    fn keep_nearest(&mut self, triangle: &TileTriangle, rows: std::ops::Range<usize>) {
        let last = self.x.len() - SAMPLES;
        for start in rows.step_by(SAMPLES) {
            let start = start.min(last);
            let (Some(x), Some(y)) = (self.x[start..].first_chunk(), self.y[start..].first_chunk()) else { return };
            let (nearness, nearest) = (&mut self.nearness[start..], &mut self.nearest[start..]);
            let (Some(nearness), Some(nearest)) = (nearness.first_chunk_mut(), nearest.first_chunk_mut()) else {
                return;
            };
            keep_nearest_of(triangle, [x, y], nearness, nearest);
        }
    }
}

/// A number for each of a few samples: an operation on all of them is one instruction.
type Samples = [f64; SAMPLES];

// ANCHOR: keep_nearest
/// Keeps the triangle at those of a few samples that are inside it and where nothing is nearer; of equally near
/// triangles the first wins, which is that of the lowest number.
#[inline(always)]
fn keep_nearest_of(triangle: &TileTriangle, [x, y]: [&Samples; 2], nearness: &mut Samples, nearest: &mut Samples) {
    let ([ab, bc, ca], [right, down, at_corner]) = (triangle.edges, triangle.nearness);
    // In arrays of their own, which overlap nothing that is read, and without a branch: only then is an operation on all
    // samples one instruction.
    let (mut nearness_now, mut nearest_now) = ([0.0; SAMPLES], [0.0; SAMPLES]);
    for sample in 0..SAMPLES {
        let (x, y) = (x[sample], y[sample]);
        let near = within(right * x + down * y + at_corner, triangle.range);
        let is_inside = lesser(lesser(ab.at(x, y), bc.at(x, y)), ca.at(x, y)) >= 0.0;
        let near = select_unpredictable(is_inside, near, f64::NEG_INFINITY);
        let wins = near > nearness[sample];
        nearness_now[sample] = select_unpredictable(wins, near, nearness[sample]);
        nearest_now[sample] = select_unpredictable(wins, triangle.number, nearest[sample]);
    }
    (*nearness, *nearest) = (nearness_now, nearest_now);
}
// ANCHOR_END: keep_nearest

/// The lesser of two numbers that are not NaN, in the one instruction that `f64::min` is not.
#[inline(always)]
fn lesser(one: f64, other: f64) -> f64 {
    if one < other { one } else { other }
}
