//! Image files → texels in linear light.

use super::image_head::{ImageHead, image_head, one_line};
use super::{Pyramid, linear_from_srgb};
use crate::scene::{
    EmbeddedFiles, FileStore, IMAGE_FILE, ModelFiles, SceneError, SceneFolder, TooLittleMemory, Undecoded,
    check_memory, open_file, printable, printable_path,
};
use bevy_ecs::prelude::*;
use exr::prelude::{ReadChannels, ReadLayers, read};
use image::{DynamicImage, ImageFormat, ImageReader, Limits};
use std::collections::BTreeSet;
use std::io::{BufRead, BufReader, Cursor, Seek};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The greatest number of texels of one image.
const MOST_TEXELS: u64 = 1 << 24;
/// The memory of a texel with its part of the pyramid above it, in bytes.
const BYTES_A_TEXEL: u64 = 16;

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

    /// Their memory, in bytes.
    pub fn bytes(&self) -> usize {
        self.rgb.len() * size_of::<[f32; 3]>()
    }
}

/// The range of values that an image may hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Numbers {
    /// Reflectances, from 0 to 1.
    Reflectances,
    /// Radiance: finite, at least 0.
    Radiance,
    /// Normals: from 0 to 1, blue more than a half.
    Normals,
    /// Numbers that are no light, such as roughness: from 0 to 1.
    Factors,
    /// Emission: finite, at least 0.
    Emission,
}

impl Numbers {
    fn endings(self) -> (&'static [&'static str], &'static str) {
        match self {
            Self::Reflectances | Self::Normals | Self::Factors | Self::Emission => {
                (&["png", "jpg", "jpeg", "hdr", "exr"], "it must be the name of a .png, .jpg, .hdr or .exr file")
            }
            Self::Radiance => (&["hdr", "exr"], "it must be the name of a .hdr or .exr file"),
        }
    }

    fn accepts(self, texel: [f32; 3]) -> bool {
        let within = |part: &f32| match self {
            Self::Reflectances | Self::Normals | Self::Factors => (0.0..=1.0).contains(part),
            Self::Radiance | Self::Emission => (0.0..f32::INFINITY).contains(part),
        };
        texel.iter().all(within) && (self != Self::Normals || texel[2] > 0.5)
    }

    fn range(self) -> &'static str {
        match self {
            Self::Reflectances => "from 0 to 1, for a surface gives back no more than it gets",
            Self::Radiance | Self::Emission => "finite and at least 0",
            Self::Factors => "from 0 to 1",
            Self::Normals => "from 0 to 1, and blue more than a half, for a normal points out of the surface",
        }
    }
}

/// The images of textures, which are reflectances, those of environments, which are radiance, and maps.
static TEXTURES: FileStore<Pyramid> = FileStore::new();
static BACKGROUNDS: FileStore<Texels> = FileStore::new();
static NORMAL_MAPS: FileStore<Texels> = FileStore::new();
static FACTORS: FileStore<Pyramid> = FileStore::new();
static EMISSIONS: FileStore<Pyramid> = FileStore::new();

/// The image of a texture, with its pyramid.
///
/// Errors: another file name extension, a file that is missing, unreadable or too large, a texel out of range.
pub(super) fn texture_image(scene: &World, who: &str, file: &str) -> Result<Arc<Pyramid>, SceneError> {
    decoded(&TEXTURES, scene, who, file, Numbers::Reflectances, with_pyramid)
}

/// The image of metallic and roughness, its numbers as they are in the file, with its pyramid.
///
/// Errors: the same.
pub(super) fn factor_image(scene: &World, who: &str, file: &str) -> Result<Arc<Pyramid>, SceneError> {
    decoded(&FACTORS, scene, who, file, Numbers::Factors, with_pyramid)
}

/// The image of an emission in linear light, with its pyramid.
///
/// Errors: the same.
pub(super) fn emission_image(scene: &World, who: &str, file: &str) -> Result<Arc<Pyramid>, SceneError> {
    decoded(&EMISSIONS, scene, who, file, Numbers::Emission, with_pyramid)
}

/// The image of an environment.
///
/// Errors: the same as those of a texture.
pub(super) fn background_image(scene: &World, who: &str, file: &str) -> Result<Arc<Texels>, SceneError> {
    decoded(&BACKGROUNDS, scene, who, file, Numbers::Radiance, alone)
}

/// The image of a normal map, its parts as they are in the file.
///
/// Errors: the same, and a texel whose normal does not point out of the surface.
pub(super) fn normal_map_image(scene: &World, who: &str, file: &str) -> Result<Arc<Texels>, SceneError> {
    decoded(&NORMAL_MAPS, scene, who, file, Numbers::Normals, alone)
}

/// An image with its pyramid, and the memory of both in bytes.
fn with_pyramid(texels: Texels) -> (Pyramid, usize) {
    let pyramid = Pyramid::on(texels);
    let bytes = pyramid.bytes();
    (pyramid, bytes)
}

/// An image without a pyramid, and its memory in bytes.
fn alone(texels: Texels) -> (Texels, usize) {
    let bytes = texels.bytes();
    (texels, bytes)
}

/// A file's name as error messages show it.
pub(super) fn shown_name(file: &str) -> String {
    format!("\"{}\"", printable(file, 80))
}

fn decoded<T>(
    store: &FileStore<T>,
    scene: &World,
    who: &str,
    file: &str,
    numbers: Numbers,
    prepared: impl FnOnce(Texels) -> (T, usize),
) -> Result<Arc<T>, SceneError> {
    let refused = |accepted: String| SceneError::new(who, "file", shown_name(file), accepted);
    let path = SceneFolder::path_of(scene, file);
    let (endings, accepted) = numbers.endings();
    let format = format_of(&path).filter(|(ending, _)| endings.contains(ending));
    let (_, format) = format.ok_or_else(|| refused(accepted.into()))?;
    let decode = |bytes: &[u8]| {
        let texels = texels(bytes, format, numbers)
            .map_err(|problem| format!("{} cannot be read: {problem}", printable_path(&path)))?;
        check_numbers(&texels, numbers)?;
        Ok(prepared(texels))
    };
    if let Some(bytes) = ModelFiles::find(scene, file) {
        return store.of_bytes(Path::new(file), &bytes, decode).map_err(refused);
    }
    if let Some(bytes) = EmbeddedFiles::find(scene, file) {
        return decode(bytes).map(|(image, _)| Arc::new(image)).map_err(refused);
    }
    store.get(&path, IMAGE_FILE, decode).map_err(|why| match why {
        Undecoded::File(error) => refused(error.to_string()),
        Undecoded::Content(problem) => refused(problem),
    })
}

/// Checks the memory that all texture files together need, except for those decoded already.
///
/// Errors: the number of files, and the memory they need.
pub(super) fn check_memory_of_textures<'f>(
    scene: &World,
    files: impl Iterator<Item = &'f str>,
) -> Result<(), (usize, TooLittleMemory)> {
    let paths: BTreeSet<PathBuf> = files.map(|file| SceneFolder::path_of(scene, file)).collect();
    // An unreadable file is reported by its own name later.
    let bytes = |path: &PathBuf| -> Option<u64> {
        let (_, format) = format_of(path)?;
        let file = open_file(path, IMAGE_FILE).ok()?;
        let length = file.metadata.len();
        let is_there = TEXTURES.holds(path, &file.metadata);
        let head = image_head(BufReader::new(file.file), format, length).ok()?;
        (!is_there && head.pixels() <= MOST_TEXELS).then(|| head.pixels() * BYTES_A_TEXEL)
    };
    let needed = paths.iter().filter_map(bytes).sum();
    check_memory(needed).map_err(|too_little| (paths.len(), too_little))
}

fn format_of(path: &Path) -> Option<(&'static str, ImageFormat)> {
    let ending = path.extension()?.to_string_lossy().to_lowercase();
    let formats = [
        ("png", ImageFormat::Png),
        ("jpg", ImageFormat::Jpeg),
        ("jpeg", ImageFormat::Jpeg),
        ("hdr", ImageFormat::Hdr),
        ("exr", ImageFormat::OpenExr),
    ];
    formats.into_iter().find(|(own, _)| *own == ending)
}

fn check_numbers(texels: &Texels, numbers: Numbers) -> Result<(), String> {
    let wrong = |texel: &[f32; 3]| !numbers.accepts(*texel);
    let Some(first) = texels.rgb.iter().position(wrong) else { return Ok(()) };
    let count = texels.rgb.iter().filter(|texel| wrong(texel)).count();
    let [r, g, b] = texels.rgb[first];
    let (x, y) = (first % texels.width, first / texels.width);
    let found = format!("it has {count} other texels, the first at {x}, {y}: ({r}, {g}, {b})");
    Err(format!("each part of a texel must be {}, and {found}", numbers.range()))
}

/// Decodes the bytes of a file.
fn texels(bytes: &[u8], format: ImageFormat, numbers: Numbers) -> Result<Texels, String> {
    let head = image_head(Cursor::new(bytes), format, bytes.len() as u64)?;
    let ImageHead { width, height, decoded } = head;
    if head.pixels() > MOST_TEXELS {
        return Err(format!("it has {width} × {height} texels, and an image may have {MOST_TEXELS}"));
    }
    // For a while, the decoder's own pixels exist beside the texels.
    check_memory(head.pixels() * BYTES_A_TEXEL + 2 * decoded)
        .map_err(|too_little| format!("it has {width} × {height} texels, which {too_little}"))?;
    match format {
        ImageFormat::OpenExr => read_exr(Cursor::new(bytes)),
        _ => {
            let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
            let mut limits = Limits::default();
            limits.max_alloc = Some(MOST_TEXELS * 16);
            reader.limits(limits);
            let image = reader.decode().map_err(|error| one_line(&error))?;
            Ok(Texels { width: image.width() as usize, height: image.height() as usize, rgb: linear(image, numbers) })
        }
    }
}

/// Converts pixels to linear light, or to numbers that are no light: integers of colours are sRGB, all else is linear;
/// alpha is ignored.
fn linear(image: DynamicImage, numbers: Numbers) -> Vec<[f32; 3]> {
    let as_it_is = matches!(numbers, Numbers::Normals | Numbers::Factors);
    let decoded = |part: f64| if as_it_is { part } else { linear_from_srgb(part) };
    let bytes_a_part = image.color().bytes_per_pixel() / image.color().channel_count();
    match bytes_a_part {
        1 => {
            let light: Vec<f32> = (0..=255).map(|byte| decoded(f64::from(byte) / 255.0) as f32).collect();
            image.into_rgb8().pixels().map(|texel| texel.0.map(|byte| light[usize::from(byte)])).collect()
        }
        2 => {
            let light = |part: u16| decoded(f64::from(part) / 65_535.0) as f32;
            image.into_rgb16().pixels().map(|texel| texel.0.map(light)).collect()
        }
        _ => image.into_rgb32f().pixels().map(|texel| texel.0).collect(),
    }
}

/// The channels R, G and B of the first part of an EXR that has them, at full size.
///
/// Errors: the library's message, on one line.
pub fn read_exr(reader: impl BufRead + Seek) -> Result<Texels, String> {
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
        .from_buffered(reader)
        .map_err(|error| one_line(&error))?;
    Ok(image.layer_data.channel_data.pixels)
}
