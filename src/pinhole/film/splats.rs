use crate::extract::{filter_area, filter_value, radius_of};
use crate::scene::Filter;

/// What rays from the lights brought to the film: sums in f64 of the whole image, kept apart from the camera's samples.
///
/// Exists only where caustics are traced from the lights.
/// A ray from a light may land on any pixel, so no tile owns these; they are added in the order of the ways.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FilmSplats {
    /// Pixels from left to right and from top to bottom.
    pub size: [u32; 2],
    /// Sums of red, green and blue, line by line from the top.
    pub sums: [Vec<f64>; 3],
    /// Ways that have started, whether or not they brought anything.
    pub paths: u64,
    /// Splats that could not join, because a part of them was negative or not finite.
    pub rejected: u64,
}

impl FilmSplats {
    /// Those of no ways.
    pub fn new(width: u32, height: u32) -> Self {
        let zeros = || vec![0.0; width as usize * height as usize];
        Self { size: [width, height], sums: [zeros(), zeros(), zeros()], ..Self::default() }
    }

    // ANCHOR: add_splat
    /// Adds light that lands on a raster point, to every pixel whose filter f reaches so far: f there over its area ∫f.
    ///
    /// A sample of the camera at that point would count so for those pixels on average, so both halves of the light go
    /// through the same filter.
    pub fn add(&mut self, filter: &mut SplatFilter, [x, y]: [f64; 2], light: [f64; 3]) {
        if !light.iter().all(|part| (0.0..f64::INFINITY).contains(part)) {
            self.rejected += 1;
            return;
        }
        let [width, height] = self.size.map(i64::from);
        let (columns, lines) = (filter.reached(x, width), filter.reached(y, height));
        let mut across = std::mem::take(&mut filter.across);
        across.clear();
        across.extend(columns.clone().map(|column| filter.share(column as f64 + 0.5 - x)));
        for line in lines {
            let down = filter.share(line as f64 + 0.5 - y);
            let first = (line * width + columns.start) as usize;
            for (sums, part) in self.sums.iter_mut().zip(light) {
                let along = sums[first..].iter_mut().zip(&across);
                along.for_each(|(sum, across)| *sum += across * down * part);
            }
        }
        filter.across = across;
    }
    // ANCHOR_END: add_splat

    /// What all ways so far say of a pixel; 0 before the first.
    pub fn mean(&self, x: u32, y: u32) -> [f64; 3] {
        let pixel = (y * self.size[0] + x) as usize;
        let paths = self.paths.max(1) as f64;
        [0, 1, 2].map(|part| self.sums[part][pixel] / paths)
    }

    /// Bytes that its sums take.
    pub fn bytes(&self) -> usize {
        self.sums.iter().map(|sums| size_of_val(&sums[..])).sum::<usize>() + size_of::<Self>()
    }
}

/// The pixels' filter, as splats are added by it.
#[derive(Clone, Debug)]
pub struct SplatFilter {
    filter: Filter,
    radius: f64,
    /// 1 over the area under the filter along one axis.
    scale: f64,
    /// What a splat counts for in each of the columns that it reaches: memory for one, kept for the next.
    across: Vec<f64>,
}

impl SplatFilter {
    /// The filter of an author.
    pub fn new(filter: Filter) -> Self {
        let radius = radius_of(filter);
        Self { filter, radius, scale: 0.5 / filter_area(filter, radius), across: Vec::new() }
    }

    /// The pixels along an axis of so many whose centres lie within the filter's radius of a place.
    #[inline(always)]
    fn reached(&self, place: f64, pixels: i64) -> std::ops::Range<i64> {
        let first = ((place - self.radius - 0.5).ceil().max(0.0) as i64).min(pixels);
        let end = (place + self.radius - 0.5).floor() + 1.0;
        first..(end.max(0.0) as i64).min(pixels)
    }

    #[inline(always)]
    fn share(&self, away: f64) -> f64 {
        match self.filter {
            // A place on the edge between two pixels belongs to the one to the right, as a sample's place does.
            Filter::Box { radius } if away == -radius => 0.0,
            Filter::Box { .. } => self.scale,
            filter => filter_value(filter, away.abs()) * self.scale,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::ray_aim::Draws;

    const FILTERS: [Filter; 5] = [
        Filter::Box { radius: 0.5 },
        Filter::Tent { radius: 1.0 },
        Filter::Gaussian { radius: 1.5, sigma: 0.5 },
        Filter::Mitchell { radius: 2.0, b: 1.0 / 3.0, c: 1.0 / 3.0 },
        Filter::BlackmanHarris { radius: 1.5 },
    ];

    /// Splats all over a wide film light every pixel in its middle alike, and as much as they bring.
    #[test]
    fn even_light_is_even_on_the_film() {
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
        eprintln!("splats: {} filters, 16 × 16 a pixel", FILTERS.len());
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
