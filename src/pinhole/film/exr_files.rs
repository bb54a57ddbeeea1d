//! Films as OpenEXR files: 32-bit scan lines, 16 of them at a time compressed by ZIP.

use super::cryptomatte::hashes;
use super::exr_channels::{ExrChannel, channels};
use super::{FileAttributes, Film, Target, write_whole};
use crate::Result;
use crate::each::Each;
use crate::scene::{LayerKind, check_workers};
use exr::block::writer::ChunksWriter;
use exr::block::{BlockIndex, UncompressedBlock};
use exr::meta::attribute::Chromaticities;
use exr::meta::header::Header;
use exr::meta::{BlockDescription, Headers};
use exr::prelude::{AttributeValue, Compression, ImageAttributes, LayerAttributes, LineOrder, Text, Vec2};
use rayon::ThreadPool;
use rayon::prelude::*;
use std::io::{self, Cursor, Seek, SeekFrom, Write};

/// The name of the attribute that maps the numbers of the layer `entity` to the names of shapes.
pub const ENTITY_NAMES: &str = "entityNames";

/// Writes the film's mean radiance and its layers as an OpenEXR file of 32-bit numbers.
///
/// Errors: the path and the error of the operating system; no partial file is left behind.
pub fn write_exr<'a>(film: &Film, target: impl Into<Target<'a>>) -> Result {
    write_exr_with(film, None, &FileAttributes::default(), target)
}

/// The same with what else the file says of the picture; beside the film, its denoised radiance, row by row, may be given.
pub fn write_exr_with<'a>(
    film: &Film,
    denoised: Option<&[Vec<f32>; 3]>,
    attributes: &FileAttributes,
    target: impl Into<Target<'a>>,
) -> Result {
    write_whole(target, |file| encode(film, denoised, attributes, file))
}

/// Encodes the film as such a file in memory.
pub fn exr_bytes(film: &Film, attributes: &FileAttributes) -> io::Result<Vec<u8>> {
    let mut bytes = Cursor::new(Vec::new());
    encode(film, None, attributes, &mut bytes)?;
    Ok(bytes.into_inner())
}

/// The bytes before the attributes: the magic number and the version.
const START: u64 = 8;

/// The fewest blocks of 16 lines that are worth threads of their own.
const MANY: usize = 8;

/// Threads to compress with; none where there is no room for them, for a picture has to be written all the same.
fn pool() -> Option<ThreadPool> {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    check_workers(threads).ok()?;
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().ok()
}

fn encode(
    film: &Film,
    denoised: Option<&[Vec<f32>; 3]>,
    attributes: &FileAttributes,
    mut out: impl Write + Seek,
) -> io::Result<()> {
    let channels = channels(film, denoised.is_some(), attributes);
    let (header, hashes) = (header(film, attributes, &channels), hashes(attributes));
    let mut listed = Vec::new();
    header.write(&mut listed).map_err(io::Error::other)?;
    exr::block::write(&mut out, Headers::from_vec(vec![header]), true, |meta, chunks| {
        let compressed = |&(number, index): &(usize, BlockIndex)| {
            let lines = index.pixel_position.y()..index.pixel_position.y() + index.pixel_size.y();
            let mut data = Vec::with_capacity(4 * channels.len() * lines.len() * film.width as usize);
            lines.for_each(|y| ExrChannel::write_line((&channels, &hashes), film, denoised, y as u32, &mut data));
            Ok((number, UncompressedBlock { index, data }.compress_to_chunk(&meta.headers)?))
        };
        let blocks: Vec<_> = meta.enumerate_ordered_header_block_indices().collect();
        let pool = if blocks.len() < MANY { None } else { pool() };
        // A few at a time, so that the file is never in memory as a whole.
        let at_once = 4 * pool.as_ref().map_or(1, ThreadPool::current_num_threads);
        blocks.chunks(at_once).try_for_each(|some| {
            let some: Vec<_> = match &pool {
                Some(pool) => pool.install(|| some.par_iter().map(compressed).collect::<exr::error::Result<_>>())?,
                None => some.iter().map(compressed).collect::<exr::error::Result<_>>()?,
            };
            some.into_iter().try_for_each(|(number, chunk)| chunks.write_chunk(number, chunk))
        })
    })
    .map_err(io::Error::other)?;
    // The library keeps attributes in a hash map, whose order differs from run to run, while their bytes do not.
    out.seek(SeekFrom::Start(START))?;
    out.write_all(&sorted(&listed))
}

/// The attributes of a header in the order of their names, but the mark by which the program knows its own files first.
fn sorted(header: &[u8]) -> Vec<u8> {
    let end_of = |at: usize| at + header[at..].iter().position(|&byte| byte == 0).unwrap_or(0);
    let (mut attributes, mut at) = (Vec::new(), 0);
    while header[at] != 0 {
        let name = end_of(at);
        let size = end_of(name + 1) + 1;
        let bytes = [0, 1, 2, 3].each(|byte| header[size + byte]);
        let next = size + 4 + u32::from_le_bytes(bytes) as usize;
        attributes.push((header[at..name] != *b"software", &header[at..name], &header[at..next]));
        at = next;
    }
    attributes.sort();
    let mut sorted: Vec<u8> = attributes.iter().flat_map(|(_, _, bytes)| bytes.iter().copied()).collect();
    sorted.push(0);
    sorted
}

fn header(film: &Film, about: &FileAttributes, channels: &[ExrChannel]) -> Header {
    let size = Vec2(film.width as usize, film.height as usize);
    // The data window within the display window, which is the whole image.
    let [width, height] = about.image.unwrap_or([film.width, film.height]);
    let mut own = LayerAttributes { software_name: Some(Text::from("pinhole")), ..LayerAttributes::default() };
    own.layer_position = Vec2(film.origin[0] as i32, film.origin[1] as i32);
    if let Some(camera) = &about.camera {
        own.world_to_camera = Some(camera.world_to_camera);
        own.world_to_normalized_device = camera.world_to_ndc;
        own.screen_window_width = camera.screen_window_width;
    }
    let mut say = |name: &str, text: String| {
        // Names of shapes are UTF-8, as Cryptomatte's specification has it; the format itself knows bytes only.
        let text = Text::from_slice_unchecked(text.as_bytes());
        own.other.insert(Text::from_slice_unchecked(name.as_bytes()), AttributeValue::Text(text));
    };
    let kinds = film.layers.first().map_or(&[][..], |layers| &layers.kinds);
    if kinds.contains(&LayerKind::Entity) {
        let entries = about.shapes.iter().enumerate().map(|(number, shape)| format!("{number} {}", shape.in_messages));
        say(ENTITY_NAMES, entries.collect::<Vec<_>>().join("; "));
    }
    if kinds.contains(&LayerKind::Cryptomatte) {
        about.cryptomatte().into_iter().for_each(|(name, text)| say(&name, text));
    }
    about.texts.iter().for_each(|(name, text)| say(&format!("pinhole/{name}"), text.clone()));
    say("pinhole/samples", samples(film));
    let shared = ImageAttributes {
        // Rec. 709 with its white, D65.
        chromaticities: Some(Chromaticities {
            red: Vec2(0.64, 0.33),
            green: Vec2(0.3, 0.6),
            blue: Vec2(0.15, 0.06),
            white: Vec2(0.3127, 0.329),
        }),
        ..ImageAttributes::with_size((width as usize, height as usize))
    };
    Header::new(Text::from(""), size, channels.iter().map(ExrChannel::description).collect())
        .with_encoding(Compression::ZIP16, BlockDescription::ScanLines, LineOrder::Increasing)
        .with_attributes(own)
        .with_shared_attributes(shared)
}

/// How many samples the pixels have.
fn samples(film: &Film) -> String {
    let counts = || film.tiles.iter().flat_map(|tile| tile.count.iter().copied());
    match (counts().min().unwrap_or(0), counts().max().unwrap_or(0)) {
        (least, most) if least == most => most.to_string(),
        (least, most) => format!("{least} to {most}"),
    }
}
