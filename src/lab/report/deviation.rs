//! How far one image is from the reference: means, tails, and what is not finite.

use crate::measure::image_error::{ImageError, Numbers, Oddities, RELATIVE_FLOOR, image_error};
use serde::{Deserialize, Serialize};

/// The fraction of pixels that counts as the tail.
pub const TAIL: f64 = 0.001;

/// The formula of relMSE, as every report prints it.
pub const RELATIVE_MSE: &str = "relMSE = mean of (x − r)² / (r² + 0.01)";

/// How far an image x is from the reference r, over the pixels that are finite in both.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Deviation {
    /// Mean of (x − r)².
    pub mse: f64,
    /// Mean of (x − r)² / (r² + 0.01).
    pub rel_mse: f64,
    /// The same without the 0.1 % of pixels that add most to it: what fireflies hide, or are.
    pub trimmed_rel_mse: f64,
    /// Mean of |x − r|.
    pub mae: f64,
    /// The largest |x − r|.
    pub largest: f64,
    /// The fraction of the MSE that comes from the 0.1 % of pixels that add most to it.
    pub tail_fraction: f64,
    /// Pixels that the means are taken over.
    pub compared: u64,
    /// Numbers of the image that are NaN, +∞, −∞, negative.
    pub odd: [u64; 4],
}

/// Measures an image against the reference.
///
/// Errors: images of two sizes, or no pixel that is finite in both; in one sentence.
pub fn deviation(reference: &Numbers, image: &Numbers) -> Result<Deviation, String> {
    let ImageError { means, compared, oddities: [_, odd], .. } = image_error(reference, image)?;
    let means = means.ok_or("no pixel is finite both in the reference and in the image")?;
    let (mut squares, mut relative) = (Vec::new(), Vec::new());
    for (r, x) in reference.pixels.iter().zip(&image.pixels) {
        if !r.iter().chain(x).all(|part| part.is_finite()) {
            continue;
        }
        let square = |part: usize| (x[part] - r[part]) * (x[part] - r[part]);
        squares.push((0..3).map(square).sum::<f64>());
        relative.push((0..3).map(|part| square(part) / (r[part] * r[part] + RELATIVE_FLOOR)).sum::<f64>());
    }
    let (tail, all) = split(&mut squares);
    let (relative_tail, relative_all) = split(&mut relative);
    let rest = (compared - tail_pixels(compared)) as f64;
    let Oddities { nan, plus_infinite, minus_infinite, negative } = odd;
    Ok(Deviation {
        mse: means.mse,
        rel_mse: means.rel_mse,
        trimmed_rel_mse: if rest > 0.0 { (relative_all - relative_tail).max(0.0) / (3.0 * rest) } else { 0.0 },
        mae: means.mae,
        largest: means.largest,
        tail_fraction: if all > 0.0 { tail / all } else { 0.0 },
        compared,
        odd: [nan, plus_infinite, minus_infinite, negative],
    })
}

/// How many pixels are the tail: 0.1 % of them, and one at least.
pub fn tail_pixels(pixels: u64) -> u64 {
    ((TAIL * pixels as f64).ceil() as u64).max(1).min(pixels)
}

/// The sum of the tail, and of all.
fn split(values: &mut [f64]) -> (f64, f64) {
    values.sort_by(|one, other| other.total_cmp(one));
    let tail = tail_pixels(values.len() as u64) as usize;
    (values[..tail].iter().sum(), values.iter().sum())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(pixels: Vec<[f64; 3]>) -> Numbers {
        Numbers { size: [pixels.len() as u32, 1], pixels, white: None }
    }

    /// 2,000 pixels of 1, two of which the image has as 3 and 2: every number is known.
    #[test]
    fn an_image_of_known_error_is_measured_exactly() {
        let reference = image(vec![[1.0; 3]; 2000]);
        let mut wrong = reference.clone();
        wrong.pixels[7] = [3.0; 3];
        wrong.pixels[9] = [2.0; 3];
        wrong.pixels[11] = [0.0; 3];
        let found = deviation(&reference, &wrong).expect("comparable");
        assert_eq!(found.mse, 6.0 / 2000.0);
        assert_eq!(found.mae, 4.0 / 2000.0);
        assert!((found.rel_mse - 6.0 / 1.01 / 2000.0).abs() < 1e-17);
        assert_eq!((found.largest, found.compared, found.odd), (2.0, 2000, [0; 4]));
        // The tail is two pixels: the one that is off by 2, and one of those that are off by 1.
        assert!((found.tail_fraction - 5.0 / 6.0).abs() < 1e-15);
        assert!((found.trimmed_rel_mse - 1.0 / 1.01 / 1998.0).abs() < 1e-17);
    }

    #[test]
    fn what_is_not_finite_joins_no_mean_and_is_counted() {
        let reference = image(vec![[1.0; 3]; 4]);
        let mut wrong = reference.clone();
        wrong.pixels[0] = [f64::NAN, 1.0, 1.0];
        wrong.pixels[1] = [1.0, f64::INFINITY, f64::NEG_INFINITY];
        wrong.pixels[2] = [-1.0, 1.0, 1.0];
        let found = deviation(&reference, &wrong).expect("comparable");
        assert_eq!((found.compared, found.odd), (2, [1, 1, 1, 1]));
        assert_eq!(found.mse, 4.0 / 6.0);
        let nothing = image(vec![[f64::NAN; 3]; 4]);
        let refused = deviation(&reference, &nothing).expect_err("refused");
        assert_eq!(refused, "no pixel is finite both in the reference and in the image");
    }
}
