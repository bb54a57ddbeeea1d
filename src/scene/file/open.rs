use super::{FileProblem, SceneFile};
use std::fs::{self, File};
use std::io::{ErrorKind, Read};
use std::path::Path;

/// The largest scene file, in bytes.
const LARGEST: u64 = 16 << 20;

impl SceneFile {
    /// Reads a scene from a file.
    ///
    /// Errors: it cannot be read, is no text, is larger than 16 MiB, or holds a slip; with line and column where there
    /// is a place to be told.
    pub fn open(path: &Path) -> Result<Self, FileProblem> {
        let problem = |what: String| FileProblem::of(path, what);
        let metadata = fs::metadata(path).map_err(|refused| problem(unreadable(&refused)))?;
        if metadata.is_dir() {
            return Err(problem("this is a folder, but a scene file is a text file".into()));
        }
        if !metadata.is_file() {
            return Err(problem("this is no ordinary file, but a scene file is a text file".into()));
        }
        let mut bytes = Vec::new();
        let file = File::open(path).map_err(|refused| problem(unreadable(&refused)))?;
        file.take(LARGEST + 1).read_to_end(&mut bytes).map_err(|refused| problem(unreadable(&refused)))?;
        if bytes.len() as u64 > LARGEST {
            let size = metadata.len().max(bytes.len() as u64);
            let what = format!("the file has {size} bytes, but a scene file has at most {LARGEST}");
            return Err(problem(what));
        }
        Self::parse_bytes(path, bytes)
    }

    /// A scene from what can be read to its end, such as standard input; files that it names lie in the current folder.
    ///
    /// Errors: as for a file.
    pub fn read(name: &Path, from: impl Read) -> Result<Self, FileProblem> {
        let mut bytes = Vec::new();
        let read = from.take(LARGEST + 1).read_to_end(&mut bytes);
        read.map_err(|refused| FileProblem::of(name, unreadable(&refused)))?;
        if bytes.len() as u64 > LARGEST {
            let what = format!("there are more than {LARGEST} bytes, but a scene file has at most that many");
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
                let place = Some(super::slip::place_of(&text, good));
                let what = format!("the byte 0x{byte:02x} is no UTF-8, but a scene file is text in UTF-8");
                Err(FileProblem { path: path.into(), place, what })
            }
        }
    }
}

fn unreadable(refused: &std::io::Error) -> String {
    match refused.kind() {
        ErrorKind::NotFound => "there is no such file".into(),
        _ => format!("the file cannot be read: {refused}"),
    }
}
