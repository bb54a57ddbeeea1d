//! Films as OpenEXR files.

use super::develop::finite;
use super::{Film, Target, write_whole};
use crate::Result;
use crate::scene::LayerKind;
use exr::meta::attribute::LineOrder;
use exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Blocks, Encoding, FlatSamples, Image, Layer, LayerAttributes,
    SpecificChannels, Text, WritableImage,
};
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

/// Scan lines rather than tiles, which every reader of layers supports.
const SCAN_LINES: Encoding =
    Encoding { blocks: Blocks::ScanLines, line_order: LineOrder::Increasing, ..Encoding::FAST_LOSSLESS };

/// The name of the attribute that maps the numbers of the layer `entity` to the names of shapes.
pub const ENTITY_NAMES: &str = "entityNames";

/// Writes the film's mean radiance and its layers as a single-part OpenEXR file.
///
/// The channels of a layer are named by the layer, a dot and a letter, by which readers recognise layers (the OpenEXR
/// project's "Technical Introduction", channels and layers); they are 32-bit floats, except `entity` and `samples`,
/// which are 32-bit integers.
/// `names` are the names of the shapes in the order of their numbers.
///
/// Errors: the path and the error of the operating system; no partial file is left behind.
pub fn write_layered_exr<'a>(film: &Film, names: &[String], target: impl Into<Target<'a>>) -> Result {
    write_whole(target, |file| {
        let size = (film.width as usize, film.height as usize);
        let mut attributes =
            LayerAttributes { software_name: Some(Text::from("pinhole")), ..LayerAttributes::default() };
        let kinds = film.layers.first().map_or(&[][..], |layers| &layers.kinds);
        if kinds.contains(&LayerKind::Entity) {
            let entries: Vec<String> =
                names.iter().enumerate().map(|(number, name)| format!("{number} {name}")).collect();
            let entries =
                Text::new_or_none(entries.join("; ")).unwrap_or_else(|| Text::from("names are not plain text"));
            attributes.other.insert(Text::from(ENTITY_NAMES), AttributeValue::Text(entries));
        }
        let channels = AnyChannels::sort(channels(film, kinds).into());
        let image = Image::from_layer(Layer::new(size, attributes, SCAN_LINES, channels));
        image.write().non_parallel().to_buffered(file).map_err(io::Error::other)
    })
}

fn channels(film: &Film, kinds: &[LayerKind]) -> Vec<AnyChannel<FlatSamples>> {
    let mut channels = Vec::new();
    for (channel, name) in ["R", "G", "B"].into_iter().enumerate() {
        let values = pixels(film, |x, y| film.mean(x, y)[channel]);
        channels.push(AnyChannel::new(name, FlatSamples::F32(values)));
    }
    for &kind in kinds {
        for (channel, &name) in kind.channels().iter().enumerate() {
            channels.push(AnyChannel::new(name, samples(film, kind, channel)));
        }
    }
    channels
}

fn samples(film: &Film, kind: LayerKind, channel: usize) -> FlatSamples {
    match kind {
        LayerKind::Entity => FlatSamples::U32(pixels(film, |x, y| {
            let (tile, row) = film.place(x, y);
            film.layers[tile].entity[row]
        })),
        LayerKind::Samples => FlatSamples::U32(pixels(film, |x, y| {
            let (tile, row) = film.place(x, y);
            film.tiles[tile].count[row]
        })),
        LayerKind::Variance => FlatSamples::F32(pixels(film, |x, y| {
            let (tile, row) = film.place(x, y);
            finite(film.variance_of_mean(tile, row)[channel])
        })),
        _ => FlatSamples::F32(pixels(film, |x, y| {
            let (tile, row) = film.place(x, y);
            finite(film.layers[tile].mean(kind, channel, row))
        })),
    }
}

/// A value of every pixel, line by line from the top.
fn pixels<T>(film: &Film, value: impl Fn(u32, u32) -> T) -> Vec<T> {
    // As much as there is, and no more: a list that grows asks for up to twice its length.
    let mut values = Vec::with_capacity(film.width as usize * film.height as usize);
    for y in 0..film.height {
        values.extend((0..film.width).map(|x| value(x, y)));
    }
    values
}
