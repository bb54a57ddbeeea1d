//! Films and bytes as first ray tracers have them.

/// The mean of samples summed in f32.
///
/// From 2²⁴ on a sum of ones no longer grows, since f32 has nothing between it and the next but one: the more samples,
/// the darker the picture.
#[must_use]
pub fn mean_by_sum_f32(samples: impl IntoIterator<Item = f32>) -> f32 {
    let (mut sum, mut count) = (0.0_f32, 0_u32);
    for sample in samples {
        sum += sample;
        count += 1;
    }
    sum / count as f32
}

/// The mean kept up to date after every sample: m + (x − m) / n, in f32.
///
/// It does not stop as the sum does, but each step rounds, and from some sample on rounds away what it brings.
#[must_use]
pub fn running_mean_f32(samples: impl IntoIterator<Item = f32>) -> f32 {
    let (mut mean, mut count) = (0.0_f32, 0_u32);
    for sample in samples {
        count += 1;
        mean += (sample - mean) / count as f32;
    }
    mean
}

/// The sum when each of some threads adds up its own part in f32 and the parts are added: another picture for every
/// number of threads.
#[must_use]
pub fn sum_by_threads(samples: &[f32], threads: usize) -> f32 {
    let part = |samples: &[f32]| samples.iter().fold(0.0_f32, |sum, sample| sum + sample);
    samples.chunks(samples.len().div_ceil(threads).max(1)).map(part).fold(0.0, |sum, part| sum + part)
}

/// The mean when a sample that is no light counts as black: the pixel becomes darker than its light.
#[must_use]
pub fn mean_with_black_for_bad(samples: &[f32]) -> f64 {
    let light = |sample: &&f32| sample.is_finite() && **sample >= 0.0;
    samples.iter().filter(light).map(|&sample| f64::from(sample)).sum::<f64>() / samples.len() as f64
}

/// The mean when everything is added as it comes, in f64.
#[must_use]
pub fn mean_of_all(samples: &[f32]) -> f64 {
    samples.iter().map(|&sample| f64::from(sample)).sum::<f64>() / samples.len() as f64
}

/// A byte by the power 1 / 2.2, which many take for the sRGB curve; rounded.
#[must_use]
pub fn byte_by_gamma(linear: f32) -> u8 {
    (libm::powf(linear.clamp(0.0, 1.0), 1.0 / 2.2) * 255.0).round() as u8
}

/// A byte by the sRGB curve, in f32; rounded.
#[must_use]
pub fn byte_by_curve_f32(linear: f32) -> u8 {
    (curve_f32(linear.clamp(0.0, 1.0)) * 255.0).round() as u8
}

/// A byte by the sRGB curve, in f32; cut off, with the 255.999 of Ray Tracing in One Weekend.
#[must_use]
pub fn byte_cut_off(linear: f32) -> u8 {
    (curve_f32(linear.clamp(0.0, 1.0)) * 255.999) as u8
}

fn curve_f32(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * libm::powf(linear, 1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sum_of_ones_stops_and_a_number_that_is_none_becomes_black() {
        const SAMPLES: usize = (1 << 24) + (1 << 22);
        let mean = mean_by_sum_f32(std::iter::repeat_n(1.0, SAMPLES));
        eprintln!("the mean of {SAMPLES} ones by a sum in f32 is {mean}");
        assert!((mean - 0.8).abs() < 1e-6);
        assert_eq!(running_mean_f32([1.0; 1000]), 1.0);
        assert_eq!(byte_by_curve_f32(f32::NAN), 0);
        assert!(mean_of_all(&[1.0, f32::NAN]).is_nan());
        assert_eq!(mean_with_black_for_bad(&[1.0, f32::NAN]), 0.5);
    }

    #[test]
    fn more_threads_give_another_sum() {
        let samples: Vec<f32> = (1..200).map(|k| 1.0 / k as f32).collect();
        assert_eq!(sum_by_threads(&samples, 1), samples.iter().fold(0.0, |sum, sample| sum + sample));
        assert!((2..=8).any(|threads| sum_by_threads(&samples, threads) != sum_by_threads(&samples, 1)));
    }
}
