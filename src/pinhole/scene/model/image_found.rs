//! The image files that a model names: where they are, and whether they can be read.

use crate::scene::{IMAGE_FILE, TELLING_BYTES, image_kind, open_file};
use image::{ImageFormat, ImageReader};
use std::fs;
use std::io::{BufReader, Read, Seek};
use std::path::{Path, PathBuf};

/// The greatest number of texels of an image that extraction accepts.
const MOST_TEXELS: u64 = 1 << 26;

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

/// Checks that an image can be read, by its first bytes and its head.
///
/// Errors: why it cannot be.
pub fn check_file(path: &Path) -> Result<(), String> {
    let open = || open_file(path, IMAGE_FILE).map_err(|error| error.to_string());
    let mut start = Vec::new();
    open()?.file.take(TELLING_BYTES as u64).read_to_end(&mut start).map_err(|error| error.to_string())?;
    check(path, &start, || Ok(BufReader::new(open()?.file)))
}

/// The same of an image in memory.
///
/// Errors: why it cannot be.
pub fn check_bytes(bytes: &[u8]) -> Result<(), String> {
    check(Path::new(""), &bytes[..bytes.len().min(TELLING_BYTES)], || Ok(std::io::Cursor::new(bytes)))
}

fn check<R: std::io::BufRead + Seek>(
    path: &Path,
    start: &[u8],
    open: impl FnOnce() -> Result<R, String>,
) -> Result<(), String> {
    let format = match image_kind(path, start)? {
        // Their heads are read where they are used.
        ImageFormat::Hdr | ImageFormat::OpenExr => return Ok(()),
        format => format,
    };
    let damaged = "it is damaged";
    let (width, height) =
        ImageReader::with_format(open()?, format).into_dimensions().map_err(|_| damaged.to_owned())?;
    match u64::from(width) * u64::from(height) {
        0 => Err(damaged.into()),
        texels if texels > MOST_TEXELS => {
            Err(format!("it has {width} × {height} texels, and an image may have {MOST_TEXELS}"))
        }
        _ => Ok(()),
    }
}
