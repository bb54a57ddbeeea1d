use super::{Curve, Film, byte_from_linear, write_whole};
use crate::Result;
use std::io::{self, Write};
use std::path::Path;

/// Writes the film as an 8-bit RGB PNG, line by line, so that memory never holds a second image.
///
/// Errors: the path and the error of the operating system; no partial file is left behind.
pub fn write_png(film: &Film, curve: Curve, path: &Path) -> Result {
    write_whole(path, |file| encode(film, curve, |linear| byte_from_linear(linear, curve), file))
}

/// Encodes the film as a PNG in memory.
pub fn png_bytes(film: &Film, curve: Curve) -> io::Result<Vec<u8>> {
    png_bytes_by(film, curve, |linear| byte_from_linear(linear, curve))
}

/// Encodes the film as a PNG in memory with a custom mapping from linear values to bytes; the file's metadata still
/// names the curve.
pub fn png_bytes_by(film: &Film, curve: Curve, develop: impl Fn(f32) -> u8) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    encode(film, curve, develop, &mut bytes)?;
    Ok(bytes)
}

/// The film as 8-bit RGBA, row by row, every pixel opaque, for a display that needs no file.
pub fn rgba_bytes(film: &Film, curve: Curve) -> Vec<u8> {
    let pixels = (0..film.height).flat_map(|y| (0..film.width).map(move |x| film.mean(x, y)));
    let bytes = pixels.flat_map(|[r, g, b]| {
        let [r, g, b] = [r, g, b].map(|linear| byte_from_linear(linear, curve));
        [r, g, b, u8::MAX]
    });
    bytes.collect()
}

fn encode(film: &Film, curve: Curve, develop: impl Fn(f32) -> u8, out: impl Write) -> io::Result<()> {
    let mut encoder = png::Encoder::new(out, film.width, film.height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    if curve == Curve::Srgb {
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    }
    let mut png = encoder.write_header()?;
    let mut lines = png.stream_writer()?;
    let mut line = Vec::with_capacity(film.width as usize * 3);
    for y in 0..film.height {
        line.clear();
        for x in 0..film.width {
            line.extend(film.mean(x, y).map(&develop));
        }
        lines.write_all(&line)?;
    }
    lines.finish()?;
    png.finish().map_err(io::Error::from)
}
