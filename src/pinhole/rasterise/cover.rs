//! The nearest triangle at each sample of a tile.

use super::table::RasterTriangles;
use super::triangle::{Edge, RasterTriangle, SUBPIXELS, within};
use crate::rays::{RasterPoints, Tile};
use multiversion::multiversion;

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
        let corner = [f64::from(tile.x), f64::from(tile.y)];
        let steps = |points: &[f64], corner: f64, into: &mut Vec<f64>| {
            into.clear();
            // Rounded before the corner is taken away, so that no tile's size or place changes a sample.
            into.extend(points.iter().map(|point| (point * SUBPIXELS + 0.5).floor() - corner * SUBPIXELS));
        };
        steps(&raster.x, corner[0], &mut self.x);
        steps(&raster.y, corner[1], &mut self.y);
        self.nearness.clear();
        self.nearness.resize(rows, f64::NEG_INFINITY);
        self.nearest.clear();
        self.nearest.resize(rows, NONE);
        cover(self, table, tile, in_order);
    }

    /// The nearest triangle of a row and its nearness.
    #[inline(always)]
    pub fn nearest(&self, row: usize) -> Option<(usize, f64)> {
        (self.nearest[row] >= 0.0).then(|| (self.nearest[row] as usize, self.nearness[row]))
    }
}

/// Tests the samples near each triangle of the tile's bins.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn cover(own: &mut Cover, table: &RasterTriangles, tile: &Tile, in_order: bool) {
    for list in table.lists_of(tile) {
        for &number in list {
            let triangle = &table.triangles[number as usize];
            let Some([[left, right], [top, bottom]]) = table.pixels_of(triangle, tile) else { continue };
            let of_tile = TileTriangle::new(triangle, tile, number);
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
    fn new(triangle: &RasterTriangle, tile: &Tile, number: u32) -> Self {
        let [a, b, c] = triangle.corners;
        let corner = [tile.x, tile.y].map(|pixels| pixels as i32 * SUBPIXELS as i32);
        let [right, down, at_corner] = triangle.plane.coefficients;
        let own = at_corner + right * f64::from(tile.x) + down * f64::from(tile.y);
        Self {
            edges: [Edge::new(a, b, corner), Edge::new(b, c, corner), Edge::new(c, a, corner)],
            nearness: [right / SUBPIXELS, down / SUBPIXELS, own],
            range: triangle.plane.range,
            number: f64::from(number),
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
}
