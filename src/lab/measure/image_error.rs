//! How far an image is from a reference: MSE, RMSE, relMSE, MAE, PSNR, and what is not finite.

use std::fmt;

/// What is added to a squared reference so that relMSE has no pole where the reference is black.
pub const RELATIVE_FLOOR: f64 = 0.01;

/// An image as numbers, three a pixel, line by line.
#[derive(Clone, Debug, PartialEq)]
pub struct Numbers {
    /// Pixels from left to right and from top to bottom.
    pub size: [u32; 2],
    /// Red, green and blue of each pixel.
    pub pixels: Vec<[f64; 3]>,
    /// The number that full white is; none where a file has no such number, as of light.
    pub white: Option<f64>,
}

/// How many of an image's numbers are no light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Oddities {
    /// Not a number.
    pub nan: u64,
    /// +∞.
    pub plus_infinite: u64,
    /// −∞.
    pub minus_infinite: u64,
    /// Below 0 and finite.
    pub negative: u64,
}

/// The means over the numbers that were compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Means {
    /// Mean of (x − r)².
    pub mse: f64,
    /// Mean of (x − r)² / (r² + 0.01).
    pub rel_mse: f64,
    /// Mean of |x − r|.
    pub mae: f64,
    /// The largest |x − r|.
    pub largest: f64,
    /// The first pixel, line by line, that has it.
    pub worst: [u32; 2],
}

/// How far an image x is from a reference r.
#[derive(Clone, Debug, PartialEq)]
pub struct ImageError {
    /// Pixels from left to right and from top to bottom.
    pub size: [u32; 2],
    /// Pixels whose six numbers are all finite: those that the means are taken over, three numbers each.
    pub compared: u64,
    /// Pixels with another number in any part; NaN differs from everything but NaN.
    pub differing: u64,
    /// The means; none where no pixel can be compared.
    pub means: Option<Means>,
    /// The number that PSNR takes for full white: the file's, or the reference's largest finite number.
    pub peak: f64,
    /// What is no light in the reference, and in the image.
    pub oddities: [Oddities; 2],
}

impl Oddities {
    fn of(image: &Numbers) -> Self {
        let mut found = Self::default();
        for &part in image.pixels.iter().flatten() {
            found.nan += u64::from(part.is_nan());
            found.plus_infinite += u64::from(part == f64::INFINITY);
            found.minus_infinite += u64::from(part == f64::NEG_INFINITY);
            found.negative += u64::from(part < 0.0 && part.is_finite());
        }
        found
    }
}

/// Compares an image with a reference, in f64, in the order of the pixels.
///
/// A pixel with a number that is not finite, in either image, joins no mean and no denominator; the counts tell it.
/// Errors: images of different sizes, in one sentence.
pub fn image_error(reference: &Numbers, image: &Numbers) -> Result<ImageError, String> {
    if reference.size != image.size {
        let [r, x] = [reference, image].map(|image| format!("{} × {}", image.size[0], image.size[1]));
        return Err(format!("the reference has {r} pixels and the image {x}: only images of one size can be compared"));
    }
    let (mut squares, mut relative, mut distances) = (0.0, 0.0, 0.0);
    let (mut largest, mut worst) = (0.0, 0);
    let (mut compared, mut differing) = (0_u64, 0);
    for (index, (r, x)) in reference.pixels.iter().zip(&image.pixels).enumerate() {
        differing += u64::from((0..3).any(|part| !(r[part] == x[part] || r[part].is_nan() && x[part].is_nan())));
        if !r.iter().chain(x).all(|part| part.is_finite()) {
            continue;
        }
        compared += 1;
        for part in 0..3 {
            let distance = (x[part] - r[part]).abs();
            squares += distance * distance;
            relative += distance * distance / (r[part] * r[part] + RELATIVE_FLOOR);
            distances += distance;
            if distance > largest {
                (largest, worst) = (distance, index);
            }
        }
    }
    let count = 3.0 * compared as f64;
    let worst = [worst as u32 % image.size[0].max(1), worst as u32 / image.size[0].max(1)];
    let means = Means { mse: squares / count, rel_mse: relative / count, mae: distances / count, largest, worst };
    Ok(ImageError {
        size: image.size,
        compared,
        differing,
        means: (compared > 0).then_some(means),
        peak: reference.white.unwrap_or_else(|| largest_finite(reference)),
        oddities: [Oddities::of(reference), Oddities::of(image)],
    })
}

fn largest_finite(image: &Numbers) -> f64 {
    image.pixels.iter().flatten().copied().filter(|part| part.is_finite()).fold(0.0, f64::max)
}

impl Means {
    /// √MSE.
    pub fn rmse(&self) -> f64 {
        self.mse.sqrt()
    }
}

impl ImageError {
    /// 10 log₁₀(peak² / MSE) in decibels: +∞ for equal images; none where nothing was compared or the peak is 0.
    pub fn psnr(&self) -> Option<f64> {
        let means = self.means.filter(|_| self.peak > 0.0)?;
        Some(if means.mse == 0.0 { f64::INFINITY } else { 20.0 * libm::log10(self.peak / means.rmse()) })
    }

    /// Pixels of the image.
    pub fn pixels(&self) -> u64 {
        u64::from(self.size[0]) * u64::from(self.size[1])
    }
}

impl fmt::Display for ImageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (pixels, left_out) = (self.pixels(), self.pixels() - self.compared);
        writeln!(f, "{} × {} pixels; {} of {pixels} differ", self.size[0], self.size[1], self.differing)?;
        match &self.means {
            Some(means) => {
                let psnr = self.psnr().map_or("none".into(), |decibels| match decibels.is_finite() {
                    true => format!("{decibels:.4} dB"),
                    false => "infinite".into(),
                });
                writeln!(f, "MSE     {:<14.6e} mean of (x − r)²", means.mse)?;
                writeln!(f, "RMSE    {:<14.6e} √MSE", means.rmse())?;
                writeln!(f, "relMSE  {:<14.6e} mean of (x − r)² / (r² + {RELATIVE_FLOOR})", means.rel_mse)?;
                writeln!(f, "MAE     {:<14.6e} mean of |x − r|", means.mae)?;
                let [x, y] = means.worst;
                writeln!(f, "max     {:<14.6e} largest |x − r|, first at pixel {x},{y}", means.largest)?;
                writeln!(f, "PSNR    {psnr:<14} 10 log₁₀(peak² / MSE), peak {}", self.peak)?;
            }
            None => writeln!(f, "no pixel is finite in both images, so there is no mean")?,
        }
        writeln!(
            f,
            "means over {} pixels × 3 numbers; {left_out} pixels left out, in which a number of either is not finite",
            self.compared
        )?;
        writeln!(f, "numbers     NaN      +Inf     −Inf     negative")?;
        for (who, odd) in ["reference", "image"].into_iter().zip(&self.oddities) {
            writeln!(
                f,
                "{who:<11} {:<8} {:<8} {:<8} {}",
                odd.nan, odd.plus_infinite, odd.minus_infinite, odd.negative
            )?;
        }
        Ok(())
    }
}
