//! Whether two ways to render have one mean image: a test a block of pixels and colour, all of them together at one level.

use super::distribution::student_cdf;
use super::interval::joined;
use crate::measure::image_error::Numbers;

/// The probability that any test says that two equal means differ.
pub const FAMILY: f64 = 0.01;

/// What the tests of two sets of images say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Agreement {
    /// How many tests were made.
    pub tests: usize,
    /// How many of them say that the means differ.
    pub apart: usize,
    /// The least likely difference, as a probability.
    pub min: f64,
    /// Below this a difference is one (Šidák 1967).
    pub limit: f64,
    /// The mean of a block's standard error over its mean: what the tests can see; infinite where both sets are black.
    pub resolution: f64,
}

impl Agreement {
    /// Whether there is light, and no test says that the means differ.
    pub fn agrees(&self) -> bool {
        self.tests > 0 && self.apart == 0 && self.resolution.is_finite()
    }
}

/// Compares the mean images of two sets of independent renders, by Welch's t over blocks of so many pixels a side.
///
/// Blocks, not pixels, since a mean of many is nearer to a normal variable.
/// Errors: images of two sizes, or fewer than two a set.
pub fn agreement(one: &[Numbers], other: &[Numbers], side: u32) -> Result<Agreement, String> {
    let mut sizes = one.iter().chain(other).map(|image| image.size);
    let size = sizes.next();
    if sizes.any(|other| Some(other) != size) {
        return Err("the images have two sizes".into());
    }
    let [one, other] = [blocks(one, side)?, blocks(other, side)?];
    let limit = 1.0 - libm::pow(1.0 - FAMILY, 1.0 / one.len() as f64);
    let (mut apart, mut min, mut tests) = (0, 1.0_f64, 0);
    let (mut errors, mut light) = (0.0, 0.0);
    for (a, b) in one.iter().zip(&other) {
        let (variance, freedom) = joined(&[(a.variance, a.freedom), (b.variance, b.freedom)]);
        tests += 1;
        errors += variance.sqrt();
        light += 0.5 * (a.mean + b.mean);
        let difference = a.mean - b.mean;
        if difference == 0.0 {
            continue;
        }
        let t = difference.abs() / variance.sqrt();
        let likely = if variance > 0.0 { 2.0 * student_cdf(-t, freedom) } else { 0.0 };
        min = min.min(likely);
        apart += usize::from(likely < limit);
    }
    let resolution = if light > 0.0 { errors / light } else { f64::INFINITY };
    Ok(Agreement { tests, apart, min, limit, resolution })
}

/// A block's mean over all images, the variance of that mean, and its freedom.
struct Block {
    mean: f64,
    variance: f64,
    freedom: f64,
}

fn blocks(images: &[Numbers], side: u32) -> Result<Vec<Block>, String> {
    let [first, _, ..] = images else { return Err("two images at least are needed to tell how they vary".into()) };
    let [width, height] = first.size;
    let corners =
        (0..height).step_by(side as usize).flat_map(|y| (0..width).step_by(side as usize).map(move |x| [x, y]));
    let count = images.len() as f64;
    let mut found = Vec::new();
    for [x, y] in corners {
        for part in 0..3 {
            let means: Vec<f64> = images.iter().map(|image| block_mean(image, [x, y], side, part)).collect();
            let mean = means.iter().sum::<f64>() / count;
            let squares = means.iter().map(|own| (own - mean) * (own - mean)).sum::<f64>();
            found.push(Block { mean, variance: squares / (count - 1.0) / count, freedom: count - 1.0 });
        }
    }
    Ok(found)
}

fn block_mean(image: &Numbers, [x, y]: [u32; 2], side: u32, part: usize) -> f64 {
    let [width, height] = image.size;
    let (right, down) = (x.saturating_add(side).min(width), y.saturating_add(side).min(height));
    let rows = (y..down).flat_map(|y| (x..right).map(move |x| (y * width + x) as usize));
    let sum: f64 = rows.map(|pixel| image.pixels[pixel][part]).sum();
    sum / f64::from((right - x) * (down - y))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;

    fn noise(count: usize, mean: f64, seed: u64) -> Vec<Numbers> {
        let mut draws = Draws::new(seed, 0);
        let mut image = || {
            let pixels = (0..32 * 32).map(|_| [0; 3].map(|_| mean + draws.unit() - 0.5)).collect();
            Numbers { size: [32, 32], pixels, white: None }
        };
        (0..count).map(|_| image()).collect()
    }

    #[test]
    fn equal_means_agree_and_others_do_not() {
        let sets = 60;
        let told = (0..sets).filter(|&seed| {
            let found = agreement(&noise(8, 1.0, 2 * seed), &noise(8, 1.0, 2 * seed + 1), 8).expect("one size");
            assert_eq!(found.tests, 48);
            !found.agrees()
        });
        let wrong = told.count();
        // One in a hundred is to be expected; five of 60 come up once in 2,000 such tests.
        assert!(wrong < 5, "{wrong} of {sets} equal pairs were told apart");
        // A block of 64 pixels and 8 images knows its mean to 0.0128: a shift of ten times that is seen in each.
        let found = agreement(&noise(8, 1.0, 1), &noise(8, 1.128, 2), 8).expect("one size");
        assert!(found.apart > 40, "{found:?}");
        eprintln!("agreement: {wrong} of {sets} equal pairs told apart, {} of 48 blocks of unequal ones", found.apart);
    }

    /// Black images are equal, and say nothing.
    #[test]
    fn darkness_does_not_agree() {
        let black = |count: usize| {
            let mut images = noise(count, 1.0, 3);
            images.iter_mut().for_each(|image| image.pixels.fill([0.0; 3]));
            images
        };
        let found = agreement(&black(4), &black(4), 8).expect("one size");
        assert!(found.apart == 0 && !found.agrees(), "{found:?}");
        let found = agreement(&noise(4, 1.0, 5), &noise(4, 1.0, 5), u32::MAX).expect("one size");
        assert!(found.agrees() && found.tests == 3 && found.resolution > 0.0, "{found:?}");
    }

    #[test]
    fn one_image_or_two_sizes_are_refused() {
        assert!(agreement(&noise(1, 1.0, 0), &noise(2, 1.0, 1), 8).is_err());
        let small = Numbers { size: [16, 64], ..noise(1, 1.0, 0)[0].clone() };
        assert!(agreement(&noise(2, 1.0, 0), &[small.clone(), small], 8).is_err());
    }
}
