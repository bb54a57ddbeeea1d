//! The size that an image file states, read before memory is allocated.
//!
//! A file of a few hundred bytes can state that it has 10⁹ pixels.

use exr::meta::header::Header;
use exr::prelude::{Compression, MetaData};
use image::{ImageDecoder, ImageFormat, ImageReader};
use std::fmt::Display;
use std::io::{BufRead, Seek};

/// The greatest number of bytes that a byte of deflate can expand to.
const DEFLATE: u64 = 1032;

/// The size of an image, and the memory that decoding it takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ImageHead {
    /// Pixels from left to right.
    pub width: u64,
    /// Pixels from top to bottom.
    pub height: u64,
    /// The size of its pixels as they come out of the decoder, in bytes.
    pub decoded: u64,
}

impl ImageHead {
    /// Width times height.
    pub fn pixels(&self) -> u64 {
        self.width.saturating_mul(self.height)
    }
}

/// Reads the header of an image file of `length` bytes; for an EXR of several parts, that of the largest part.
///
/// Errors: the file is damaged, has no pixels, or states more of them than so few bytes can hold.
pub fn image_head(reader: impl BufRead + Seek, format: ImageFormat, length: u64) -> Result<ImageHead, String> {
    let head = match format {
        ImageFormat::OpenExr => exr_head(reader, length)?,
        _ => {
            let reader = ImageReader::with_format(reader, format);
            let decoder = reader.into_decoder().map_err(|error| one_line(&error))?;
            let (width, height) = decoder.dimensions();
            let head = ImageHead { width: width.into(), height: height.into(), decoded: decoder.total_bytes() };
            let min = match format {
                // Every line of a Radiance file begins with four bytes.
                ImageFormat::Hdr => 4 * head.height,
                // A pixel of a PNG has one bit at least.
                _ => head.pixels() / 8 / DEFLATE,
            };
            check_length(&head, min, length)?;
            head
        }
    };
    if head.pixels() == 0 { Err("it has no pixels".into()) } else { Ok(head) }
}

fn exr_head(reader: impl BufRead, length: u64) -> Result<ImageHead, String> {
    let meta = MetaData::read_from_buffered(reader, false).map_err(|error| explained(&error))?;
    let (mut largest, mut min) = (ImageHead { width: 0, height: 0, decoded: 0 }, 0_u64);
    for header in &meta.headers {
        let (width, height) = (header.layer_size.0 as u64, header.layer_size.1 as u64);
        let head = ImageHead { width, height, decoded: bytes_of(header) };
        // Each block has an entry of 8 bytes in a table, and at least 8 bytes before its pixels.
        let blocks = (header.chunk_count as u64).saturating_mul(16);
        min = min.saturating_add((head.decoded / most_a_byte(header.compression)).max(blocks));
        check_length(&head, min, length)?;
        if head.pixels() >= largest.pixels() {
            largest = head;
        }
    }
    Ok(largest)
}

/// The size of a part's pixels before compression, in bytes, without lower-resolution levels.
fn bytes_of(header: &Header) -> u64 {
    let samples = |channel: &exr::prelude::ChannelDescription| {
        let along = |pixels: usize, step: usize| (pixels / step.max(1)) as u64;
        let [width, height] = [(header.layer_size.0, channel.sampling.0), (header.layer_size.1, channel.sampling.1)]
            .map(|(pixels, step)| along(pixels, step));
        width.saturating_mul(height).saturating_mul(channel.sample_type.bytes_per_sample() as u64)
    };
    header.channels.list.iter().map(samples).fold(0, u64::saturating_add)
}

/// The greatest number of pixel bytes that a byte of the file can represent.
fn most_a_byte(compression: Compression) -> u64 {
    match compression {
        Compression::Uncompressed => 1,
        Compression::RLE => 128,
        Compression::B44 | Compression::B44A => 16,
        // Deflate over three of four bytes.
        Compression::PXR24 => DEFLATE * 4 / 3,
        Compression::ZIP1 | Compression::ZIP16 | Compression::PIZ => DEFLATE,
        // A cosine transform of a constant block leaves next to nothing, so no bound is known.
        _ => u64::MAX,
    }
}

fn check_length(head: &ImageHead, min: u64, length: u64) -> Result<(), String> {
    let ImageHead { width, height, .. } = head;
    if min <= length {
        return Ok(());
    }
    Err(format!("it says it has {width} × {height} pixels, which do not fit into its {length} bytes"))
}

/// A message of the library for EXRs, in words that say what to do where it has none.
pub fn explained(error: &dyn Display) -> String {
    let line = one_line(error);
    match () {
        () if line.contains("subsampling") => {
            "its colours are stored at half the resolution (luminance and chroma), which is not read; save it with R, G and \
             B"
            .into()
        }
        () if line.contains("deep") => "it holds deep data, which is not read; save it flattened".into(),
        () => line,
    }
}

/// A library's message as a part of one sentence.
pub fn one_line(what: &dyn Display) -> String {
    let what = what.to_string();
    let line = what.lines().next().unwrap_or_default().trim_end_matches('.').replace(". ", ", ");
    crate::scene::printable(&line, 120)
}
