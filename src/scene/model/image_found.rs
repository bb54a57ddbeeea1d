//! The image files that a model names: where they are, and whether they can be read.

use crate::{FileStore, IMAGE_FILE, TELLING_BYTES, Undecoded, check_memory, image_kind};
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader};
use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};

/// The greatest number of texels of an image that extraction accepts.
const MAX_TEXELS: u64 = 1 << 26;
/// The greatest number of texels that a byte of an image can hold: eight of one bit, in the tightest deflate.
const MAX_TEXELS_A_BYTE: u64 = 8 * 1032;

/// The ending of an image's name by its first bytes, if it is of a kind that is read.
pub fn ending_of(bytes: &[u8]) -> &'static str {
    let start = &bytes[..bytes.len().min(TELLING_BYTES)];
    match image_kind(Path::new(""), start) {
        Ok(ImageFormat::Jpeg) => "jpg",
        Ok(ImageFormat::Hdr) => "hdr",
        Ok(ImageFormat::OpenExr) => "exr",
        Ok(ImageFormat::Bmp) => "bmp",
        Ok(ImageFormat::Tga) => "tga",
        _ => "png",
    }
}

/// Where the file is that a model in this folder names: there, with backslashes for slashes, in another case of letters,
/// or by its last part beside the model, where the name leads to the folder of another machine.
pub fn found_beside(folder: &Path, name: &str) -> PathBuf {
    let plain = name.replace('\\', "/");
    let last = plain.rsplit('/').next().unwrap_or(&plain);
    let candidates = [folder.join(name), folder.join(&plain)];
    let found = candidates.iter().find(|path| path.is_file()).cloned();
    let found = found.or_else(|| in_other_case(&folder.join(&plain)));
    let found = found.or_else(|| Some(folder.join(last)).filter(|path| path.is_file()));
    found.or_else(|| in_other_case(&folder.join(last))).unwrap_or_else(|| folder.join(&plain))
}

/// A file of the same folder whose name differs by the case of its letters only, as file systems on other machines allow.
fn in_other_case(path: &Path) -> Option<PathBuf> {
    let (folder, name) = (path.parent()?, path.file_name()?.to_str()?.to_lowercase());
    let mut entries = fs::read_dir(folder).ok()?.filter_map(Result::ok).map(|entry| entry.path());
    entries.find(|other| {
        let own = other.file_name().and_then(|own| own.to_str()).map(str::to_lowercase);
        own.as_ref() == Some(&name) && other.is_file()
    })
}

/// The images that were checked, with why they cannot be read if they cannot.
static CHECKED: FileStore<Result<(), String>> = FileStore::new();

/// What a result counts as in memory, so that the last few thousand are kept.
const A_RESULT: usize = 1 << 16;

/// Checks that an image can be read, which is known when it has been decoded as a whole: files break off, and are damaged
/// anywhere.
///
/// Errors: why it cannot be.
pub fn check_file(path: &Path) -> Result<(), String> {
    let checked = CHECKED.get(path, IMAGE_FILE, |bytes| Ok((check(path, bytes), A_RESULT)));
    let checked = checked.map_err(|why| match why {
        Undecoded::File(error) => error.to_string(),
        Undecoded::Content(problem) => problem,
    })?;
    (*checked).clone()
}

/// The same of an image in memory, known by a name.
///
/// Errors: why it cannot be.
pub fn check_bytes(name: &str, bytes: &[u8]) -> Result<(), String> {
    let checked = CHECKED.of_bytes(Path::new(name), bytes, |bytes| Ok((check(Path::new(""), bytes), A_RESULT)))?;
    (*checked).clone()
}

fn check(path: &Path, bytes: &[u8]) -> Result<(), String> {
    let format = match image_kind(path, &bytes[..bytes.len().min(TELLING_BYTES)])? {
        // They are decoded where they are used.
        ImageFormat::Hdr | ImageFormat::OpenExr => return Ok(()),
        format => format,
    };
    let damaged = || "it is damaged".to_owned();
    let decoder = ImageReader::with_format(Cursor::new(bytes), format).into_decoder().map_err(|_| damaged())?;
    let (width, height) = decoder.dimensions();
    let texels = u64::from(width) * u64::from(height);
    if texels > MAX_TEXELS {
        return Err(format!("it has {width} × {height} texels, and an image may have {MAX_TEXELS}"));
    }
    // A byte of a PNG holds no more texels than this, so that less of them does not fill the memory.
    if texels == 0 || texels / MAX_TEXELS_A_BYTE > bytes.len() as u64 {
        return Err(damaged());
    }
    check_memory(decoder.total_bytes())
        .map_err(|too_little| format!("it has {width} × {height} texels, which {too_little}"))?;
    DynamicImage::from_decoder(decoder).map(|_| ()).map_err(|_| damaged())
}
