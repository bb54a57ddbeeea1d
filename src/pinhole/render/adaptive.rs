use crate::each::Each;
use crate::film::{Film, FilmTile};

/// The constant added to the square of a pixel's radiance before its squared error is divided by it, as in relMSE.
pub const EPSILON: f64 = 1e-2;
/// The fewest samples of a pixel from which its error can be estimated.
pub const FEWEST: u32 = 4;

// ANCHOR: samples_for
/// The number of samples n for which the mean of samples of this variance V has a relative error e, where `mean_square`
/// is the square L² of the mean: V / n = e² (L² + 0.01), solved for n.
pub fn samples_for(variance: f64, mean_square: f64, error: f64) -> u32 {
    let samples = variance / (error * error * (mean_square + EPSILON));
    (samples.ceil() as u32).max(FEWEST)
}
// ANCHOR_END: samples_for

/// The number of new samples for each pixel, tile by tile, decided from a film of pilot samples and from nothing else.
///
/// A pixel whose few samples happen to agree underestimates its noise, so its variance is taken to be no smaller than
/// the mean of the variances of the 3 × 3 pixels around it, and one event more than they saw is added (see `Noise`).
/// Where these pixels saw nothing vary, the event is one of those that the rest of the picture saw, and such a pixel gets
/// no more samples than the others on average, so that dark parts of a picture at most double its cost.
/// The pilot samples are independent of the new ones, so the mean of the new ones stays unbiased whatever is decided
/// from the pilot (Kirk and Arvo, "Unbiased sampling techniques for image synthesis", 1991).
pub fn planned_samples(pilot: &Film, error: f64) -> Vec<Vec<u32>> {
    let pixels = Noise::of_pixels(pilot);
    let around = |tile: &FilmTile, row: usize| Noise::around(&pixels, pilot.width, tile.tile.pixel_of(row));
    let known =
        |[own, around]: &[Noise; 2]| own.variance().max(around.variance()) + around.one_event(around.event_size());
    let planned =
        |tile: &FilmTile, row: usize, variance: f64| samples_for(variance, mean_square(tile.shown_f64(row)), error);
    let (mut all, mut total) = (Noise::default(), 0.0);
    for tile in &pilot.tiles {
        for row in 0..tile.tile.rows() {
            let noise = around(tile, row);
            all.add(&noise[0]);
            total += f64::from(planned(tile, row, known(&noise)));
        }
    }
    let max = (total / all.pixels).ceil() as u32;
    let of_row = |tile: &FilmTile, row: usize| {
        let noise = around(tile, row);
        match (all.event_size(), noise[1].event_size()) {
            (Some(size), None) => planned(tile, row, noise[1].one_event(Some(size))).min(max),
            // Nothing was seen to vary anywhere: all samples together have just missed light like that of a white wall.
            (None, _) => planned(tile, row, all.one_event(Some(1.0))),
            _ => planned(tile, row, known(&noise)),
        }
    };
    pilot.tiles.iter().map(|tile| (0..tile.tile.rows()).map(|row| of_row(tile, row)).collect()).collect()
}

/// What the pilot samples of some pixels say together about their noise.
///
/// Light that arrives rarely comes in events: where one of radiance M comes in a fraction p of the samples, the mean is
/// L = p M and the variance V = p M² for small p, so that M = V / L.
/// In m samples k events are seen, and k M² / m estimates V.
/// With that, a pixel at which k = 0 would be given next to no samples, however bright what it missed; and as E[1 / k] is
/// more than 1 / E[k], the error would be above the one asked for on average.
/// One event more, (k + 1) M² / m, ends both, for E[1 / (k + 1)] = (1 − e^−λ) / λ < 1 / λ where k is Poisson distributed
/// with the mean λ.
#[derive(Clone, Copy, Debug, Default)]
struct Noise {
    pixels: f64,
    samples: f64,
    /// The sum of the pixels' variances.
    variances: f64,
    /// The sum of the same, each times the size of its events.
    sized: f64,
}

impl Noise {
    /// That of each pixel, line by line.
    fn of_pixels(pilot: &Film) -> Vec<Self> {
        let mut pixels = vec![Self::default(); pilot.width as usize * pilot.height as usize];
        for (number, tile) in pilot.tiles.iter().enumerate() {
            for row in 0..tile.tile.rows() {
                let variance = mean_of(pilot.moments.get(number).map_or([0.0; 3], |own| own.variance(tile, row)));
                let light = mean_of(tile.shown_f64(row)).abs();
                let [x, y] = tile.tile.pixel_of(row);
                pixels[y as usize * pilot.width as usize + x as usize] = Self {
                    pixels: 1.0,
                    samples: f64::from(tile.count[row]),
                    variances: variance,
                    sized: if light > 0.0 { variance * (variance / light) } else { 0.0 },
                };
            }
        }
        pixels
    }

    /// That of a pixel, and that of the 3 × 3 pixels around it, as far as they are in the picture.
    fn around(pixels: &[Self], width: u32, [x, y]: [u32; 2]) -> [Self; 2] {
        let mut around = Self::default();
        for line in pixels.chunks(width as usize).take(y as usize + 2).skip(y.saturating_sub(1) as usize) {
            let columns = x.saturating_sub(1) as usize..(x as usize + 2).min(line.len());
            line[columns].iter().for_each(|pixel| around.add(pixel));
        }
        [pixels[y as usize * width as usize + x as usize], around]
    }

    fn add(&mut self, other: &Self) {
        self.pixels += other.pixels;
        self.samples += other.samples;
        self.variances += other.variances;
        self.sized += other.sized;
    }

    /// The mean of the pixels' variances.
    fn variance(&self) -> f64 {
        self.variances / self.pixels.max(1.0)
    }

    /// The radiance of the events that the variance comes from; none where nothing varies.
    fn event_size(&self) -> Option<f64> {
        (self.variances > 0.0).then(|| self.sized / self.variances)
    }

    /// The variance that one event of this size adds.
    fn one_event(&self, size: Option<f64>) -> f64 {
        size.map_or(0.0, |size| size * size / self.samples.max(1.0))
    }
}

/// The root mean square of the pixels' relative standard errors, estimated from the film alone: from its second moments,
/// or else from the difference between the last block of samples and all before it; none where it has neither.
///
/// Two independent means of n₁ and n₂ samples differ by δ with E\[δ²\] = σ² (1 / n₁ + 1 / n₂), so that δ² n₁ n₂ / N²
/// estimates the variance σ² / N of the mean of all N; blocks of a low-discrepancy sequence are better than independent
/// ones, and then it is an estimate from above.
pub fn error_of(film: &Film) -> Option<f64> {
    let (mut sum, mut pixels) = (0.0, 0_u64);
    for (number, tile) in film.tiles.iter().enumerate() {
        for row in 0..tile.tile.rows() {
            let variance = if film.moments.is_empty() {
                let Some([last, before]) = tile.blocks_of(row) else { continue };
                let [n, m] = [last.1, before.1].each(f64::from);
                let weight = n * m / ((n + m) * (n + m));
                mean_of([0, 1, 2].each(|part| {
                    let apart = last.0[part] / n - before.0[part] / m;
                    apart * apart * weight
                }))
            } else {
                mean_of(film.variance_of_mean(number, row))
            };
            if tile.count[row] > 1 {
                sum += variance / (mean_square(tile.shown_f64(row)) + EPSILON);
                pixels += 1;
            }
        }
    }
    (pixels > 0).then(|| (sum / pixels as f64).sqrt())
}

fn mean_of(parts: [f64; 3]) -> f64 {
    (parts[0] + parts[1] + parts[2]) / 3.0
}

fn mean_square(mean: [f64; 3]) -> f64 {
    mean_of(mean.each(|part| part * part))
}

/// The errors of a film's pixels, estimated from its own samples.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Achieved {
    /// The root mean square of all pixels' relative errors.
    pub error: f64,
    /// The number of pixels.
    pub pixels: u64,
    /// The number of pixels whose estimated error is above the target.
    pub above: u64,
    /// The number of those that were to get more samples than the limit allowed.
    pub cut_short: u64,
    /// Samples per pixel: mean, fewest, most.
    pub samples: (f64, u32, u32),
}

/// Estimates a film's errors and compares them with the target; `max` is the limit of samples per pixel.
pub fn achieved(film: &Film, target: f64, max: u32) -> Achieved {
    let mut found = Achieved { samples: (0.0, u32::MAX, 0), ..Achieved::default() };
    let (mut squares, mut sum) = (0.0, 0_u64);
    for (number, tile) in film.tiles.iter().enumerate() {
        for row in 0..tile.tile.rows() {
            let variance = mean_of(film.variance_of_mean(number, row));
            let square = variance / (mean_square(tile.shown_f64(row)) + EPSILON);
            let above = square > target * target;
            let wanted_more = film.planned.get(number).is_some_and(|planned| planned[row] > max);
            squares += square;
            found.pixels += 1;
            found.above += u64::from(above);
            found.cut_short += u64::from(above && wanted_more);
            let count = tile.count[row];
            sum += u64::from(count);
            found.samples = (0.0, found.samples.1.min(count), found.samples.2.max(count));
        }
    }
    found.error = (squares / found.pixels as f64).sqrt();
    found.samples.0 = sum as f64 / found.pixels as f64;
    found
}
