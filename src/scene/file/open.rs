use super::{FileProblem, SceneFile};
use crate::{FileError, FileKind, Unopened, read_file};
use std::io::Read;
use std::path::Path;

const SCENE_FILE: FileKind = FileKind { name: "a scene file", max: 16 << 20 };

impl SceneFile {
    /// Reads a scene from a file.
    ///
    /// Errors: it cannot be read, is not UTF-8, is larger than 16 MiB, or contains a mistake; with line and column if
    /// the problem has a position.
    pub fn open(path: &Path) -> Result<Self, FileProblem> {
        let bytes = read_file(path, SCENE_FILE).map_err(|error| FileProblem::of(path, reason(error)))?;
        Self::parse_bytes(path, bytes)
    }

    /// Reads a scene from a stream, such as standard input; the files that it names are relative to the current folder.
    ///
    /// Errors: as for [`open`](Self::open).
    pub fn read(name: &Path, from: impl Read) -> Result<Self, FileProblem> {
        let mut bytes = Vec::new();
        let max = SCENE_FILE.max;
        let read = from.take(max + 1).read_to_end(&mut bytes);
        read.map_err(|error| FileProblem::of(name, format!("it cannot be read: {error}")))?;
        if bytes.len() as u64 > max {
            let what = format!("there are more than {max} bytes, but a scene file has at most that many");
            return Err(FileProblem::of(name, what));
        }
        Self::parse_bytes(name, bytes)
    }

    /// Parses a scene from the bytes of a file.
    ///
    /// Errors: they are not UTF-8, or contain a mistake.
    pub fn parse_bytes(path: &Path, bytes: Vec<u8>) -> Result<Self, FileProblem> {
        match String::from_utf8(bytes) {
            Ok(text) => Self::parse(path, text),
            Err(error) => {
                let good = error.utf8_error().valid_up_to();
                let byte = error.as_bytes().get(good).copied().unwrap_or_default();
                let text = String::from_utf8_lossy(error.as_bytes().get(..good).unwrap_or(&[])).into_owned();
                let place = Some(super::mistake::place_of(&text, good));
                let what = format!("the byte 0x{byte:02x} is not UTF-8, but a scene file is text in UTF-8");
                Err(FileProblem { path: path.into(), place, what })
            }
        }
    }
}

/// Why a scene file was not read, as a clause after the file's name.
fn reason(error: FileError) -> String {
    let FileKind { name, max } = error.kind;
    match error.why {
        Unopened::Missing => "there is no such file".into(),
        Unopened::Folder => format!("this is a folder, but {name} is a text file"),
        Unopened::NotRegular => format!("this is not a regular file, but {name} is a text file"),
        Unopened::TooLong(bytes) => format!("the file has {bytes} bytes, but {name} has at most {max}"),
        Unopened::TooLittleMemory(said) => format!("the file cannot be read: it {said}"),
        Unopened::System(said) => format!("the file cannot be read: {said}"),
    }
}
