use crate::plan::PlanError;
use crate::scene::{FileProblem, SceneError, printable_path};
use std::fmt;
use std::io;
use std::path::PathBuf;
use thiserror::Error;

/// What the kit's functions answer.
pub type Result<T = ()> = std::result::Result<T, Error>;

/// Everything that can go wrong, each in one sentence.
#[derive(Error)]
pub enum Error {
    /// The scene cannot be rendered.
    #[error(transparent)]
    SceneError(#[from] SceneError),
    /// A scene file cannot be used.
    #[error(transparent)]
    File(#[from] FileProblem),
    /// No plan can be made.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// A file cannot be written.
    #[error("cannot write {}: {source}", printable_path(path))]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// What was asked for cannot be done, or does not hold.
    #[error("{0}")]
    Usage(String),
    /// The reader stopped the render.
    #[error("stopped before the picture was done; nothing was written")]
    Interrupted,
    /// The reader stopped a render that can be continued.
    #[error("{0}")]
    Stopped(String),
    /// Printing failed.
    #[error("cannot print: {0}")]
    Print(#[from] io::Error),
}

/// The same sentence, so that `fn main() -> pinhole::Result` prints it.
impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
