use crate::film::Film;

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
/// the mean of the variances of the 3 × 3 pixels around it.
/// The pilot samples are independent of the new ones, so the mean of the new ones stays unbiased whatever is decided
/// from the pilot (Kirk and Arvo, "Unbiased sampling techniques for image synthesis", 1991).
pub fn planned_samples(pilot: &Film, error: f64) -> Vec<Vec<u32>> {
    let of_pixel = |x: u32, y: u32| {
        let (tile, row) = pilot.place(x, y);
        mean_of(pilot.moments.get(tile).map_or([0.0; 3], |own| own.variance(&pilot.tiles[tile], row)))
    };
    let pooled = |x: u32, y: u32| {
        let columns = x.saturating_sub(1)..=(x + 1).min(pilot.width - 1);
        let lines = y.saturating_sub(1)..=(y + 1).min(pilot.height - 1);
        let (mut sum, mut pixels) = (0.0, 0.0);
        for y in lines {
            for x in columns.clone() {
                sum += of_pixel(x, y);
                pixels += 1.0;
            }
        }
        of_pixel(x, y).max(sum / pixels)
    };
    let of_tile = |tile: &crate::film::FilmTile| {
        let of_row = |row: usize| {
            let [x, y] = tile.tile.pixel_of(row);
            samples_for(pooled(x, y), mean_square(tile.shown_f64(row)), error)
        };
        (0..tile.tile.rows()).map(of_row).collect()
    };
    pilot.tiles.iter().map(of_tile).collect()
}

fn mean_of(parts: [f64; 3]) -> f64 {
    (parts[0] + parts[1] + parts[2]) / 3.0
}

fn mean_square(mean: [f64; 3]) -> f64 {
    mean_of(mean.map(|part| part * part))
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

/// Estimates a film's errors and compares them with the target; `most` is the limit of samples per pixel.
pub fn achieved(film: &Film, target: f64, most: u32) -> Achieved {
    let mut found = Achieved { samples: (0.0, u32::MAX, 0), ..Achieved::default() };
    let (mut squares, mut sum) = (0.0, 0_u64);
    for (number, tile) in film.tiles.iter().enumerate() {
        for row in 0..tile.tile.rows() {
            let variance = mean_of(film.variance_of_mean(number, row));
            let square = variance / (mean_square(tile.shown_f64(row)) + EPSILON);
            let above = square > target * target;
            let wanted_more = film.planned.get(number).is_some_and(|planned| planned[row] > most);
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
