//! Films as PNG files, and as bytes for a display.

use super::develop::{SrgbBytes, sixteen_bits, straight_byte};
use super::tone::Exposed;
use super::{Curve, Film, Target, byte_from_linear, write_whole};
use crate::Result;
use crate::each::Each;
use rayon::prelude::*;
use std::io::{self, Write};

/// What a PNG has beside its pixels, and how many bits they have.
#[derive(Clone, Debug, Default)]
pub struct PngKind {
    /// Whether each component has 16 bits in place of 8.
    pub is_deep: bool,
    /// Keywords and what is said under them, after the program's name.
    pub text: Vec<(&'static str, String)>,
}

/// Writes the film as an 8-bit RGB PNG, line by line, so that memory never holds a second image.
///
/// Errors: the path and the error of the operating system; no partial file is left behind.
pub fn write_png<'a>(film: &Film, curve: Curve, target: impl Into<Target<'a>>) -> Result {
    write_png_as(film, curve, &PngKind::default(), target)
}

/// The same with text, and with as many bits as are asked for.
///
/// Errors: as for [`write_png`].
pub fn write_png_as<'a>(film: &Film, curve: Curve, kind: &PngKind, target: impl Into<Target<'a>>) -> Result {
    write_whole(target, |file| encode_png(film, curve, kind, file))
}

/// Encodes the film as an 8-bit PNG in memory.
pub fn png_bytes(film: &Film, curve: Curve) -> io::Result<Vec<u8>> {
    png_bytes_as(film, curve, &PngKind::default())
}

/// The same with text, and with as many bits as are asked for.
pub fn png_bytes_as(film: &Film, curve: Curve, kind: &PngKind) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    encode_png(film, curve, kind, &mut bytes)?;
    Ok(bytes)
}

/// Encodes the film as a PNG in memory with a custom mapping from linear values to bytes; the file's metadata still
/// names the curve.
pub fn png_bytes_by(film: &Film, curve: Curve, develop: impl Fn(f32) -> u8) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut encoder = encoder(film, curve, &mut bytes)?;
    encoder.set_depth(png::BitDepth::Eight);
    write_lines(film, encoder, |line, mean| line.extend(mean.map(&develop)))?;
    Ok(bytes)
}

/// The film as 8-bit RGBA, row by row, every pixel opaque, for a display that needs no file.
pub fn rgba_bytes(film: &Film, curve: Curve) -> Vec<u8> {
    let srgb = SrgbBytes::get();
    match curve {
        Curve::Srgb => rgba_by(film, |mean| mean.each(|linear| srgb.byte(linear))),
        Curve::Straight => rgba_by(film, |mean| mean.each(straight_byte)),
        Curve::Exposed(exposure, tone_mapping) => {
            let exposed = Exposed::of_film(film, exposure, tone_mapping);
            rgba_by(film, |mean| exposed.light(mean).each(|linear| srgb.byte(linear)))
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
        Curve::Srgb => rgba_of_by(radiance, |mean| mean.each(|linear| srgb.byte(linear))),
        Curve::Straight => rgba_of_by(radiance, |mean| mean.each(straight_byte)),
        Curve::Exposed(exposure, tone_mapping) => {
            let exposed = Exposed::of_rows(radiance, exposure, tone_mapping);
            rgba_of_by(radiance, |mean| exposed.light(mean).each(|linear| srgb.byte(linear)))
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

fn encode_png(film: &Film, curve: Curve, kind: &PngKind, out: impl Write) -> io::Result<()> {
    let mut encoder = encoder(film, curve, out)?;
    encoder.set_depth(if kind.is_deep { png::BitDepth::Sixteen } else { png::BitDepth::Eight });
    if curve != Curve::Straight {
        // For readers that do not know the chunk sRGB, as the PNG specification has it there.
        let scaled = png::ScaledFloat::from_scaled;
        encoder.set_source_gamma(scaled(45_455));
        let [white, red, green, blue] = [(31_270, 32_900), (64_000, 33_000), (30_000, 60_000), (15_000, 6_000)]
            .each(|(x, y)| (scaled(x), scaled(y)));
        encoder.set_source_chromaticities(png::SourceChromaticities { white, red, green, blue });
    }
    for (keyword, text) in &kind.text {
        let (keyword, text) = ((*keyword).to_owned(), text.clone());
        if text.is_ascii() { encoder.add_text_chunk(keyword, text)? } else { encoder.add_itxt_chunk(keyword, text)? }
    }
    let exposed = match curve {
        Curve::Exposed(exposure, tone_mapping) => Some(Exposed::of_film(film, exposure, tone_mapping)),
        Curve::Srgb | Curve::Straight => None,
    };
    let light = |mean| exposed.as_ref().map_or(mean, |exposed| exposed.light(mean));
    if kind.is_deep {
        let deep = |part| sixteen_bits(part, curve).to_be_bytes();
        write_lines(film, encoder, |line, mean| line.extend(light(mean).each(deep).as_flattened()))
    } else {
        write_lines(film, encoder, |line, mean| line.extend(light(mean).each(|part| byte_from_linear(part, curve))))
    }
}

/// An encoder of RGB that names the curve and the program.
fn encoder<W: Write>(film: &Film, curve: Curve, out: W) -> io::Result<png::Encoder<'static, W>> {
    let mut encoder = png::Encoder::new(out, film.width, film.height);
    encoder.set_color(png::ColorType::Rgb);
    if curve != Curve::Straight {
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    }
    // By this the file is known as the program's own, which it may replace.
    encoder.add_text_chunk("Software".into(), "pinhole".into())?;
    Ok(encoder)
}

fn write_lines(
    film: &Film,
    encoder: png::Encoder<'_, impl Write>,
    mut add: impl FnMut(&mut Vec<u8>, [f32; 3]),
) -> io::Result<()> {
    let mut png = encoder.write_header()?;
    let mut lines = png.stream_writer()?;
    let mut line = Vec::new();
    for y in 0..film.height {
        line.clear();
        (0..film.width).for_each(|x| add(&mut line, film.mean(x, y)));
        lines.write_all(&line)?;
    }
    lines.finish()?;
    png.finish().map_err(io::Error::from)
}
