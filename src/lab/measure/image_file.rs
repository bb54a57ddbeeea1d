//! Images in files as numbers to be compared.

use super::image_error::Numbers;
use image::{DynamicImage, ImageFormat, ImageReader, Limits};
use pinhole::extract::{ImageHead, image_head, one_line, read_exr};
use pinhole::scene::{FileKind, check_memory, open_file, printable_path};
use std::io::{BufReader, Seek};
use std::path::Path;

/// The most pixels that are read: as many as a film has at most.
const MAX_PIXELS: u64 = 1 << 30;
/// An image of so many pixels with every layer that there is stays below this.
const IMAGE: FileKind = FileKind { name: "an image", max: 1 << 37 };

/// What kind of numbers a file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImageKind {
    /// Bytes after the curve, from 0 to 1.
    Png,
    /// Light, in linear floats.
    Exr,
}

impl ImageKind {
    /// The kind that a file's name tells.
    ///
    /// Errors: another ending, in one sentence.
    pub fn of(path: &Path) -> Result<Self, String> {
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        match ending.as_deref() {
            Some("png") => Ok(Self::Png),
            Some("exr") => Ok(Self::Exr),
            _ => Err(format!("cannot compare {}: the name must end in .png or .exr", printable_path(path))),
        }
    }

    fn format(self) -> ImageFormat {
        match self {
            Self::Png => ImageFormat::Png,
            Self::Exr => ImageFormat::OpenExr,
        }
    }

    /// What the numbers are, in words.
    pub fn numbers(self) -> &'static str {
        match self {
            Self::Png => "bytes as they stand in the files, 255 as 1; alpha is left out",
            Self::Exr => "linear floats",
        }
    }
}

/// Reads an image as numbers: a PNG of any depth as fractions of its largest, an EXR's channels R, G and B as they are.
///
/// Errors: the file, and what is wrong with it, in one sentence.
pub fn read_numbers(path: &Path) -> Result<Numbers, String> {
    let refused = |what: String| format!("cannot read {}: {what}", printable_path(path));
    let kind = ImageKind::of(path)?;
    let file = open_file(path, IMAGE).map_err(|error| format!("cannot compare: {error}"))?;
    let length = file.metadata.len();
    let mut reader = BufReader::new(file.file);
    let head = image_head(&mut reader, kind.format(), length).map_err(refused)?;
    let ImageHead { width, height, decoded } = head;
    if head.pixels() > MAX_PIXELS {
        return Err(refused(format!("it says it has {width} × {height} pixels, more than {MAX_PIXELS}")));
    }
    // The decoder's pixels stand beside the numbers that are made of them.
    let needed = head.pixels().saturating_mul(size_of::<[f64; 3]>() as u64).saturating_add(decoded.saturating_mul(2));
    check_memory(needed)
        .map_err(|too_little| refused(format!("it has {width} × {height} pixels, and comparing them {too_little}")))?;
    reader.rewind().map_err(|error| refused(one_line(&error)))?;
    match kind {
        ImageKind::Png => {
            let mut reader = ImageReader::with_format(reader, kind.format());
            let mut limits = Limits::default();
            limits.max_alloc = Some(MAX_PIXELS * 8);
            reader.limits(limits);
            Ok(png_numbers(reader.decode().map_err(|error| refused(one_line(&error)))?))
        }
        ImageKind::Exr => {
            let texels = read_exr(reader).map_err(refused)?;
            let pixels = texels.rgb.iter().map(|pixel| pixel.map(f64::from)).collect();
            Ok(Numbers { size: [texels.width as u32, texels.height as u32], pixels, white: None })
        }
    }
}

fn png_numbers(image: DynamicImage) -> Numbers {
    let size = [image.width(), image.height()];
    let deep = image.color().bytes_per_pixel() / image.color().channel_count() > 1;
    let pixels = if deep {
        image.into_rgb16().pixels().map(|pixel| pixel.0.map(|part| f64::from(part) / 65_535.0)).collect()
    } else {
        image.into_rgb8().pixels().map(|pixel| pixel.0.map(|part| f64::from(part) / 255.0)).collect()
    };
    Numbers { size, pixels, white: Some(1.0) }
}
