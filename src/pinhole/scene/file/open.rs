use super::{FileProblem, SceneFile};
use crate::scene::{FileError, FileKind, Unopened, read_file};
use std::io::Read;
use std::path::Path;

const SCENE_FILE: FileKind = FileKind { name: "a scene file", most: 16 << 20 };

impl SceneFile {
    /// Reads a scene from a file.
    ///
    /// Errors: it cannot be read, is no text, is larger than 16 MiB, or holds a slip; with line and column where there
    /// is a place to be told.
    pub fn open(path: &Path) -> Result<Self, FileProblem> {
        let bytes = read_file(path, SCENE_FILE).map_err(|refused| FileProblem::of(path, told(refused)))?;
        Self::parse_bytes(path, bytes)
    }

    /// A scene from what can be read to its end, such as standard input; files that it names lie in the current folder.
    ///
    /// Errors: as for a file.
    pub fn read(name: &Path, from: impl Read) -> Result<Self, FileProblem> {
        let mut bytes = Vec::new();
        let most = SCENE_FILE.most;
        let read = from.take(most + 1).read_to_end(&mut bytes);
        read.map_err(|refused| FileProblem::of(name, format!("it cannot be read: {refused}")))?;
        if bytes.len() as u64 > most {
            let what = format!("there are more than {most} bytes, but a scene file has at most that many");
            return Err(FileProblem::of(name, what));
        }
        Self::parse_bytes(name, bytes)
    }

    /// A scene from the bytes of a file.
    pub fn parse_bytes(path: &Path, bytes: Vec<u8>) -> Result<Self, FileProblem> {
        match String::from_utf8(bytes) {
            Ok(text) => Self::parse(path, text),
            Err(refused) => {
                let good = refused.utf8_error().valid_up_to();
                let byte = refused.as_bytes().get(good).copied().unwrap_or_default();
                let text = String::from_utf8_lossy(refused.as_bytes().get(..good).unwrap_or(&[])).into_owned();
                let place = Some(super::mistake::place_of(&text, good));
                let what = format!("the byte 0x{byte:02x} is no UTF-8, but a scene file is text in UTF-8");
                Err(FileProblem { path: path.into(), place, what })
            }
        }
    }
}

/// Why a scene file was not read, where the file has been named before.
fn told(refused: FileError) -> String {
    let FileKind { name, most } = refused.kind;
    match refused.why {
        Unopened::Missing => "there is no such file".into(),
        Unopened::Folder => format!("this is a folder, but {name} is a text file"),
        Unopened::NotRegular => format!("this is no ordinary file, but {name} is a text file"),
        Unopened::TooLong(bytes) => format!("the file has {bytes} bytes, but {name} has at most {most}"),
        Unopened::System(said) => format!("the file cannot be read: {said}"),
    }
}
