use super::{Curve, Film, byte_from_linear, write_whole};
use crate::Result;
use rayon::prelude::*;
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
    let (width, side) = (film.width as usize, film.tile_side.max(1) as usize);
    let mut bytes = vec![u8::MAX; 4 * width * film.height as usize];
    let across = film.width.div_ceil(film.tile_side.max(1)) as usize;
    let bands = bytes.par_chunks_mut((4 * width * side).max(1));
    bands.enumerate().for_each(|(band, lines)| {
        for number in band * across..(band + 1) * across {
            let tile = film.tiles[number].tile;
            for (row, [x, y]) in (0..tile.rows()).map(|row| (row, tile.pixel_of(row))) {
                let at = 4 * ((y - tile.y) as usize * width + x as usize);
                let mean = film.mean_in(number, row, [x, y]);
                lines[at..at + 3].copy_from_slice(&mean.map(|linear| byte_from_linear(linear, curve)));
            }
        }
    });
    bytes
}

/// The same of radiance that stands row by row.
pub fn rgba_of([red, green, blue]: &[Vec<f32>; 3], curve: Curve) -> Vec<u8> {
    let mut bytes = vec![u8::MAX; 4 * red.len()];
    bytes.par_chunks_exact_mut(4).with_min_len(4096).enumerate().for_each(|(at, pixel)| {
        let byte = |part: &[f32]| byte_from_linear(part[at], curve);
        (pixel[0], pixel[1], pixel[2]) = (byte(red), byte(green), byte(blue));
    });
    bytes
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
