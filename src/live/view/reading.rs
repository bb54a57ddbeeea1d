//! What a film has gathered for one pixel.

use super::develop::{Picture, luminance};
use super::painted::Painted;
use super::reference::Reference;
use serde::Serialize;

/// A pixel's mean so far, and how sure it is.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reading {
    /// Its place on the film.
    pixel: [u32; 2],
    /// Its samples.
    samples: u32,
    /// The mean of red, green and blue, before any denoiser.
    mean: [f32; 3],
    /// The standard error of each; none before the second sample.
    error: Option<[f32; 3]>,
    /// The luminance of the mean, and the largest that its standard error can be.
    luminance: (f32, Option<f32>),
    /// The number that is shown in false colour.
    number: Option<f32>,
    /// The reference at this place.
    reference: Option<[f32; 3]>,
}

impl Reading {
    /// Of the pixel at a point of the picture, given as fractions of its sides.
    pub fn of(picture: &Picture<'_>, painted: &Painted, reference: Option<&Reference>, [x, y]: [f64; 2]) -> Self {
        let film = picture.film;
        let place = |part: f64, pixels: u32| ((part * f64::from(pixels)).max(0.0) as u32).min(pixels.saturating_sub(1));
        let pixel = [place(x, film.width), place(y, film.height)];
        let (tile, row) = film.place(pixel[0], pixel[1]);
        let of_size = |own: &&Reference| own.size == [film.width, film.height] && painted.column().is_none();
        let reference = reference.filter(of_size).and_then(|own| own.at(pixel));
        let (mean, error) = (film.mean(pixel[0], pixel[1]), picture.errors(pixel));
        Self {
            pixel,
            samples: film.tiles[tile].count[row],
            mean,
            error,
            luminance: (luminance(mean), error.map(luminance)),
            number: picture.number(painted, reference, pixel),
            reference,
        }
    }
}
