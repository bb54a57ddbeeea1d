//! Image files → texels in linear light.

use super::linear_from_srgb;
use crate::scene::{EmbeddedFiles, Refusal, SceneFolder};
use bevy_ecs::prelude::*;
use exr::prelude::{MetaData, ReadChannels, ReadLayers, read};
use image::{DynamicImage, ImageFormat, ImageReader, Limits};
use std::fs;
use std::io::Cursor;
use std::path::Path;

/// The most texels of one image; with its smaller copies they take 16 bytes each.
const MOST_TEXELS: u64 = 1 << 24;

/// An image in linear light, its rows from top to bottom.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Texels {
    /// Texels from left to right.
    pub width: usize,
    /// Texels from top to bottom.
    pub height: usize,
    /// Red, green, blue, row by row.
    pub rgb: Vec<[f32; 3]>,
}

impl Texels {
    /// A single texel.
    pub fn single(rgb: [f32; 3]) -> Self {
        Self { width: 1, height: 1, rgb: vec![rgb] }
    }
}

/// Which numbers an image may hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Numbers {
    /// Shares of light, from 0 to 1.
    Shares,
    /// Radiance: finite, at least 0.
    Radiance,
}

impl Numbers {
    fn endings(self) -> (&'static [&'static str], &'static str) {
        match self {
            Self::Shares => (&["png", "hdr", "exr"], "it must be the name of a .png, .hdr or .exr file"),
            Self::Radiance => (&["hdr", "exr"], "it must be the name of a .hdr or .exr file"),
        }
    }

    fn accepts(self, part: f32) -> bool {
        match self {
            Self::Shares => (0.0..=1.0).contains(&part),
            Self::Radiance => (0.0..f32::INFINITY).contains(&part),
        }
    }

    fn range(self) -> &'static str {
        match self {
            Self::Shares => "from 0 to 1, for a surface gives back no more than it gets",
            Self::Radiance => "finite and at least 0",
        }
    }
}

/// Reads the image file that a component names.
///
/// Errors: another ending, a file that is not there, cannot be read or is too large, a texel that is out of range.
pub(super) fn read_texels(scene: &World, who: &str, file: &str, numbers: Numbers) -> Result<Texels, Refusal> {
    let refused = |accepted: String| Refusal::new(who, "file", shortened(&format!("{file:?}")), accepted);
    let path = SceneFolder::path_of(scene, file);
    let (endings, accepted) = numbers.endings();
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase()).unwrap_or_default();
    if !endings.contains(&ending.as_str()) {
        return Err(refused(accepted.into()));
    }
    let texels = match EmbeddedFiles::find(scene, file) {
        Some(bytes) => decoded(bytes, &ending),
        None => read_file(&path).and_then(|bytes| {
            let shown = shortened(&path.display().to_string());
            decoded(&bytes, &ending).map_err(|problem| format!("{shown} cannot be read: {problem}"))
        }),
    };
    let texels = texels.map_err(refused)?;
    let wrong = |texel: &[f32; 3]| !texel.iter().all(|&part| numbers.accepts(part));
    if let Some(first) = texels.rgb.iter().position(wrong) {
        let count = texels.rgb.iter().filter(|texel| wrong(texel)).count();
        let [r, g, b] = texels.rgb[first];
        let (x, y) = (first % texels.width, first / texels.width);
        let held = format!("it holds {count} other texels, the first at {x}, {y}: ({r}, {g}, {b})");
        return Err(refused(format!("each part of a texel must be {}, and {held}", numbers.range())));
    }
    Ok(texels)
}

fn read_file(path: &Path) -> Result<Vec<u8>, String> {
    let shown = shortened(&path.display().to_string());
    let metadata = fs::metadata(path).map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound => format!("there is no file {shown}"),
        _ => format!("{shown} cannot be read: {}", one_line(&error)),
    })?;
    if !metadata.is_file() {
        return Err(format!("{shown} is no ordinary file"));
    }
    fs::read(path).map_err(|error| format!("{shown} cannot be read: {}", one_line(&error)))
}

fn decoded(bytes: &[u8], ending: &str) -> Result<Texels, String> {
    match ending {
        "exr" => read_exr(bytes),
        "hdr" => read_by_image(bytes, ImageFormat::Hdr),
        _ => read_by_image(bytes, ImageFormat::Png),
    }
}

/// What a library says, as a part of one sentence.
fn one_line(what: &dyn std::fmt::Display) -> String {
    let what = what.to_string();
    let line = what.lines().next().unwrap_or_default().trim_end_matches('.').replace(". ", ", ");
    shortened(&line)
}

/// The end of a long text, where a path is told from another.
pub(super) fn shortened(text: &str) -> String {
    const MOST_LETTERS: usize = 80;
    let letters = text.chars().count();
    let end = text.chars().skip(letters.saturating_sub(MOST_LETTERS));
    let end: String = end.map(|letter| if letter.is_control() { '?' } else { letter }).collect();
    if letters > MOST_LETTERS { format!("…{end}") } else { end }
}

fn check_size(width: u64, height: u64) -> Result<(), String> {
    let texels = width.checked_mul(height);
    match texels {
        Some(1..=MOST_TEXELS) => Ok(()),
        Some(0) => Err("it has no texels".into()),
        _ => Err(format!("it has {width} × {height} texels, and an image may have {MOST_TEXELS}")),
    }
}

fn read_by_image(bytes: &[u8], format: ImageFormat) -> Result<Texels, String> {
    let reader = || ImageReader::with_format(Cursor::new(bytes), format);
    let (width, height) = reader().into_dimensions().map_err(|error| one_line(&error))?;
    check_size(width.into(), height.into())?;
    let mut reader = reader();
    let mut limits = Limits::default();
    limits.max_alloc = Some(MOST_TEXELS * 16);
    reader.limits(limits);
    let image = reader.decode().map_err(|error| one_line(&error))?;
    Ok(Texels { width: width as usize, height: height as usize, rgb: linear(image) })
}

/// Whole numbers are sRGB, floats are linear; alpha is left out.
fn linear(image: DynamicImage) -> Vec<[f32; 3]> {
    let bytes_a_part = image.color().bytes_per_pixel() / image.color().channel_count();
    match bytes_a_part {
        1 => {
            let light: Vec<f32> = (0..=255).map(|byte| linear_from_srgb(f64::from(byte) / 255.0) as f32).collect();
            image.into_rgb8().pixels().map(|texel| texel.0.map(|byte| light[usize::from(byte)])).collect()
        }
        2 => {
            let light = |part: u16| linear_from_srgb(f64::from(part) / 65_535.0) as f32;
            image.into_rgb16().pixels().map(|texel| texel.0.map(light)).collect()
        }
        _ => image.into_rgb32f().pixels().map(|texel| texel.0).collect(),
    }
}

fn read_exr(bytes: &[u8]) -> Result<Texels, String> {
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(|error| one_line(&error))?;
    for header in &meta.headers {
        check_size(header.layer_size.0 as u64, header.layer_size.1 as u64)?;
    }
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(
            |size, _| Texels { width: size.0, height: size.1, rgb: vec![[0.0; 3]; size.area()] },
            |texels: &mut Texels, at, (r, g, b): (f32, f32, f32)| {
                let row = at.1 * texels.width;
                texels.rgb[row + at.0] = [r, g, b];
            },
        )
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(|error| one_line(&error))?;
    Ok(image.layer_data.channel_data.pixels)
}
