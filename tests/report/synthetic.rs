//! Renderers whose variance and bias are known: a ramp, a field of bias, and noise of a chosen kind.

use pinhole_lab::measure::draws::Draws;
use pinhole_lab::measure::image_error::Numbers;
use pinhole_lab::report::curve::{Curve, Level};
use pinhole_lab::report::ensemble::{Ensemble, Reference};

/// Pixels of the synthetic images.
pub const PIXELS: usize = 120;
/// Batches of the reference.
pub const BATCHES: usize = 8;

/// The noise of one sample: mean 0, variance 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Noise {
    Gaussian,
    Uniform,
    /// e to the power of a normal number of this standard deviation, shifted and scaled.
    Lognormal(f64),
}

/// A renderer of known error.
#[derive(Clone, Copy, Debug)]
pub struct Renderer {
    pub noise: Noise,
    /// The standard deviation of one sample where the image is 1.
    pub deviation: f64,
    /// The largest value of the bias field.
    pub bias: f64,
    /// Seconds a sample, on average.
    pub seconds: f64,
}

impl Noise {
    fn draw(self, draws: &mut Draws) -> f64 {
        match self {
            Self::Gaussian => normal(draws),
            Self::Uniform => draws.between(-1.0, 1.0) * 3.0_f64.sqrt(),
            Self::Lognormal(s) => {
                let (mean, square) = ((0.5 * s * s).exp(), (s * s).exp());
                ((s * normal(draws)).exp() - mean) / (mean * (square - 1.0).sqrt())
            }
        }
    }
}

fn normal(draws: &mut Draws) -> f64 {
    let radius = (-2.0 * (1.0 - draws.unit()).ln()).sqrt();
    radius * draws.between(0.0, std::f64::consts::TAU).cos()
}

impl Renderer {
    fn right(pixel: usize) -> f64 {
        0.2 + 0.8 * pixel as f64 / PIXELS as f64
    }

    fn deviation_at(&self, pixel: usize) -> f64 {
        self.deviation * (0.3 + Self::right(pixel))
    }

    fn bias_at(&self, pixel: usize) -> f64 {
        self.bias * (pixel as f64 * 0.37).sin()
    }

    /// An image of so many samples a pixel.
    pub fn render(&self, samples: u64, seed: u64) -> Numbers {
        let mut draws = Draws::new(seed, samples);
        let pixel = |pixel: usize| {
            let noise = |draws: &mut Draws| match self.noise {
                // The mean of so many normal numbers is a normal number.
                Noise::Gaussian => normal(draws) / (samples as f64).sqrt(),
                noise => (0..samples).map(|_| noise.draw(draws)).sum::<f64>() / samples as f64,
            };
            let mean = Self::right(pixel) + self.bias_at(pixel);
            [0; 3].map(|_| mean + self.deviation_at(pixel) * noise(&mut draws))
        };
        Numbers { size: [PIXELS as u32, 1], pixels: (0..PIXELS).map(pixel).collect(), white: None }
    }

    /// A reference without bias, in batches of so many samples.
    pub fn reference(&self, samples: u64, seed: u64) -> Reference {
        let right = Self { bias: 0.0, ..*self };
        let batches: Vec<Numbers> = (0..BATCHES as u64)
            .map(|batch| right.render(samples, seed.wrapping_mul(0x9e37) + 1_000_000 + batch))
            .collect();
        Reference::of(&batches).expect("batches")
    }

    /// Runs of several sample counts and seeds against a reference.
    pub fn curve(&self, ladder: &[u64], seeds: usize, reference: (&Reference, u64), seed: u64) -> Curve {
        let level = |&samples: &u64| {
            let first = seed.wrapping_mul(0x51_7cc1) + 10_000 * samples;
            let runs: Vec<Numbers> = (0..seeds as u64).map(|run| self.render(samples, first + run)).collect();
            let mut draws = Draws::new(first, 77);
            let seconds = (0..seeds).map(|_| self.seconds * samples as f64 * draws.between(0.9, 1.1)).collect();
            Level { samples, ensemble: Ensemble::of(&runs, reference.0), seconds }
        };
        let levels = ladder.iter().map(level).collect();
        Curve { levels, seeds, batches: BATCHES, reference_samples: reference.1 * BATCHES as u64 }
    }

    /// The variance of an image, mean over its pixels.
    pub fn variance(&self, samples: u64) -> f64 {
        let all: f64 = (0..PIXELS).map(|pixel| self.deviation_at(pixel).powi(2)).sum();
        all / PIXELS as f64 / samples as f64
    }

    /// bias², mean over its pixels.
    pub fn bias_squared(&self) -> f64 {
        (0..PIXELS).map(|pixel| self.bias_at(pixel).powi(2)).sum::<f64>() / PIXELS as f64
    }

    pub fn mse(&self, samples: u64) -> f64 {
        self.variance(samples) + self.bias_squared()
    }

    /// The slope of ln MSE over the ladder by least squares.
    pub fn slope(&self, ladder: &[u64]) -> f64 {
        let points: Vec<[f64; 2]> = ladder.iter().map(|&n| [(n as f64).ln(), self.mse(n).ln()]).collect();
        let mean = |axis: usize| points.iter().map(|point| point[axis]).sum::<f64>() / points.len() as f64;
        let (x, y) = (mean(0), mean(1));
        let products: f64 = points.iter().map(|point| (point[0] - x) * (point[1] - y)).sum();
        products / points.iter().map(|point| (point[0] - x).powi(2)).sum::<f64>()
    }
}
