//! From a film to the pixels that a page is sent.

use super::colours::colour;
use super::look::{Compared, Look, ShownBy};
use super::painted::{Painted, Quantity};
use super::reference::Reference;
use pinhole::extract::luminance as luminance_of;
use pinhole::film::{Curve, Film, byte_from_linear, png_bytes_by, rgba_bytes, rgba_of};
use pinhole::scene::{Exposure, ToneMapping};
use rayon::prelude::*;
use serde::Serialize;
use std::sync::LazyLock;

/// What is added to a squared reference so that relMSE has no pole where it is black.
const RELATIVE_FLOOR: f32 = 0.01;
/// The most numbers that percentiles are taken of.
const SAMPLED: usize = 1 << 16;
/// Pixels that a worker develops at a time.
const PIXELS: usize = 4096;

/// A film and what it is a film of.
pub struct Picture<'f> {
    /// The sums.
    pub film: &'f Film,
    /// The radiance after the denoiser, where it is shown through one.
    pub denoised: Option<[Vec<f32>; 3]>,
    /// That of the scene's camera; straight for a column, whose colours are data.
    pub curve: Curve,
}

/// What the colours of false colour mean.
#[derive(Clone, Debug, Serialize)]
pub struct Scale {
    /// The numbers at the two ends.
    pub range: [f32; 2],
    /// The least and the greatest number that there is.
    pub numbers: [f32; 2],
}

/// The pixels, and what a page is told about them.
pub struct Developed {
    /// 8-bit RGBA, row by row.
    pub pixels: Vec<u8>,
    /// Pixels from left to right and from top to bottom.
    pub size: [u32; 2],
    /// What the colours mean, in false colour.
    pub scale: Option<Scale>,
    /// The mean of (x − r)² / (r² + 0.01), where there is a reference of this size.
    pub rel_mse: Option<f64>,
}

impl Picture<'_> {
    /// The radiance, or the colours of a column, line by line.
    pub fn means(&self) -> Vec<[f32; 3]> {
        match &self.denoised {
            Some([red, green, blue]) => red.iter().zip(green).zip(blue).map(|((&r, &g), &b)| [r, g, b]).collect(),
            None => self.film.means(),
        }
    }

    fn size(&self) -> [u32; 2] {
        [self.film.width, self.film.height]
    }

    /// How light becomes bytes, for this look at it.
    fn shown_by(&self, look: &Look) -> Bytes {
        let (exposure, tone) = match self.curve {
            Curve::Straight => return Bytes::By(Curve::Straight),
            Curve::Exposed(exposure, tone) => (exposure, tone),
            Curve::Srgb => Default::default(),
        };
        let stops = exposure.stops + look.exposure;
        let exposure = Exposure { stops, automatic: exposure.automatic || look.automatic };
        let factor = libm::exp2(stops) as f32;
        match look.curve {
            ShownBy::Gamma => Bytes::Gamma(factor),
            ShownBy::Linear => Bytes::Linear(factor),
            ShownBy::Scene => Bytes::exposed(exposure, tone),
            ShownBy::Tone(tone) => Bytes::exposed(exposure, tone),
        }
    }

    /// As a reader wants to see it.
    pub fn develop(&self, painted: &Painted, look: &Look, reference: Option<&Reference>) -> Developed {
        let of_size = reference.filter(|_| painted.column().is_none());
        let reference = of_size.filter(|own| own.size == self.size());
        let rel_mse = reference.map(|own| own.rel_mse(&self.means()));
        let developed = |pixels, scale| Developed { pixels, size: self.size(), scale, rel_mse };
        // A reference stays as it is while the camera moves and the picture is coarse.
        if let Some(own) = of_size.filter(|_| look.compare == Compared::Reference) {
            let quantity = own.quantity(painted);
            let (pixels, scale) = match quantity {
                Some(numbers) => false_colour(&numbers, look.range),
                None => (self.shown_by(look).of_means(&own.means), None),
            };
            return Developed { pixels, size: own.size, scale, rel_mse };
        }
        match painted {
            Painted::Picture if look.compare == Compared::Difference && reference.is_some() => {
                let others = reference.map_or(&[][..], |own| &own.means);
                let apart = |(x, r): (&[f32; 3], &[f32; 3])| [0, 1, 2].map(|part| (x[part] - r[part]).abs());
                let apart: Vec<[f32; 3]> = self.means().iter().zip(others).map(apart).collect();
                developed(self.shown_by(look).without_tone().of_means(&apart), None)
            }
            Painted::Picture | Painted::Column(_) => {
                let pixels = match (self.shown_by(look), &self.denoised) {
                    (Bytes::By(curve), Some(radiance)) => rgba_of(radiance, curve),
                    (Bytes::By(curve), None) => rgba_bytes(self.film, curve),
                    (by, _) => by.of_means(&self.means()),
                };
                developed(pixels, None)
            }
            Painted::Quantity(_) | Painted::Component(..) => {
                let numbers = self.numbers(painted, reference);
                let (pixels, scale) = false_colour(&numbers, look.range);
                developed(pixels, scale)
            }
        }
    }

    /// The number of each pixel that is shown in false colour; NaN where there is none.
    fn numbers(&self, painted: &Painted, reference: Option<&Reference>) -> Vec<f32> {
        let means = self.means();
        match painted {
            Painted::Quantity(quantity @ (Quantity::StandardError | Quantity::Samples)) => {
                let width = self.film.width.max(1);
                let number = |at: usize| self.counted(*quantity, [at as u32 % width, at as u32 / width]);
                (0..means.len()).into_par_iter().map(number).collect()
            }
            Painted::Quantity(quantity) => {
                let other = |at: usize| reference.and_then(|own| own.means.get(at)).copied();
                let numbers = means.par_iter().enumerate().map(|(at, mean)| of_mean(*quantity, *mean, other(at)));
                numbers.collect()
            }
            _ => means.par_iter().map(|&mean| component(mean)).collect(),
        }
    }

    fn counted(&self, quantity: Quantity, [x, y]: [u32; 2]) -> f32 {
        let (tile, row) = self.film.place(x, y);
        let count = self.film.tiles[tile].count[row];
        match quantity {
            Quantity::Samples => count as f32,
            _ => self.errors([x, y]).map_or(f32::NAN, luminance),
        }
    }

    /// The standard errors of a pixel's means; none before its second sample, or where no moments are kept.
    pub fn errors(&self, [x, y]: [u32; 2]) -> Option<[f32; 3]> {
        let (tile, row) = self.film.place(x, y);
        let is_known = !self.film.moments.is_empty() && self.film.tiles[tile].count[row] > 1;
        is_known.then(|| self.film.variance_of_mean(tile, row).map(|variance| variance.max(0.0).sqrt() as f32))
    }

    /// The number that false colour shows of a pixel.
    pub fn number(&self, painted: &Painted, reference: Option<[f32; 3]>, [x, y]: [u32; 2]) -> Option<f32> {
        let mean = self.film.mean(x, y);
        let number = match painted {
            Painted::Quantity(quantity @ (Quantity::StandardError | Quantity::Samples)) => {
                self.counted(*quantity, [x, y])
            }
            Painted::Quantity(quantity) => of_mean(*quantity, mean, reference),
            Painted::Component(..) => component(mean),
            Painted::Picture | Painted::Column(_) => return None,
        };
        (!number.is_nan()).then_some(number)
    }
}

/// A file of the pixels as they are seen.
///
/// Errors: it cannot be encoded.
pub fn png_of(developed: &Developed) -> std::io::Result<Vec<u8>> {
    let [width, height] = developed.size;
    let mut film = Film::new(width, height, 32);
    for tile in &mut film.tiles {
        for row in 0..tile.tile.rows() {
            let [x, y] = tile.tile.pixel_of(row);
            let at = 4 * (y as usize * width as usize + x as usize);
            tile.add(row, [0, 1, 2].map(|part| f32::from(developed.pixels[at + part])));
        }
    }
    png_bytes_by(&film, Curve::Srgb, |byte| byte as u8)
}

/// The relative luminance of linear light.
pub fn luminance(rgb: [f32; 3]) -> f32 {
    luminance_of(rgb.map(f64::from)) as f32
}

/// What a view of a component has put on the film: the mean over the samples that have a number.
fn component([above, below, counted]: [f32; 3]) -> f32 {
    if counted > 0.0 { (above - below) / counted } else { f32::NAN }
}

/// A number of a pixel's mean.
pub fn of_mean(quantity: Quantity, mean: [f32; 3], reference: Option<[f32; 3]>) -> f32 {
    match (quantity, reference) {
        (Quantity::Luminance, _) => luminance(mean),
        (Quantity::Channel(part), _) => mean[part],
        (Quantity::Difference, Some(other)) => luminance(mean) - luminance(other),
        (Quantity::RelativeSquare, Some(other)) => relative_square(mean, other),
        _ => f32::NAN,
    }
}

/// What a pixel adds to relMSE.
pub fn relative_square(x: [f32; 3], r: [f32; 3]) -> f32 {
    let part = |part: usize| (x[part] - r[part]) * (x[part] - r[part]) / (r[part] * r[part] + RELATIVE_FLOOR);
    (part(0) + part(1) + part(2)) / 3.0
}

/// The light that rounds to each byte's successor, by a power of 1 / 2.2.
static GAMMA: LazyLock<[f32; 255]> =
    LazyLock::new(|| std::array::from_fn(|byte| libm::pow((byte as f64 + 0.5) / 255.0, 2.2) as f32));

/// How light becomes bytes.
#[derive(Clone, Copy)]
enum Bytes {
    By(Curve),
    /// Times this, and by a power of 1 / 2.2.
    Gamma(f32),
    /// Times this.
    Linear(f32),
}

impl Bytes {
    fn exposed(exposure: Exposure, tone: ToneMapping) -> Self {
        let is_plain = (exposure, tone) == Default::default();
        Self::By(if is_plain { Curve::Srgb } else { Curve::Exposed(exposure, tone) })
    }

    /// The same for the distance of two pictures, which has no white to be brought into range.
    fn without_tone(self) -> Self {
        match self {
            Self::By(Curve::Exposed(exposure, _)) => {
                Self::exposed(Exposure { automatic: false, ..exposure }, ToneMapping::None)
            }
            own => own,
        }
    }

    fn of_means(self, means: &[[f32; 3]]) -> Vec<u8> {
        match self {
            Self::By(curve) => rgba_of(&[0, 1, 2].map(|part| means.iter().map(|mean| mean[part]).collect()), curve),
            Self::Gamma(factor) => {
                let byte = |light: f32| GAMMA.partition_point(|&step| step <= light * factor) as u8;
                rgba(means, |mean| mean.map(byte))
            }
            Self::Linear(factor) => {
                rgba(means, |mean| mean.map(|light| byte_from_linear(light * factor, Curve::Straight)))
            }
        }
    }
}

fn rgba<T: Copy + Sync>(of: &[T], bytes: impl Fn(T) -> [u8; 3] + Sync) -> Vec<u8> {
    let mut pixels = vec![u8::MAX; 4 * of.len()];
    pixels.par_chunks_mut(4 * PIXELS).zip(of.par_chunks(PIXELS)).for_each(|(pixels, of)| {
        for (pixel, &own) in pixels.chunks_exact_mut(4).zip(of) {
            pixel[..3].copy_from_slice(&bytes(own));
        }
    });
    pixels
}

fn false_colour(numbers: &[f32], range: Option<[f32; 2]>) -> (Vec<u8>, Option<Scale>) {
    let mut sampled: Vec<f32> = numbers.iter().step_by(numbers.len().div_ceil(SAMPLED).max(1)).copied().collect();
    sampled.retain(|number| number.is_finite());
    sampled.sort_unstable_by(f32::total_cmp);
    let at = |part: f64| sampled.get(((sampled.len().max(1) - 1) as f64 * part).round() as usize).copied();
    let ends = |low, high| [at(low).unwrap_or(0.0), at(high).unwrap_or(0.0)];
    let [least, most] = ends(0.01, 0.99);
    let range = range.unwrap_or([least, if most > least { most } else { least + least.abs().max(1.0) / 1024.0 }]);
    let found = numbers.iter().filter(|number| number.is_finite());
    let [low, high] = found.fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], &own| [low.min(own), high.max(own)]);
    let numbers_of = if low <= high { [low, high] } else { [0.0; 2] };
    (rgba(numbers, |number| colour(number, range)), Some(Scale { range, numbers: numbers_of }))
}
