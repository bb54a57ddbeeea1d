use super::sampling_evidence;
use crate::plan::{Column, Evidence, Stage, StageKind, TileSystems, VectorRows, column};
use bevy_ecs::prelude::*;
use glam::DVec2;
use std::ops::Range;

/// A rectangle of the image's pixels; its entity has the columns as components, with a row per pixel.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tile {
    /// The column of its leftmost pixels.
    pub x: u32,
    /// The line of its topmost pixels.
    pub y: u32,
    /// Pixels from left to right.
    pub width: u32,
    /// Pixels from top to bottom.
    pub height: u32,
}

impl Tile {
    /// The number of pixels, which is the number of rows.
    pub fn rows(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// The row of a pixel of the image, if the tile contains it.
    pub fn row_of(&self, x: u32, y: u32) -> Option<usize> {
        let (column, line) = (x.checked_sub(self.x)?, y.checked_sub(self.y)?);
        (column < self.width && line < self.height).then(|| line as usize * self.width as usize + column as usize)
    }

    /// The pixel of the image that a row stands for.
    #[inline(always)]
    pub fn pixel_of(&self, row: usize) -> [u32; 2] {
        let row = row as u32;
        [self.x + row % self.width, self.y + row / self.width]
    }

    /// Splits rows in ascending order where a line of the tile ends or a row is left out: a range of `rows`, and the pixel
    /// that the first of it stands for, each with its neighbours to the right.
    #[inline(always)]
    pub(super) fn runs_of(&self, rows: &[u32]) -> impl Iterator<Item = (Range<usize>, [u32; 2])> {
        let (mut start, mut first, mut line) = (0, 0, self.y);
        std::iter::from_fn(move || {
            let row = *rows.get(start)?;
            while row - first >= self.width {
                (first, line) = (first + self.width, line + 1);
            }
            let column = row - first;
            let longest = ((self.width - column) as usize).min(rows.len() - start);
            let own = &rows[start..start + longest];
            // Rows ascend, so that as many as there are from the first to the last leave out none.
            let length = match own[longest - 1] - row == longest as u32 - 1 {
                true => longest,
                false => own.iter().zip(row..).take_while(|(own, next)| *own == next).count(),
            };
            let run = start..start + length;
            start = run.end;
            Some((run, [self.x + column, line]))
        })
    }
}

column! {
    /// Points of the image in raster space: in pixels, with the origin at the top left corner and y down.
    pub struct RasterPoints("raster", "raster", "pixels", Pixel) {
        /// To the right, and downward.
        point: DVec2 as [x, y],
    }
}

impl RasterPoints {
    /// Paints x as red, which grows to the right, and y as green, which grows downward.
    fn paint_row(&self, row: usize, size: [u32; 2]) -> [f32; 3] {
        let [x, y] = self.point.at(row);
        [(x / f64::from(size[0])) as f32, (y / f64::from(size[1])) as f32, 0.0]
    }
}

// ANCHOR: raster_from_pixel
/// The centre of a pixel in raster space: a pixel is a unit square, and its coordinates are those of the square's top
/// left corner.
#[inline(always)]
pub fn raster_from_pixel(x: u32, y: u32) -> DVec2 {
    DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5)
}
// ANCHOR_END: raster_from_pixel

// ANCHOR: fill_raster
/// Fills a tile's raster points, line by line.
pub fn fill_raster(mut tiles: Query<(&Tile, &mut RasterPoints)>) {
    for (tile, mut raster) in &mut tiles {
        let [xs, ys] = raster.slices_mut(tile.rows());
        let lines = xs.chunks_mut(tile.width as usize).zip(ys.chunks_mut(tile.width as usize));
        for (y, (xs, ys)) in (tile.y..).zip(lines) {
            for (x, (raster_x, raster_y)) in (tile.x..).zip(xs.iter_mut().zip(ys)) {
                let raster = raster_from_pixel(x, y);
                (*raster_x, *raster_y) = (raster.x, raster.y);
            }
        }
    }
}
// ANCHOR_END: fill_raster

// ANCHOR: raster_stage
/// The stage that runs this system.
pub fn raster_stage() -> Stage {
    Stage::new("Place raster points", TileSystems::Raster, fill_raster).kind(StageKind::Alternative).when(|scene| {
        match sampling_evidence(scene) {
            samples if samples.needed => Evidence { needed: false, ..samples },
            _ => Evidence::always("every picture needs it"),
        }
    })
}
// ANCHOR_END: raster_stage

/// The number of rows of a tile's raster points, the same for all aligned columns.
pub(crate) fn aligned_rows(raster: &RasterPoints) -> usize {
    raster.rows()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_pixel_s_centre_is_half_a_pixel_from_both_edges() {
        assert_eq!(raster_from_pixel(0, 0), DVec2::new(0.5, 0.5));
    }

    #[test]
    fn row_of_and_pixel_of_are_inverse() {
        let tile = Tile { x: 64, y: 32, width: 7, height: 5 };
        for row in 0..tile.rows() {
            let [x, y] = tile.pixel_of(row);
            assert_eq!(tile.row_of(x, y), Some(row));
        }
        let some: Vec<u32> = (0..tile.rows() as u32).filter(|row| row % 3 != 1).collect();
        for rows in [some, (0..tile.rows() as u32).collect(), vec![34], vec![6, 7, 8], vec![]] {
            let (mut walked, mut tried) = (Vec::new(), 0);
            for (run, [x, y]) in tile.runs_of(&rows) {
                assert_eq!(run.start, walked.len());
                walked.extend(run.zip(x..).map(|(_, x)| [x, y]));
                tried += 1;
            }
            assert_eq!(walked, rows.iter().map(|&row| tile.pixel_of(row as usize)).collect::<Vec<_>>());
            assert!(rows.len() < tile.rows() || tried == tile.height, "{tried} runs for whole lines");
        }
        assert_eq!(tile.row_of(63, 32), None);
        assert_eq!(tile.row_of(71, 32), None);
    }
}
