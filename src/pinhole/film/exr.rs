use super::{Film, Target, write_whole};
use crate::Result;
use exr::prelude::{Encoding, Image, Layer, LayerAttributes, SpecificChannels, Text, WritableImage};
use std::io::{self, Cursor, Seek, Write};

/// Writes the film's mean radiance as an OpenEXR file of linear 32-bit floats.
///
/// Errors: the path and the error of the operating system; no partial file is left behind.
pub fn write_exr<'a>(film: &Film, target: impl Into<Target<'a>>) -> Result {
    write_whole(target, |file| encode(film, file))
}

/// Encodes the film as such a file in memory.
pub fn exr_bytes(film: &Film) -> io::Result<Vec<u8>> {
    let mut bytes = Cursor::new(Vec::new());
    encode(film, &mut bytes)?;
    Ok(bytes.into_inner())
}

fn encode(film: &Film, out: impl Write + Seek) -> io::Result<()> {
    let channels = SpecificChannels::rgb(|at: exr::math::Vec2<usize>| {
        let [r, g, b] = film.mean(at.x() as u32, at.y() as u32);
        (r, g, b)
    });
    let size = (film.width as usize, film.height as usize);
    // By this the file is known as the program's own, which it may replace.
    let attributes = LayerAttributes { software_name: Some(Text::from("pinhole")), ..LayerAttributes::default() };
    let image = Image::from_layer(Layer::new(size, attributes, Encoding::FAST_LOSSLESS, channels));
    image.write().non_parallel().to_buffered(out).map_err(io::Error::other)
}
