//! Whether two ways to render have one mean image: a test a block of pixels and colour, all of them together at one level.

use super::distribution::student_cdf;
use super::interval::{Estimate, mean_of};
use crate::measure::image_error::Numbers;
use serde::{Deserialize, Serialize};

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
    let [one, other] = blocks_of(one, other, side)?;
    let limit = 1.0 - libm::pow(1.0 - FAMILY, 1.0 / one.len() as f64);
    let (mut apart, mut min, mut tests) = (0, 1.0_f64, 0);
    let (mut errors, mut light) = (0.0, 0.0);
    for (a, b) in one.iter().zip(&other) {
        let difference = b.mean.less(&a.mean);
        tests += 1;
        errors += difference.variance.sqrt();
        light += 0.5 * (a.mean.value + b.mean.value);
        if difference.value == 0.0 {
            continue;
        }
        let likely = 2.0 * at_least(Estimate { value: difference.value.abs(), ..difference });
        min = min.min(likely);
        apart += usize::from(likely < limit);
    }
    let resolution = if light > 0.0 { errors / light } else { f64::INFINITY };
    Ok(Agreement { tests, apart, min, limit, resolution })
}

/// The light that one way to render lacks beside another.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Lack {
    /// A fraction of the other's light: that of the blocks that are darker and those around them, or of the whole picture where
    /// none is.
    pub fraction: f64,
    /// Its standard error.
    pub standard_error: f64,
    /// How many blocks are darker than the other's beyond noise, each with those around it.
    pub darker: usize,
    /// How many blocks there are.
    pub blocks: usize,
    /// Whether any block is darker beyond noise, or the picture as a whole.
    pub beyond_noise: bool,
}

/// What the first of two sets of independent renders lacks, by Welch's t over blocks of so many pixels a side and over the
/// whole picture, where it is compared so often.
///
/// A block is darker only if it is so together with the blocks around it: what a blur takes from one, it brings to the next.
/// And its mean counts as no better known than, for its light, a block of the whole picture is: where a few bright paths
/// bring the light, the blocks that got none are dark and scatter little.
///
/// Errors: as [`agreement`].
pub fn lack(own: &[Numbers], other: &[Numbers], side: u32, comparisons: usize) -> Result<Lack, String> {
    let [one, two] = blocks_of(own, other, side)?;
    let limit = 1.0 - libm::pow(1.0 - FAMILY, 1.0 / (comparisons * (one.len() + 1)) as f64);
    let is_lack = |difference: Estimate| difference.value > 0.0 && at_least(difference) < limit;
    // By image, so that what a path brings to several blocks counts as one.
    let light = |of: &[Block], at: &[usize]| {
        let sum = |image: usize| at.iter().map(|&at| of[at].area * of[at].each[image]).sum::<f64>();
        mean_of(&(0..of[0].each.len()).map(sum).collect::<Vec<f64>>()).ok_or(FEW)
    };
    let across = own.first().map_or(1, |image| image.size[0].div_ceil(side) as usize);
    let (mut chosen, mut darker) = (Vec::new(), Vec::new());
    let sum = |of: fn(&Block) -> f64| one.iter().map(of).sum::<f64>();
    let scatter = sum(|block| block.mean.variance) / sum(|block| block.mean.value * block.mean.value);
    let is_darker = |at: usize| {
        let (mean, light) = (one[at].mean, two[at].mean.value);
        // Where there is no light at all there is no scatter, which is NaN and no bound.
        is_lack(two[at].mean.less(&Estimate { variance: mean.variance.max(scatter * light * light), ..mean }))
    };
    for at in (0..one.len()).filter(|&at| is_darker(at)) {
        let place = |at: usize| [at / 3 % across, at / 3 / across];
        let is_near = |other: &usize| (0..2).all(|axis| place(*other)[axis].abs_diff(place(at)[axis]) <= 1);
        let near: Vec<usize> = (at % 3..one.len()).step_by(3).filter(is_near).collect();
        if is_lack(light(&two, &near)?.less(&light(&one, &near)?)) {
            chosen.extend(near);
            darker.push(at / 3);
        }
    }
    darker.dedup();
    chosen.sort_unstable();
    chosen.dedup();
    let (darker, blocks) = (darker.len(), one.len() / 3);
    if chosen.is_empty() {
        chosen.extend(0..one.len());
    }
    let difference = light(&two, &chosen)?.less(&light(&one, &chosen)?);
    let all = light(&two, &(0..two.len()).collect::<Vec<usize>>())?.value;
    let part = |value: f64| if all > 0.0 { value / all } else { 0.0 };
    let beyond_noise = darker > 0 || is_lack(difference);
    let (fraction, standard_error) = (part(difference.value), part(difference.variance.sqrt()));
    Ok(Lack { fraction, standard_error, darker, blocks, beyond_noise })
}

/// The probability that the difference of equal means comes out at least as large as this one.
fn at_least(difference: Estimate) -> f64 {
    let Estimate { value, variance, freedom } = difference;
    if variance > 0.0 { student_cdf(-value / variance.sqrt(), freedom) } else { 0.0 }
}

/// A block's mean in each image, their mean, and how many pixels it has.
struct Block {
    each: Vec<f64>,
    mean: Estimate,
    area: f64,
}

const FEW: &str = "two images at least are needed to tell how they vary";

/// The blocks of two sets of images of one size.
fn blocks_of(one: &[Numbers], other: &[Numbers], side: u32) -> Result<[Vec<Block>; 2], String> {
    let mut sizes = one.iter().chain(other).map(|image| image.size);
    let size = sizes.next();
    if sizes.any(|other| Some(other) != size) {
        return Err("the images have two sizes".into());
    }
    Ok([blocks(one, side)?, blocks(other, side)?])
}

fn blocks(images: &[Numbers], side: u32) -> Result<Vec<Block>, String> {
    let [width, height] = images.first().ok_or(FEW)?.size;
    let corners =
        (0..height).step_by(side as usize).flat_map(|y| (0..width).step_by(side as usize).map(move |x| [x, y]));
    let mut found = Vec::new();
    for [x, y] in corners {
        let (right, down) = (x.saturating_add(side).min(width), y.saturating_add(side).min(height));
        let area = f64::from((right - x) * (down - y));
        for part in 0..3 {
            let mean_in = |image: &Numbers| {
                let rows = (y..down).flat_map(|y| (x..right).map(move |x| (y * width + x) as usize));
                rows.map(|pixel| image.pixels[pixel][part]).sum::<f64>() / area
            };
            let each: Vec<f64> = images.iter().map(mean_in).collect();
            let mean = mean_of(&each).ok_or(FEW)?;
            found.push(Block { each, mean, area });
        }
    }
    Ok(found)
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

    /// A quarter of the light of a block of sixteen is a sixty-fourth of all.
    #[test]
    fn what_is_lacking_is_said_as_a_fraction_and_noise_is_not() {
        let mut dark = noise(8, 1.0, 1);
        for image in &mut dark {
            (0..64).for_each(|at| image.pixels[at / 8 * 32 + at % 8].iter_mut().for_each(|part| *part -= 0.25));
        }
        let found = lack(&dark, &noise(8, 1.0, 2), 8, 1).expect("one size");
        assert!(found.beyond_noise && [found.darker, found.blocks] == [1, 16], "{found:?}");
        assert!((found.fraction - 1.0 / 64.0).abs() < 4.0 * found.standard_error, "{found:?}");
        // So little that no block shows it is seen in the whole.
        let found = lack(&noise(8, 0.985, 3), &noise(8, 1.0, 4), 8, 1).expect("one size");
        assert!(found.beyond_noise && found.darker == 0, "{found:?}");
        assert!((found.fraction - 0.015).abs() < 4.0 * found.standard_error, "{found:?}");
        let told = (0..60).filter(|&seed| {
            let found = lack(&noise(8, 1.0, 2 * seed), &noise(8, 1.0, 2 * seed + 1), 8, 3).expect("one size");
            found.beyond_noise
        });
        // One in three hundred each.
        assert!(told.count() < 3);
        // Light that has moved to the next block is not lacking.
        let mut blurred = dark.clone();
        for image in &mut blurred {
            (0..64).for_each(|at| image.pixels[at / 8 * 32 + at % 8 + 8].iter_mut().for_each(|part| *part += 0.25));
        }
        assert!(!lack(&blurred, &noise(8, 1.0, 2), 8, 1).expect("one size").beyond_noise);
        // One spark, however bright, proves nothing.
        let mut spark = noise(8, 1.0, 5);
        spark[3].pixels[500] = [1e6; 3];
        assert!(!lack(&noise(8, 1.0, 6), &spark, 8, 1).expect("one size").beyond_noise);
    }

    #[test]
    fn one_image_or_two_sizes_are_refused() {
        assert!(agreement(&noise(1, 1.0, 0), &noise(2, 1.0, 1), 8).is_err());
        let small = Numbers { size: [16, 64], ..noise(1, 1.0, 0)[0].clone() };
        assert!(agreement(&noise(2, 1.0, 0), &[small.clone(), small], 8).is_err());
    }
}
