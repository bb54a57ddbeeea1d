use crate::printable_path;
use std::fmt;
use std::path::{Path, PathBuf};

/// A position in a text file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlaceInFile {
    /// The line, from 1.
    pub line: usize,
    /// The column in characters, from 1.
    pub column: usize,
}

/// Why a scene file cannot be used; displayed as one sentence that begins with file, line and column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileProblem {
    /// The file's path as it was given.
    pub path: PathBuf,
    /// The position of the problem, if it has one.
    pub place: Option<PlaceInFile>,
    /// What is wrong, and what is accepted.
    pub what: String,
}

impl FileProblem {
    /// A problem of the file as a whole.
    pub fn of(path: &Path, what: impl Into<String>) -> Self {
        Self { path: path.into(), place: None, what: what.into() }
    }
}

impl fmt::Display for FileProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:", printable_path(&self.path))?;
        if let Some(PlaceInFile { line, column }) = self.place {
            write!(f, "{line}:{column}:")?;
        }
        write!(f, " {}", self.what)
    }
}

impl std::error::Error for FileProblem {}
