//! Films as PNG files, and as bytes for a display.

use super::develop::{SrgbBytes, straight_byte};
use super::tone::Exposed;
use super::{Curve, Film, Target, byte_from_linear, write_whole};
use crate::Result;
use rayon::prelude::*;
use std::io::{self, Write};

/// Writes the film as an 8-bit RGB PNG, line by line, so that memory never holds a second image.
///
/// Errors: the path and the error of the operating system; no partial file is left behind.
pub fn write_png<'a>(film: &Film, curve: Curve, target: impl Into<Target<'a>>) -> Result {
    write_whole(target, |file| encode_png(film, curve, file))
}

/// Encodes the film as a PNG in memory.
pub fn png_bytes(film: &Film, curve: Curve) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    encode_png(film, curve, &mut bytes)?;
    Ok(bytes)
}

/// Encodes the film as a PNG in memory with a custom mapping from linear values to bytes; the file's metadata still
/// names the curve.
pub fn png_bytes_by(film: &Film, curve: Curve, develop: impl Fn(f32) -> u8) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    encode_png_by(film, curve, |mean| mean.map(&develop), &mut bytes)?;
    Ok(bytes)
}

/// The film as 8-bit RGBA, row by row, every pixel opaque, for a display that needs no file.
pub fn rgba_bytes(film: &Film, curve: Curve) -> Vec<u8> {
    let srgb = SrgbBytes::get();
    match curve {
        Curve::Srgb => rgba_by(film, |mean| mean.map(|linear| srgb.byte(linear))),
        Curve::Straight => rgba_by(film, |mean| mean.map(straight_byte)),
        Curve::Exposed(exposure, tone_mapping) => {
            let exposed = Exposed::of_film(film, exposure, tone_mapping);
            rgba_by(film, |mean| exposed.light(mean).map(|linear| srgb.byte(linear)))
        }
    }
}

fn rgba_by(film: &Film, bytes_of: impl Fn([f32; 3]) -> [u8; 3] + Sync) -> Vec<u8> {
    let mut bytes = vec![u8::MAX; 4 * film.width as usize * film.height as usize];
    let (bands, pixels) = film.bands();
    bytes.par_chunks_mut(4 * pixels).zip(bands).for_each(|(pixels, tiles)| {
        for tile in tiles {
            film.for_each_mean(tile, |at, mean| pixels[4 * at..4 * at + 3].copy_from_slice(&bytes_of(mean)));
        }
    });
    bytes
}

/// The same of radiance that stands row by row.
pub fn rgba_of(radiance: &[Vec<f32>; 3], curve: Curve) -> Vec<u8> {
    let srgb = SrgbBytes::get();
    match curve {
        Curve::Srgb => rgba_of_by(radiance, |mean| mean.map(|linear| srgb.byte(linear))),
        Curve::Straight => rgba_of_by(radiance, |mean| mean.map(straight_byte)),
        Curve::Exposed(exposure, tone_mapping) => {
            let exposed = Exposed::of_rows(radiance, exposure, tone_mapping);
            rgba_of_by(radiance, |mean| exposed.light(mean).map(|linear| srgb.byte(linear)))
        }
    }
}

fn rgba_of_by([red, green, blue]: &[Vec<f32>; 3], bytes_of: impl Fn([f32; 3]) -> [u8; 3] + Sync) -> Vec<u8> {
    const PIXELS: usize = 4096;
    let mut bytes = vec![u8::MAX; 4 * red.len()];
    let parts = red.par_chunks(PIXELS).zip(green.par_chunks(PIXELS)).zip(blue.par_chunks(PIXELS));
    bytes.par_chunks_mut(4 * PIXELS).zip(parts).for_each(|(pixels, ((red, green), blue))| {
        for (((pixel, &r), &g), &b) in pixels.chunks_exact_mut(4).zip(red).zip(green).zip(blue) {
            pixel[..3].copy_from_slice(&bytes_of([r, g, b]));
        }
    });
    bytes
}

fn encode_png(film: &Film, curve: Curve, out: impl Write) -> io::Result<()> {
    match curve {
        Curve::Exposed(exposure, tone_mapping) => {
            let (exposed, srgb) = (Exposed::of_film(film, exposure, tone_mapping), SrgbBytes::get());
            encode_png_by(film, curve, |mean| exposed.light(mean).map(|linear| srgb.byte(linear)), out)
        }
        _ => encode_png_by(film, curve, |mean| mean.map(|linear| byte_from_linear(linear, curve)), out),
    }
}

fn encode_png_by(film: &Film, curve: Curve, develop: impl Fn([f32; 3]) -> [u8; 3], out: impl Write) -> io::Result<()> {
    let mut encoder = png::Encoder::new(out, film.width, film.height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    if curve != Curve::Straight {
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    }
    // By this the file is known as the program's own, which it may replace.
    encoder.add_text_chunk("Software".into(), "pinhole".into())?;
    let mut png = encoder.write_header()?;
    let mut lines = png.stream_writer()?;
    let mut line = Vec::with_capacity(film.width as usize * 3);
    for y in 0..film.height {
        line.clear();
        for x in 0..film.width {
            line.extend(develop(film.mean(x, y)));
        }
        lines.write_all(&line)?;
    }
    lines.finish()?;
    png.finish().map_err(io::Error::from)
}
