//! Image files → texels in linear light: read once, checked, and remarked on.

use super::texels::{Numbers, is_grey, normals_of_heights};
use super::{
    EmissionMapTable, EnvironmentTable, ImageTable, MetallicRoughnessTable, NormalMapTable, Pyramid, Texels,
    linear_from_srgb,
};
use crate::each::Each;
use crate::plan::Census;
use crate::scene::{
    EmbeddedFiles, FileStore, IMAGE_FILE, ModelFiles, SceneError, SceneFolder, TELLING_BYTES, TooLittleMemory,
    Undecoded, check_memory, image_kind, open_file, printable, printable_path,
};
use bevy_ecs::prelude::*;
use exr::image::read::specific_channels::ReadSpecificChannel;
use exr::meta::attribute::{Chromaticities, EnvironmentMap, IntegerBounds};
use exr::meta::header::Header;
use exr::prelude::{Compression, MetaData, ReadChannels, ReadLayers, read};
use glam::{DMat3, DVec3};
use image::metadata::Orientation;
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};
use std::borrow::Cow;
use std::collections::BTreeSet;
use std::fmt::Display;
use std::io::{BufRead, BufReader, Cursor, Seek};
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
            image.into_rgb8().pixels().map(|texel| texel.0.each(|byte| light[usize::from(byte)])).collect()
        }
        2 => {
            let light = |part: u16| decoded(f64::from(part) / 65_535.0) as f32;
            image.into_rgb16().pixels().map(|texel| texel.0.each(light)).collect()
        }
        _ => image.into_rgb32f().pixels().map(|texel| texel.0).collect(),
    }
}

// The size that an image file states, read before memory is allocated.
//
// A file of a few hundred bytes can state that it has 10⁹ pixels.

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
            .each(|(pixels, step)| along(pixels, step));
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

/// What was done to the texels of a scene's images so that they can be used, one sentence each, each once.
///
/// Errors: an image that cannot be used.
pub fn image_remarks(scene: &Census<'_>) -> Result<Vec<String>, SceneError> {
    fn of(pyramids: &[Arc<Pyramid>]) -> impl Iterator<Item = String> {
        pyramids.iter().flat_map(|image| image.remarks.iter().cloned())
    }
    let mut said = Vec::new();
    said.extend(of(&scene.table::<ImageTable>()?.pyramid));
    said.extend(of(&scene.table::<MetallicRoughnessTable>()?.images.pyramid));
    said.extend(of(&scene.table::<EmissionMapTable>()?.images.pyramid));
    said.extend(scene.table::<NormalMapTable>()?.image.iter().flat_map(|image| image.remarks.iter().cloned()));
    said.extend(scene.table::<EnvironmentTable>()?.remarks.iter().cloned());
    let mut seen = BTreeSet::new();
    said.retain(|sentence| seen.insert(sentence.clone()));
    Ok(said)
}

// EXR files → colours in linear Rec. 709: the channels that are there, the primaries that are meant.

/// A texel that is not there.
const BLACK: [f32; 3] = [0.0; 3];

/// The names of channels that become a colour.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Wanted {
    /// Red, green and blue.
    Rgb([String; 3]),
    /// One for all three.
    Grey(String),
}

/// An EXR as colours, and what was done to make it so, one sentence each.
///
/// It is the first part that has R, G and B; or else Y; or else a layer such as `beauty.R`, `beauty.G`, `beauty.B`; or
/// else the only channel there is.
/// Errors: what it has instead, or the library's message, on one line.
pub fn exr_texels(bytes: &[u8]) -> Result<(Texels, Vec<String>), String> {
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(|error| explained(&error))?;
    let wanted = wanted(&meta.headers)?;
    let header = meta.headers.iter().find(|header| has(header, &wanted)).ok_or("it has no part with these channels")?;
    if let Compression::DWAA(_) | Compression::DWAB(_) = header.compression {
        return Err(format!(
            "its compression is {}, which is not read; save it with ZIP or PIZ, as `oiiotool in.exr --compression zip \
             -o out.exr` does",
            if matches!(header.compression, Compression::DWAA(_)) { "DWAA" } else { "DWAB" }
        ));
    }
    let mut remarks = Vec::new();
    let texels = match &wanted {
        Wanted::Rgb(names) if *names == ["R", "G", "B"] => read_exr(Cursor::new(bytes))?,
        Wanted::Rgb(names) => {
            let layer = names[0].rsplit_once('.').map_or("", |(layer, _)| layer);
            remarks.push(format!("its layer {} is read", crate::scene::printable(layer, 80)));
            read_channels(Cursor::new(bytes), names.each_ref().each(String::as_str))?
        }
        Wanted::Grey(name) => {
            remarks.push(format!("its channel {} is read as grey", crate::scene::printable(name, 80)));
            read_grey(bytes, name)?
        }
    };
    let own = &header.own_attributes;
    let window = IntegerBounds { position: own.layer_position, size: header.layer_size };
    let mut texels = framed(texels, window, header.shared_attributes.display_window, &mut remarks);
    if let Some(chromaticities) = header.shared_attributes.chromaticities {
        convert(&mut texels, &chromaticities, &mut remarks);
    }
    if own.environment_map == Some(EnvironmentMap::Cube) {
        remarks.push("it says it is a cube map, and is read as the plain image that it is".into());
    }
    Ok((texels, remarks))
}

fn has(header: &Header, wanted: &Wanted) -> bool {
    let names = match wanted {
        Wanted::Rgb(names) => &names[..],
        Wanted::Grey(name) => std::slice::from_ref(name),
    };
    !header.deep && names.iter().all(|name| header.channels.list.iter().any(|own| own.name.to_string() == *name))
}

fn wanted(headers: &[Header]) -> Result<Wanted, String> {
    let names = |header: &Header| header.channels.list.iter().map(|own| own.name.to_string()).collect::<Vec<_>>();
    let all: Vec<String> = headers.iter().flat_map(names).collect();
    let has = |wanted: &Wanted| headers.iter().any(|header| self::has(header, wanted));
    let of = |layer: &str, parts: [&str; 3]| Wanted::Rgb(parts.each(|part| format!("{layer}{part}")));
    let layers = || all.iter().filter_map(|name| Some(&name[..=name.rfind('.')?]));
    let mut candidates = vec![of("", ["R", "G", "B"]), of("", ["r", "g", "b"]), Wanted::Grey("Y".into())];
    candidates.extend(layers().map(|layer| of(layer, ["R", "G", "B"])));
    candidates.extend(layers().map(|layer| of(layer, ["r", "g", "b"])));
    candidates.extend(layers().map(|layer| Wanted::Grey(format!("{layer}Y"))));
    candidates.extend(all.first().filter(|_| all.len() == 1).cloned().map(Wanted::Grey));
    candidates.into_iter().find(has).ok_or_else(|| {
        let listed = crate::scene::printable(&all.join(", "), 200);
        format!("it has the channels {listed}, and an image needs R, G and B, of a layer or without one, or Y")
    })
}

/// The channels R, G and B of the first part of an EXR that has them, at full size.
///
/// Errors: the library's message, on one line.
pub fn read_exr(reader: impl BufRead + Seek) -> Result<Texels, String> {
    read_channels(reader, ["R", "G", "B"])
}

fn read_channels(reader: impl BufRead + Seek, [r, g, b]: [&str; 3]) -> Result<Texels, String> {
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .specific_channels()
        .required(r)
        .required(g)
        .required(b)
        .collect_pixels(
            |size, _| Texels { width: size.0, height: size.1, rgb: vec![BLACK; size.area()] },
            |texels: &mut Texels, at, (r, g, b): (f32, f32, f32)| {
                let row = at.1 * texels.width;
                texels.rgb[row + at.0] = [r, g, b];
            },
        )
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(reader)
        .map_err(|error| explained(&error))?;
    Ok(image.layer_data.channel_data.pixels)
}

fn read_grey(bytes: &[u8], name: &str) -> Result<Texels, String> {
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .specific_channels()
        .required(name)
        .collect_pixels(
            |size, _| Texels { width: size.0, height: size.1, rgb: vec![BLACK; size.area()] },
            |texels: &mut Texels, at, (grey,): (f32,)| {
                let row = at.1 * texels.width;
                texels.rgb[row + at.0] = [grey; 3];
            },
        )
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(|error| explained(&error))?;
    Ok(image.layer_data.channel_data.pixels)
}

/// The image in its display window: what is stored beyond that is cut off, and what is not stored is black.
fn framed(texels: Texels, data: IntegerBounds, display: IntegerBounds, remarks: &mut Vec<String>) -> Texels {
    let (width, height) = (display.size.0, display.size.1);
    // A window as large as this would have been refused if it were stored.
    let is_odd = width == 0 || height == 0 || width.saturating_mul(height) > 4 * texels.rgb.len();
    if data == display || is_odd {
        return texels;
    }
    let offset = [data.position.0 - display.position.0, data.position.1 - display.position.1].each(i64::from);
    let texel = |x: usize, y: usize| {
        let (x, y) = (x as i64 - offset[0], y as i64 - offset[1]);
        let inside = (0..texels.width as i64).contains(&x) && (0..texels.height as i64).contains(&y);
        if inside { texels.rgb[y as usize * texels.width + x as usize] } else { BLACK }
    };
    remarks.push(format!(
        "{} × {} texels of its {width} × {height} are stored, and the rest is black",
        texels.width, texels.height
    ));
    Texels { width, height, rgb: (0..width * height).map(|at| texel(at % width, at / width)).collect() }
}

/// CIE XYZ of a chromaticity, but for its size.
fn xyz(at: exr::math::Vec2<f32>) -> DVec3 {
    let (x, y) = (f64::from(at.0), f64::from(at.1));
    DVec3::new(x, y, 1.0 - x - y)
}

/// The matrix from linear RGB with these primaries to CIE XYZ; white has Y = 1.
fn xyz_from_rgb([red, green, blue, white]: [DVec3; 4]) -> DMat3 {
    let primaries = DMat3::from_cols(red, green, blue);
    primaries * DMat3::from_diagonal(primaries.inverse() * (white / white.y))
}

/// Primaries and white point D65 of Rec. 709.
const REC_709: [DVec3; 4] = [
    DVec3::new(0.64, 0.33, 0.03),
    DVec3::new(0.3, 0.6, 0.1),
    DVec3::new(0.15, 0.06, 0.79),
    DVec3::new(0.3127, 0.329, 0.3583),
];
/// The responses of cones of the Bradford chromatic adaptation, row by row.
const BRADFORD: [[f64; 3]; 3] = [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]];

/// The matrix from linear RGB with these primaries and white to Rec. 709, whose white is adapted to D65 (Bradford).
fn rec_709_from(own: [DVec3; 4]) -> DMat3 {
    let bradford = DMat3::from_cols_array_2d(&BRADFORD).transpose();
    let white = |of: [DVec3; 4]| bradford * (of[3] / of[3].y);
    let adapted = bradford.inverse() * DMat3::from_diagonal(white(REC_709) / white(own)) * bradford;
    xyz_from_rgb(REC_709).inverse() * adapted * xyz_from_rgb(own)
}

fn convert(texels: &mut Texels, from: &Chromaticities, remarks: &mut Vec<String>) {
    let own = [from.red, from.green, from.blue, from.white].each(xyz);
    let apart = own.iter().zip(REC_709).map(|(own, other)| (*own - other).abs().max_element()).fold(0.0, f64::max);
    if apart < 1e-3 {
        return;
    }
    let matrix = rec_709_from(own);
    if !matrix.is_finite() || matrix.determinant() == 0.0 {
        remarks.push("its chromaticities are those of no colour space, and are left out".into());
        return;
    }
    for texel in &mut texels.rgb {
        *texel = (matrix * DVec3::from(texel.each(f64::from))).as_vec3().to_array();
    }
    remarks.push("its colours are converted from its own primaries to those of Rec. 709".into());
}

#[cfg(test)]
mod exr_file_tests {
    use super::*;

    /// Of XYZ as primaries, white of equal energy: the red of Rec. 709 comes back as red, adapted to D65.
    #[test]
    fn primaries_are_converted_with_their_white() {
        let equal = DVec3::splat(1.0 / 3.0);
        let matrix = rec_709_from([DVec3::X, DVec3::Y, DVec3::Z, equal]);
        assert!((matrix * DVec3::ONE - DVec3::ONE).abs().max_element() < 1e-9, "white stays white");
        let own = rec_709_from(REC_709);
        assert!((own - DMat3::IDENTITY).to_cols_array().iter().all(|part| part.abs() < 1e-12));
        // The luminances of the primaries of Rec. 709, as its text has them.
        let luminances = xyz_from_rgb(REC_709).row(1);
        assert!((luminances - DVec3::new(0.2126, 0.7152, 0.0722)).abs().max_element() < 1e-4, "{luminances}");
        // ACES AP0 to Rec. 709, by the matrix of SMPTE ST 2065-1 and a Bradford transform from its white to D65.
        let ap0 = [[0.7347, 0.2653], [0.0, 1.0], [0.0001, -0.077], [0.32168, 0.33767]];
        let ap0 = ap0.map(|[x, y]| DVec3::new(x, y, 1.0 - x - y));
        let found = rec_709_from(ap0);
        let expected = [2.521_7, -1.134_1, -0.387_6];
        for (axis, expected) in expected.into_iter().enumerate() {
            assert!((found.row(0)[axis] - expected).abs() < 2e-3, "{found}");
        }
    }

    #[test]
    fn the_display_window_is_what_is_seen() {
        let bounds = |x: i32, y: i32, width: usize, height: usize| IntegerBounds::new((x, y), (width, height));
        let texels = Texels { width: 2, height: 1, rgb: vec![[1.0; 3], [2.0; 3]] };
        let mut remarks = Vec::new();
        let found = framed(texels.clone(), bounds(1, 1, 2, 1), bounds(0, 0, 3, 2), &mut remarks);
        let grey: Vec<f32> = found.rgb.iter().map(|texel| texel[0]).collect();
        assert_eq!((found.width, found.height, grey), (3, 2, vec![0.0, 0.0, 0.0, 0.0, 1.0, 2.0]));
        let found = framed(texels.clone(), bounds(-1, 0, 2, 1), bounds(0, 0, 1, 1), &mut remarks);
        assert_eq!((found.rgb, remarks.len()), (vec![[2.0; 3]], 2));
        assert_eq!(framed(texels.clone(), bounds(0, 0, 2, 1), bounds(0, 0, 2, 1), &mut remarks), texels);
        assert_eq!(remarks.len(), 2);
    }
}
