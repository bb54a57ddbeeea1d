//! The nearest triangle at each sample of a tile.

use super::table::RasterTriangles;
use super::triangle::{Edge, RasterTriangle, SUBPIXELS, within};
use crate::rays::{RasterPoints, Tile};
use multiversion::multiversion;

/// Fewer samples than this are tested one by one, for a loop over eight at once would take longer.
const FEW: usize = 5;
/// The number of no triangle.
const NONE: f64 = -1.0;

/// The samples of a tile, how near the nearest triangle is at each, and which one that is.
///
/// All numbers are f64, whole where they are numbers of triangles or of steps, so that one loop handles eight samples at
/// once.
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
        let rows = raster.x.len();
        for column in [&mut self.x, &mut self.y] {
            column.resize(rows, 0.0);
        }
        self.nearness.clear();
        self.nearness.resize(rows, f64::NEG_INFINITY);
        self.nearest.clear();
        self.nearest.resize(rows, NONE);
        cover(self, table, (tile, raster), in_order);
    }

    /// The nearest triangle of a row and its nearness.
    #[inline(always)]
    pub fn nearest(&self, row: usize) -> Option<(usize, f64)> {
        (self.nearest[row] >= 0.0).then(|| (self.nearest[row] as usize, self.nearness[row]))
    }
}

/// Tests the samples near each triangle of the tile's bins.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn cover(own: &mut Cover, table: &RasterTriangles, (tile, raster): (&Tile, &RasterPoints), in_order: bool) {
    let corner = [tile.x, tile.y].map(|pixels| f64::from(pixels) * SUBPIXELS);
    for (points, corner, steps) in [(&raster.x, corner[0], &mut own.x), (&raster.y, corner[1], &mut own.y)] {
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
                let rows = start + left..start + right + 1;
                match rows.len() < FEW {
                    true => rows.for_each(|row| own.keep_nearest_at(&of_tile, row)),
                    false => own.keep_nearest(&of_tile, rows),
                }
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
        let corner = [tile.x, tile.y].map(|pixels| pixels as i32 * SUBPIXELS as i32);
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
    // ANCHOR: keep_nearest
    /// Keeps the triangle at the samples of some rows that are inside it and where nothing is nearer; of equally near
    /// ones the first wins, which is that of the lowest number.
    #[inline(always)]
    fn keep_nearest(&mut self, triangle: &TileTriangle, rows: std::ops::Range<usize>) {
        let [ab, bc, ca] = triangle.edges;
        let [right, down, at_corner] = triangle.nearness;
        let (x, y) = (&self.x[rows.clone()], &self.y[rows.clone()]);
        let (nearness, nearest) = (&mut self.nearness[rows.clone()], &mut self.nearest[rows]);
        for sample in 0..x.len().min(y.len()).min(nearness.len()).min(nearest.len()) {
            let (x, y) = (x[sample], y[sample]);
            let inside = (ab.at(x, y) >= 0.0) & (bc.at(x, y) >= 0.0) & (ca.at(x, y) >= 0.0);
            let near = within(right * x + down * y + at_corner, triangle.range);
            let wins = inside & (near > nearness[sample]);
            nearness[sample] = if wins { near } else { nearness[sample] };
            nearest[sample] = if wins { triangle.number } else { nearest[sample] };
        }
    }
    // ANCHOR_END: keep_nearest

    /// The same for one row.
    #[inline(always)]
    fn keep_nearest_at(&mut self, triangle: &TileTriangle, row: usize) {
        let [ab, bc, ca] = triangle.edges;
        let [right, down, at_corner] = triangle.nearness;
        let (x, y) = (self.x[row], self.y[row]);
        if (ab.at(x, y) >= 0.0) & (bc.at(x, y) >= 0.0) & (ca.at(x, y) >= 0.0) {
            let near = within(right * x + down * y + at_corner, triangle.range);
            if near > self.nearness[row] {
                (self.nearness[row], self.nearest[row]) = (near, triangle.number);
            }
        }
    }
}
