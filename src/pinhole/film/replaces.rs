//! The one rule by which a file may be replaced or removed: it is this program's own, or whoever asks has named it.
//!
//! A file that cannot be examined counts as somebody else's, never as absent.

use crate::scene::{FileKind, open_file, read_file};
use std::borrow::Cow;
use std::fs::{self, OpenOptions};
use std::io::{self, ErrorKind, Read};
use std::path::Path;

/// What stands in every picture, page and table that this program writes, each where its format has room for it.
pub const MARK: &str = "written by pinhole";

/// The words by which a file is known to be this program's own.
const MARKS: [&[u8]; 5] = [
    MARK.as_bytes(),
    // The text chunk of a PNG, and the attribute of an EXR.
    b"Software\0pinhole",
    b"software\0string\0\x07\0\0\0pinhole",
    // A report's numbers, as JSON and as CSV.
    b"\"family_level\":",
    b"variant,samples,seed,mse,mse_less_v_ref,",
];

/// How much of a file is searched for them.
const SEARCHED: u64 = 1 << 20;

/// What a file that is to be written may replace, or what may be removed.
#[derive(Clone, Copy)]
pub enum Replaces<'a> {
    /// Any file, for whoever asks has named it.
    Named,
    /// A file that this program has written.
    Own,
    /// Nothing: whatever has that name stays.
    Nothing,
    /// A file that holds exactly these bytes.
    Bytes(&'a [u8]),
    /// A file of which this is true; it is asked for those that are there.
    If(&'a dyn Fn(&Path) -> bool),
}

impl<'a> Replaces<'a> {
    /// Any file where the reader has named it, and otherwise the program's own.
    pub fn if_named(named: bool) -> Self {
        if named { Self::Named } else { Self::Own }
    }

    /// A file's place with this rule.
    pub fn at(self, path: &'a Path) -> Target<'a> {
        Target { path, replaces: self }
    }
}

/// Where a file is written, and what it may replace there.
#[derive(Clone, Copy)]
pub struct Target<'a> {
    /// The place.
    pub path: &'a Path,
    /// What may be there.
    pub replaces: Replaces<'a>,
}

impl<'a, P: AsRef<Path> + ?Sized> From<&'a P> for Target<'a> {
    fn from(path: &'a P) -> Self {
        Replaces::Named.at(path.as_ref())
    }
}

impl Target<'_> {
    /// Checks what is at a place that links have been followed to.
    ///
    /// Errors: why it has to stay; what cannot be examined has to.
    pub(super) fn check(&self, path: &Path) -> io::Result<()> {
        let found = match fs::symlink_metadata(path) {
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(()),
            found => found?,
        };
        let refused = |what: &str| Err(io::Error::other(what));
        if found.is_dir() {
            return Err(io::Error::new(ErrorKind::IsADirectory, "a folder of that name is in the way"));
        }
        if !found.is_file() {
            return refused("what is there is not a regular file");
        }
        let stays = match self.replaces {
            Replaces::Named => None,
            Replaces::Own => (!is_own(path)).then_some(
                "the file that is there was not written by pinhole, so it stays: name it with -o, or move it away",
            ),
            Replaces::Nothing => return Err(taken()),
            Replaces::Bytes(known) => {
                let kind = FileKind { name: "a file that is known", max: known.len() as u64 };
                let same = read_file(path, kind).is_ok_and(|there| there == known);
                (!same).then_some("it was changed by another program meanwhile, so it stays as it is")
            }
            Replaces::If(holds) => (!holds(path)).then_some("the file that is there is somebody else's, so it stays"),
        };
        if let Some(what) = stays {
            return refused(what);
        }
        // A renamed file takes the place of one that nobody may write to, and the system does not object.
        let protected =
            || OpenOptions::new().write(true).open(path).is_err_and(|why| why.kind() != ErrorKind::NotFound);
        if found.permissions().readonly() || protected() {
            return Err(io::Error::new(ErrorKind::PermissionDenied, "the file that is there is write-protected"));
        }
        Ok(())
    }
}

/// A picture, page or drawing with the mark, where its format has room for one; anything else as it is.
pub fn marked(bytes: &[u8]) -> Cow<'_, [u8]> {
    /// The bytes of a PNG before its second chunk: the signature, and a head of 13 bytes in a chunk.
    const HEAD: usize = 8 + 12 + 13;
    const PAGE: &[u8] = b"<!doctype html>\n";
    const RADIANCE: &[u8] = b"#?RADIANCE\n";
    let mark = |at: usize, mark: &[u8]| Cow::Owned([&bytes[..at], mark, &bytes[at..]].concat());
    if has_mark(bytes) {
        return Cow::Borrowed(bytes);
    }
    match bytes {
        _ if bytes.starts_with(b"\x89PNG\r\n\x1a\n") && bytes.len() > HEAD => mark(HEAD, &png_mark()),
        _ if bytes.starts_with(PAGE) => mark(PAGE.len(), format!("<!-- {MARK} -->\n").as_bytes()),
        _ if bytes.starts_with(b"<svg") => mark(0, format!("<!-- {MARK} -->\n").as_bytes()),
        _ if bytes.starts_with(RADIANCE) => mark(RADIANCE.len(), format!("# {MARK}\n").as_bytes()),
        _ => Cow::Borrowed(bytes),
    }
}

/// A chunk of text: its length, its name, what it holds, and the CRC-32 of both.
fn png_mark() -> Vec<u8> {
    let named = [&b"tEXt"[..], MARKS[1]].concat();
    let length = MARKS[1].len() as u32;
    [&length.to_be_bytes()[..], &named, &crc32fast::hash(&named).to_be_bytes()].concat()
}

fn has_mark(bytes: &[u8]) -> bool {
    let searched = &bytes[..bytes.len().min(SEARCHED as usize)];
    MARKS.iter().any(|mark| searched.windows(mark.len()).any(|window| window == *mark))
}

/// Why nothing is written where a file is already.
pub(super) fn taken() -> io::Error {
    io::Error::new(ErrorKind::AlreadyExists, "a file of that name is there already")
}

/// Whether this program wrote a file: it holds one of the marks near its beginning.
fn is_own(path: &Path) -> bool {
    const ANY: FileKind = FileKind { name: "a file", max: u64::MAX };
    let mut bytes = Vec::new();
    let read = open_file(path, ANY).ok().and_then(|own| own.file.take(SEARCHED).read_to_end(&mut bytes).ok());
    read.is_some() && has_mark(&bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_known_by_its_mark_and_nothing_else() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = folder.path().join("file");
        for (bytes, own) in [
            (&b""[..], false),
            (b"precious", false),
            (b"a picture made with Pinhole", false),
            (b"\x89PNG tEXtSoftware\0GIMP", false),
            (b"\x89PNG tEXtSoftware\0pinhole", true),
            (b"<svg/><!-- written by pinhole -->", true),
        ] {
            fs::write(&file, bytes).expect("written");
            let place = Replaces::Own.at(&file);
            assert_eq!(place.check(&file).is_ok(), own, "{}", String::from_utf8_lossy(bytes));
            assert!(Target::from(&file).check(&file).is_ok() && Replaces::Nothing.at(&file).check(&file).is_err());
            assert!(Replaces::Bytes(bytes).at(&file).check(&file).is_ok());
            assert!(Replaces::Bytes(b"other").at(&file).check(&file).is_err());
        }
        fs::remove_file(&file).expect("removed");
        assert!(Replaces::Nothing.at(&file).check(&file).is_ok());
    }

    #[test]
    fn every_kind_of_file_has_room_for_the_mark() {
        let mut png = Vec::new();
        let mut encoder = png::Encoder::new(&mut png, 1, 1);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.write_header().expect("written").write_image_data(&[7]).expect("written");
        for file in [&png[..], b"<!doctype html>\n<html>", b"<svg>", b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n"] {
            let with_mark = marked(file);
            assert!(!has_mark(file) && has_mark(&with_mark) && marked(&with_mark) == with_mark);
        }
        let with_mark = marked(&png);
        let mut reader = png::Decoder::new(std::io::Cursor::new(&with_mark[..])).read_info().expect("a PNG");
        let mut pixel = [0];
        reader.next_frame(&mut pixel).expect("decoded");
        assert_eq!((pixel, reader.info().uncompressed_latin1_text[0].text.as_str()), ([7], "pinhole"));
    }
}
