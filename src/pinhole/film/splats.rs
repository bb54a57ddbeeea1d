use crate::each::Each;
use crate::filters::{filter_area, filter_factor, radius_of, value_over_factor};
use crate::scene::Filter;

/// The splats of light tracing: sums in f64 over the whole image, separate from the camera's samples.
///
/// Exists only with light tracing.
/// A light path may contribute to any pixel, so no tile owns these; they are added in the order of the paths.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FilmSplats {
    /// The width and height of the image in pixels.
    pub size: [u32; 2],
    /// Sums of red, green and blue, line by line from the top.
    pub sums: [Vec<f64>; 3],
    /// Number of light paths traced, whether or not they contributed.
    pub paths: u64,
    /// Number of splats rejected, because a component was negative or not finite.
    pub rejected: u64,
    /// The minimum of a component of a splat: 0, or that of all numbers, as for a [`FilmTile`](super::FilmTile).
    pub min: f64,
}

impl FilmSplats {
    /// Splats without light paths.
    pub fn new(width: u32, height: u32) -> Self {
        let zeros = || vec![0.0; width as usize * height as usize];
        Self { size: [width, height], sums: [zeros(), zeros(), zeros()], ..Self::default() }
    }

    /// The same without what was added.
    pub(super) fn emptied(&self) -> Self {
        Self { min: self.min, ..Self::new(self.size[0], self.size[1]) }
    }

    // ANCHOR: add_splat
    /// Splats a contribution at a raster point onto every pixel within the filter's radius, with weight f / ∫f.
    ///
    /// A camera sample at that point has the same expected weight in those pixels, so light from both kinds of paths
    /// passes through the same filter.
    pub fn add(&mut self, filter: &mut SplatFilter, [x, y]: [f64; 2], light: [f64; 3]) {
        if !light.iter().all(|value| (self.min..f64::INFINITY).contains(value)) {
            self.rejected += 1;
            return;
        }
        if let Filter::Box { radius: 0.5 } = filter.filter {
            return self.add_to_one(filter.scale, [x, y], light);
        }
        let [width, height] = self.size.each(i64::from);
        let (columns, lines) = (filter.covered(x, width), filter.covered(y, height));
        let mut across = std::mem::take(&mut filter.across);
        across.clear();
        across.extend(columns.clone().map(|column| filter.weight(column as f64 + 0.5 - x)));
        for line in lines {
            let down = filter.weight(line as f64 + 0.5 - y);
            let first = (line * width + columns.start) as usize;
            for (sums, value) in self.sums.iter_mut().zip(light) {
                let along = sums[first..].iter_mut().zip(&across);
                along.for_each(|(sum, across)| *sum += across * down * value);
            }
        }
        filter.across = across;
    }
    // ANCHOR_END: add_splat

    /// The same for a box as wide as a pixel.
    #[inline(always)]
    fn add_to_one(&mut self, scale: f64, [x, y]: [f64; 2], light: [f64; 3]) {
        let [width, height] = self.size.each(f64::from);
        let (column, line) = (x.floor(), y.floor());
        if column >= 0.0 && column < width && line >= 0.0 && line < height {
            let pixel = line as usize * self.size[0] as usize + column as usize;
            for (sums, value) in self.sums.iter_mut().zip(light) {
                sums[pixel] += scale * scale * value;
            }
        }
    }

    /// The estimate of a pixel from all light paths so far; 0 before the first.
    pub fn mean(&self, x: u32, y: u32) -> [f64; 3] {
        let pixel = (y * self.size[0] + x) as usize;
        let paths = self.paths.max(1) as f64;
        [0, 1, 2].each(|channel| self.sums[channel][pixel] / paths)
    }

    /// Its memory in bytes.
    pub fn bytes(&self) -> usize {
        self.sums.iter().map(|sums| size_of_val(&sums[..])).sum::<usize>() + size_of::<Self>()
    }
}

/// The reconstruction filter, as splats are weighted by it.
#[derive(Clone, Debug)]
pub struct SplatFilter {
    filter: Filter,
    radius: f64,
    /// 1 over the integral of the filter along one axis.
    scale: f64,
    /// The factor of all its values.
    factor: f64,
    /// The weight of a splat in each of the columns that it covers; a buffer that is reused.
    across: Vec<f64>,
}

impl SplatFilter {
    /// Prepares a filter for splatting.
    pub fn new(filter: Filter) -> Self {
        let radius = radius_of(filter);
        let scale = 0.5 / filter_area(filter, radius);
        Self { filter, radius, scale, factor: filter_factor(filter), across: Vec::new() }
    }

    /// The pixels along an axis whose centres lie within the filter's radius of a coordinate.
    #[inline(always)]
    fn covered(&self, place: f64, pixels: i64) -> std::ops::Range<i64> {
        let first = ((place - self.radius - 0.5).ceil().max(0.0) as i64).min(pixels);
        let end = (place + self.radius - 0.5).floor() + 1.0;
        first..(end.max(0.0) as i64).min(pixels)
    }

    #[inline(always)]
    fn weight(&self, offset: f64) -> f64 {
        match self.filter {
            // A point on the edge between two pixels belongs to the one on the right, as the position of a sample does.
            Filter::Box { radius } if offset == -radius => 0.0,
            Filter::Box { .. } => self.scale,
            filter => self.factor * value_over_factor(filter, offset.abs()) * self.scale,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;

    const FILTERS: [Filter; 5] = [
        Filter::Box { radius: 0.5 },
        Filter::Tent { radius: 1.0 },
        Filter::Gaussian { radius: 1.5, sigma: 0.5 },
        Filter::Mitchell { radius: 2.0, b: 1.0 / 3.0, c: 1.0 / 3.0 },
        Filter::BlackmanHarris { radius: 1.5 },
    ];

    /// Uniform splats over the film give the pixel in its middle exactly their value.
    #[test]
    fn uniform_splats_give_a_uniform_film() {
        const STEPS: u32 = 16;
        for filter in FILTERS {
            let mut film = FilmSplats::new(9, 7);
            let mut splats = SplatFilter::new(filter);
            for y in 0..7 * STEPS {
                for x in 0..9 * STEPS {
                    let place = [x, y].map(|along| (f64::from(along) + 0.5) / f64::from(STEPS));
                    film.add(&mut splats, place, [1.0, 2.0, 0.0]);
                }
            }
            film.paths = u64::from(STEPS * STEPS);
            let [r, g, b] = film.mean(4, 3);
            assert!((r - 1.0).abs() < 2e-3 && (g - 2.0 * r).abs() < 1e-12 && b == 0.0, "{filter:?}: {r} {g}");
        }
        eprintln!("splats: {} filters, 16 × 16 per pixel", FILTERS.len());
    }

    #[test]
    fn splats_by_a_box_land_in_one_pixel_wherever_they_lie() {
        let (mut film, mut splats) = (FilmSplats::new(5, 4), SplatFilter::new(Filter::Box { radius: 0.5 }));
        let mut draws = Draws::new(2721, 0);
        let mut tried = 0;
        for number in 0..4000 {
            let place = if number % 4 == 0 {
                [f64::from(number % 5), f64::from(number % 3)]
            } else {
                [draws.between(0.0, 5.0), draws.between(0.0, 4.0)]
            };
            film.add(&mut splats, place, [1.0; 3]);
            tried += 1;
            let pixel = (place[1].floor() * 5.0 + place[0].floor()) as usize;
            assert_eq!(film.sums[0].iter().sum::<f64>(), f64::from(tried), "{place:?}");
            assert!(film.sums[0][pixel] >= 1.0);
        }
        let before = film.clone();
        for outside in [[-0.1, 1.0], [5.0, 1.0], [2.0, -3.0], [2.0, 4.0], [1e300, 0.0], [f64::NAN, 0.0]] {
            film.add(&mut splats, outside, [1.0; 3]);
        }
        assert_eq!(film.sums, before.sums);
        film.add(&mut splats, [1.0; 2], [f64::NAN, 0.0, 0.0]);
        film.add(&mut splats, [1.0; 2], [f64::INFINITY, 0.0, -1.0]);
        assert_eq!((film.sums == before.sums, film.rejected), (true, 2));
    }
}
