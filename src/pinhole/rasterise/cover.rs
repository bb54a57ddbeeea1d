//! The nearest triangle at each sample of a tile.

use super::table::RasterTriangles;
use super::triangle::{Edge, RasterTriangle, SUBPIXELS, within};
use crate::each::Each;
use crate::plan::Column;
use crate::rays::{RasterPoints, Tile};
use multiversion::multiversion;

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
            column.resize(room, 0.0);
        }
        self.nearness.clear();
        self.nearness.resize(room, f64::NEG_INFINITY);
        self.nearest.clear();
        self.nearest.resize(room, NONE);
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
            self.keep_nearest_at(triangle, start.min(last));
        }
    }

    // ANCHOR: keep_nearest
    /// Keeps the triangle at those of a few samples that are inside it and where nothing is nearer; of equally near
    /// triangles the first wins, which is that of the lowest number.
    #[inline(always)]
    fn keep_nearest_at(&mut self, triangle: &TileTriangle, start: usize) {
        let rows = start..start + SAMPLES;
        let [x, y] = [&self.x, &self.y].each(|column| of(&column[rows.clone()]));
        let [ab, bc, ca] = triangle.edges.each(|edge| samples(|sample| edge.at(x[sample], y[sample])));
        let [right, down, at_corner] = triangle.nearness;
        let near: Samples = samples(|sample| {
            let near = within(right * x[sample] + down * y[sample] + at_corner, triangle.range);
            if lesser(lesser(ab[sample], bc[sample]), ca[sample]) >= 0.0 { near } else { f64::NEG_INFINITY }
        });
        let (nearness, nearest) = (of(&self.nearness[rows.clone()]), of(&self.nearest[rows.clone()]));
        let wins = |sample: usize| near[sample] > nearness[sample];
        let number = samples(|sample| if wins(sample) { triangle.number } else { nearest[sample] });
        let near = samples(|sample| if wins(sample) { near[sample] } else { nearness[sample] });
        if let (Some(of_number), Some(of_nearness)) =
            (self.nearest[rows.clone()].first_chunk_mut(), self.nearness[rows].first_chunk_mut())
        {
            (*of_number, *of_nearness) = (number, near);
        }
    }
    // ANCHOR_END: keep_nearest
}

/// A number for each of a few samples: an operation on all of them is one instruction.
type Samples = [f64; SAMPLES];

#[inline(always)]
fn samples(of: impl Fn(usize) -> f64) -> Samples {
    [0, 1, 2, 3].each(of)
}

/// A few rows of a column.
#[inline(always)]
fn of(rows: &[f64]) -> Samples {
    samples(|sample| rows[sample])
}

/// The lesser of two numbers that are not NaN, in the one instruction that `f64::min` is not.
#[inline(always)]
fn lesser(one: f64, other: f64) -> f64 {
    if one < other { one } else { other }
}
