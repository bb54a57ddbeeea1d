//! Adaptive sampling as it is first thought of.

/// What became of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stopped {
    /// The mean of its samples.
    pub mean: f64,
    /// How many it took.
    pub samples: u32,
}

/// Takes samples until they themselves say that their mean is good enough, and hands back that very mean.
///
/// Samples that happen to be alike stop it; those that would have told otherwise are then never taken.
/// So what is rare in a pixel is missed more often than it should be, and the picture is wrong however often it is
/// rendered: the error does not average out.
#[must_use]
pub fn mean_until(mut sample: impl FnMut(u32) -> f64, fewest: u32, max: u32, error: f64) -> Stopped {
    let (mut mean, mut squares, mut samples) = (0.0, 0.0, 0_u32);
    loop {
        let value = sample(samples);
        samples += 1;
        let away = value - mean;
        mean += away / f64::from(samples);
        squares += away * (value - mean);
        let variance_of_mean = squares / f64::from(samples.max(2) - 1) / f64::from(samples);
        let enough = variance_of_mean <= error * error * (mean * mean + 1e-2);
        if samples >= max || (samples >= fewest && enough) {
            return Stopped { mean, samples };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pinhole::render::samples_for;
    use pinhole::sample::{Purpose, uniform};

    /// A pixel of which a fraction is white and the rest black, rendered many times: the mean of the pictures and its
    /// standard error, and samples a picture.
    fn repeated(renders: u32, render: impl Fn(u32) -> Stopped) -> (f64, f64, f64) {
        let (mut sum, mut squares, mut samples) = (0.0, 0.0, 0.0);
        for number in 0..renders {
            let stopped = render(number);
            sum += stopped.mean;
            squares += stopped.mean * stopped.mean;
            samples += f64::from(stopped.samples);
        }
        let (n, mean) = (f64::from(renders), sum / f64::from(renders));
        (mean, ((squares / n - mean * mean) / n).sqrt(), samples / n)
    }

    #[test]
    fn stopping_by_its_own_samples_is_wrong_on_average_and_stopping_by_a_pilot_s_is_not() {
        const RENDERS: u32 = 20_000;
        for fraction in [0.02, 0.1, 0.5, 0.9] {
            let white = |seed: u64, render: u32, sample: u32| {
                f64::from(u8::from(uniform(seed, [render, 0], sample, Purpose::Pixel) < fraction))
            };
            let naive = repeated(RENDERS, |render| mean_until(|sample| white(1, render, sample), 8, 400, 0.1));
            let two_stage = repeated(RENDERS, |render| {
                let pilot: f64 = (0..8).map(|sample| white(2, render, sample)).sum::<f64>() / 8.0;
                let variance = pilot * (1.0 - pilot) * 8.0 / 7.0;
                let samples = samples_for(variance, pilot * pilot, 0.1).min(400);
                let sum: f64 = (0..samples).map(|sample| white(3, render, sample)).sum();
                Stopped { mean: sum / f64::from(samples), samples: samples + 8 }
            });
            eprintln!(
                "white fraction {fraction}: naive {:+.5} ± {:.5} with {:.0} samples, by a pilot {:+.5} ± {:.5} with {:.0}",
                naive.0 - fraction,
                naive.1,
                naive.2,
                two_stage.0 - fraction,
                two_stage.1,
                two_stage.2
            );
            assert!((naive.0 - fraction).abs() > 4.0 * naive.1, "the naive bias was not found");
            assert!((two_stage.0 - fraction).abs() < 4.0 * two_stage.1, "a bias of the two stages");
        }
    }
}
