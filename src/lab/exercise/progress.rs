use pinhole::Result;
use pinhole::film::{Replaces, set_aside, write_whole};
use pinhole::scene::{FileError, FileKind, Unopened, printable_path, read_file};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;

const PROGRESS: FileKind = FileKind { name: "a record of progress", max: 1 << 20 };

/// How often each exercise was tried, and with what result, by the chapter's name.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Progress(pub BTreeMap<String, Tries>);

/// The tries of one exercise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Tries {
    /// Tries altogether; looking at a stub is none.
    pub tried: u32,
    /// Wrong tries since it was last right whose mistake was not named; each brings a further hint.
    pub wrong: u32,
    /// Whether the last try was right, for ordinary inputs at least.
    pub done: bool,
    /// Whether it was right for extreme inputs, too, where the exercise has any.
    pub extremes: bool,
}

impl Progress {
    /// Reads the file; without it, nothing was tried yet.
    ///
    /// A file that cannot be understood is renamed, so that nothing in it is lost, and the second value says so.
    pub fn read(file: &Path) -> (Self, Option<String>) {
        let text = match read_file(file, PROGRESS) {
            Ok(text) => text,
            Err(FileError { why: Unopened::Missing, .. }) => return (Self::default(), None),
            Err(refused) => return (Self::default(), Some(format!("progress is not read: {refused}"))),
        };
        match serde_json::from_slice(&text) {
            Ok(progress) => (progress, None),
            Err(wrong) => (Self::default(), Some(damaged(file, &wrong.to_string()))),
        }
    }

    /// Writes the file whole, or leaves what was there; what is no record of progress stays.
    ///
    /// Errors: the path and what the system said.
    pub fn write(&self, file: &Path) -> Result {
        let is_progress =
            |file: &Path| read_file(file, PROGRESS).is_ok_and(|text| serde_json::from_slice::<Self>(&text).is_ok());
        write_whole(Replaces::If(&is_progress).at(file), |out| {
            serde_json::to_writer_pretty(&mut *out, self)?;
            writeln!(out)
        })
    }

    /// The tries of a chapter's exercise.
    pub fn of(&self, chapter: &str) -> Tries {
        self.0.get(chapter).copied().unwrap_or_default()
    }
}

/// Sets a damaged file aside, and says what was done.
fn damaged(file: &Path, wrong: &str) -> String {
    let damaged = format!("{} is damaged ({wrong})", printable_path(file));
    match set_aside(file, "damaged.json") {
        Ok(aside) => format!("{damaged}; it is set aside as {}, and counting starts anew", printable_path(&aside)),
        Err(refused) => format!("{damaged} and cannot be set aside ({refused}), so no try is remembered"),
    }
}
