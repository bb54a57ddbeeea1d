//! Image files → texels in linear light.

use super::exr_file::exr_texels;
use super::image_head::{ImageHead, image_head, one_line};
use super::texel_range::{Numbers, is_grey, normals_of_heights};
use super::{Pyramid, Texels, linear_from_srgb};
use crate::scene::{
    EmbeddedFiles, FileStore, IMAGE_FILE, ModelFiles, SceneError, SceneFolder, TELLING_BYTES, TooLittleMemory,
    Undecoded, check_memory, image_kind, open_file, printable, printable_path,
};
use bevy_ecs::prelude::*;
use image::metadata::Orientation;
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};
use std::borrow::Cow;
use std::collections::BTreeSet;
use std::io::{BufRead, BufReader, Cursor};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The greatest number of texels of one image: 8192².
const MAX_TEXELS: u64 = 1 << 26;
/// The endings of files that may be images.
const ENDINGS: [&str; 7] = ["png", "jpg", "jpeg", "tga", "bmp", "hdr", "exr"];
/// What a name without such an ending is told.
const ACCEPTED: &str = "it must be the name of a .png, .jpg, .tga, .bmp, .hdr or .exr file";
/// The memory of a texel with its part of the pyramid above it, in bytes.
const BYTES_A_TEXEL: u64 = 16;

/// An image without a pyramid, and what was done to its texels, one sentence each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RemarkedTexels {
    /// The texels.
    pub texels: Arc<Texels>,
    /// What there is to say.
    pub remarks: Vec<String>,
}

/// The images of textures, which are reflectances, those of environments, which are radiance, and maps.
static TEXTURES: FileStore<Pyramid> = FileStore::new();
static BACKGROUNDS: FileStore<RemarkedTexels> = FileStore::new();
static NORMAL_MAPS: FileStore<RemarkedTexels> = FileStore::new();
static FACTORS: FileStore<Pyramid> = FileStore::new();
static EMISSIONS: FileStore<Pyramid> = FileStore::new();
static ALPHAS: FileStore<Pyramid> = FileStore::new();

/// The image of a texture, with its pyramid.
///
/// Errors: a file that is missing, unreadable, too large or no image.
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
    decoded(&EMISSIONS, scene, who, file, Numbers::Radiance, with_pyramid)
}

/// The alpha of an image, in all three parts; 1 where it has none.
///
/// Errors: the same.
pub(super) fn alpha_image(scene: &World, who: &str, file: &str) -> Result<Arc<Pyramid>, SceneError> {
    decoded(&ALPHAS, scene, who, file, Numbers::Alphas, with_pyramid)
}

/// The image of an environment.
///
/// Errors: the same as those of a texture.
pub(super) fn background_image(scene: &World, who: &str, file: &str) -> Result<Arc<RemarkedTexels>, SceneError> {
    decoded(&BACKGROUNDS, scene, who, file, Numbers::Radiance, alone)
}

/// The image of a normal map, its parts as they are in the file; a grey one is a map of heights, and becomes the normals
/// of its slopes.
///
/// Errors: the same.
pub(super) fn normal_map_image(scene: &World, who: &str, file: &str) -> Result<Arc<RemarkedTexels>, SceneError> {
    decoded(&NORMAL_MAPS, scene, who, file, Numbers::Normals, alone)
}

/// An image with its pyramid, and the memory of both in bytes.
fn with_pyramid(texels: Texels, remarks: Vec<String>) -> (Pyramid, usize) {
    let pyramid = Pyramid { remarks, ..Pyramid::on(texels) };
    let bytes = pyramid.bytes();
    (pyramid, bytes)
}

/// An image without a pyramid, and its memory in bytes.
fn alone(texels: Texels, remarks: Vec<String>) -> (RemarkedTexels, usize) {
    let bytes = texels.bytes();
    (RemarkedTexels { texels: texels.into(), remarks }, bytes)
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
    prepared: impl FnOnce(Texels, Vec<String>) -> (T, usize),
) -> Result<Arc<T>, SceneError> {
    let refused = |accepted: String| SceneError::new(who, "file", shown_name(file), accepted);
    let path = SceneFolder::path_of(scene, file);
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    let is_named = ending.is_some_and(|ending| ENDINGS.contains(&&*ending));
    let decode = |bytes: &[u8]| {
        let shown = printable_path(&path);
        let read = texels(&path, bytes, numbers).map_err(|problem| format!("{shown} cannot be read: {problem}"));
        let (texels, remarks) = read?;
        let name = path.file_name().map_or_else(|| shown.clone(), |name| printable(&name.to_string_lossy(), 80));
        Ok(prepared(texels, remarks.into_iter().map(|remark| format!("{name}: {remark}")).collect()))
    };
    if let Some(bytes) = ModelFiles::find(scene, file) {
        return store.of_bytes(Path::new(file), &bytes, decode).map_err(refused);
    }
    if let Some(bytes) = EmbeddedFiles::find(scene, file) {
        return decode(bytes).map(|(image, _)| Arc::new(image)).map_err(refused);
    }
    store.get(&path, IMAGE_FILE, decode).map_err(|why| match why {
        // What is an image has been read, whatever its name.
        _ if !is_named => refused(ACCEPTED.into()),
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
        let file = open_file(path, IMAGE_FILE).ok()?;
        let length = file.metadata.len();
        let is_there = TEXTURES.holds(path, &file.metadata);
        let mut reader = BufReader::new(file.file);
        let start = reader.fill_buf().ok()?;
        let format = image_kind(path, &start[..start.len().min(TELLING_BYTES)]).ok()?;
        let head = image_head(reader, format, length).ok()?;
        (!is_there && head.pixels() <= MAX_TEXELS).then(|| head.pixels() * BYTES_A_TEXEL)
    };
    let needed = paths.iter().filter_map(bytes).sum();
    check_memory(needed).map_err(|too_little| (paths.len(), too_little))
}

/// Decodes the bytes of a file, and says what was done to them.
fn texels(path: &Path, bytes: &[u8], numbers: Numbers) -> Result<(Texels, Vec<String>), String> {
    let format = image_kind(path, &bytes[..bytes.len().min(TELLING_BYTES)])?;
    let mut remarks = Vec::new();
    let bytes = if format == ImageFormat::Hdr { as_radiance(bytes) } else { Cow::Borrowed(bytes) };
    let head = image_head(Cursor::new(&*bytes), format, bytes.len() as u64)?;
    let ImageHead { width, height, decoded } = head;
    if head.pixels() > MAX_TEXELS {
        return Err(format!("it has {width} × {height} texels, and an image may have {MAX_TEXELS}"));
    }
    // For a while, the decoder's own pixels exist beside the texels.
    check_memory(head.pixels() * BYTES_A_TEXEL + 2 * decoded)
        .map_err(|too_little| format!("it has {width} × {height} texels, which {too_little}"))?;
    let mut texels = if format == ImageFormat::OpenExr {
        let (texels, said) = exr_texels(&bytes)?;
        remarks.extend(said);
        texels
    } else {
        if format == ImageFormat::Jpeg && breaks_off(&bytes) {
            remarks.push("it breaks off before its end, and what is missing is made up".into());
        }
        let mut reader = ImageReader::with_format(Cursor::new(&*bytes), format);
        let mut limits = Limits::default();
        limits.max_alloc = Some(MAX_TEXELS * 16);
        reader.limits(limits);
        let mut decoder = reader.into_decoder().map_err(|error| one_line(&error))?;
        let orientation = decoder.orientation().unwrap_or(Orientation::NoTransforms);
        if orientation != Orientation::NoTransforms {
            let number = orientation.to_exif();
            remarks.push(format!("its EXIF orientation is {number}, and its texels are used as they lie in the file"));
        }
        let image = DynamicImage::from_decoder(decoder).map_err(|error| one_line(&error))?;
        Texels { width: image.width() as usize, height: image.height() as usize, rgb: linear(image, numbers) }
    };
    if format == ImageFormat::Hdr {
        divide_by_exposure(&bytes, &mut texels, &mut remarks);
    }
    if numbers == Numbers::Normals && is_grey(&texels) {
        remarks.push("as a normal map it is grey, so it is taken for heights, whose slopes give the normals".into());
        Numbers::Factors.bring_into_range(&mut texels);
        return Ok((normals_of_heights(&texels), remarks));
    }
    remarks.extend(numbers.bring_into_range(&mut texels));
    Ok((texels, remarks))
}

/// Whether a JPEG ends within its image: behind the last beginning of a scan there is no end of an image.
fn breaks_off(bytes: &[u8]) -> bool {
    let scan = bytes.windows(2).rposition(|mark| mark == [0xff, 0xda]);
    scan.is_some_and(|scan| !bytes[scan..].windows(2).any(|mark| mark == [0xff, 0xd9]))
}

/// The first line of a Radiance file as the decoder knows it.
const RADIANCE: &[u8] = b"#?RADIANCE\n";

/// A Radiance file with that first line: other programs write their own names there, such as `#?RGBE`.
fn as_radiance(bytes: &[u8]) -> Cow<'_, [u8]> {
    let end = bytes.iter().take(200).position(|byte| *byte == b'\n');
    match end {
        Some(end) if !bytes.starts_with(RADIANCE) => Cow::Owned([RADIANCE, &bytes[end + 1..]].concat()),
        _ => Cow::Borrowed(bytes),
    }
}

/// Divides by the numbers that a Radiance file says its pixels were multiplied by.
fn divide_by_exposure(bytes: &[u8], texels: &mut Texels, remarks: &mut Vec<String>) {
    let head = bytes.split(|byte| *byte == b'\n').take_while(|line| !line.is_empty()).take(100);
    let exposures =
        head.filter_map(|line| std::str::from_utf8(line.strip_prefix(b"EXPOSURE=")?).ok()?.trim().parse().ok());
    let exposure: f64 = exposures.filter(|exposure| *exposure > 0.0 && f64::is_finite(*exposure)).product();
    if exposure != 1.0 && exposure > 0.0 && exposure.is_finite() {
        texels.rgb.iter_mut().flatten().for_each(|part| *part = (f64::from(*part) / exposure) as f32);
        remarks.push(format!("its texels are divided by its EXPOSURE, {exposure}"));
    }
}

/// Converts pixels to linear light, or to numbers that are no light: integers of colours are sRGB, all else is linear;
/// alpha is ignored, but where it is asked for.
fn linear(image: DynamicImage, numbers: Numbers) -> Vec<[f32; 3]> {
    if numbers == Numbers::Alphas {
        // An image without gets one of 1 everywhere.
        return image.into_rgba32f().pixels().map(|texel| [texel.0[3]; 3]).collect();
    }
    let as_it_is = numbers.are_no_light();
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
