//! Images in files as numbers to be compared.

use super::image_error::Numbers;
use exr::prelude::{MetaData, ReadChannels, ReadLayers, read};
use image::{DynamicImage, ImageReader, Limits};
use std::path::Path;

/// The most pixels that are read: as many as a film has at most.
const MOST_PIXELS: u64 = 1 << 30;

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
            _ => Err(format!("cannot compare {}: the name must end in .png or .exr", path.display())),
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

/// Reads an image as numbers: a PNG of any depth as shares of its largest, an EXR's channels R, G and B as they are.
///
/// Errors: the file, and what is wrong with it, in one sentence.
pub fn read_numbers(path: &Path) -> Result<Numbers, String> {
    let refused = |what: &dyn std::fmt::Display| {
        let what = what.to_string();
        let what = what.lines().next().unwrap_or_default().trim_end_matches('.');
        format!("cannot read {}: {what}", path.display())
    };
    match ImageKind::of(path)? {
        ImageKind::Png => {
            let mut reader = ImageReader::open(path).map_err(|error| refused(&error))?;
            let mut limits = Limits::default();
            limits.max_alloc = Some(MOST_PIXELS * 8);
            reader.limits(limits);
            reader.set_format(image::ImageFormat::Png);
            Ok(png_numbers(reader.decode().map_err(|error| refused(&error))?))
        }
        ImageKind::Exr => {
            let meta = MetaData::read_from_file(path, false).map_err(|error| refused(&error))?;
            let first = meta.headers.first().map_or((0, 0).into(), |header| header.layer_size);
            if first.0 as u64 * first.1 as u64 > MOST_PIXELS {
                return Err(refused(&format!(
                    "it says it has {} × {} pixels, more than {MOST_PIXELS}",
                    first.0, first.1
                )));
            }
            exr_numbers(path).map_err(|error| refused(&error))
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

fn exr_numbers(path: &Path) -> exr::error::Result<Numbers> {
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(
            |size, _| Numbers {
                size: [size.0 as u32, size.1 as u32],
                pixels: vec![[0.0; 3]; size.area()],
                white: None,
            },
            |numbers: &mut Numbers, at, (r, g, b): (f32, f32, f32)| {
                numbers.pixels[at.1 * numbers.size[0] as usize + at.0] = [r, g, b].map(f64::from);
            },
        )
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_file(path)?;
    Ok(image.layer_data.channel_data.pixels)
}
