use crate::plan::PlanError;
use crate::scene::{FileProblem, SceneError, printable_path};
use std::path::PathBuf;
use std::{fmt, io};
use thiserror::Error;

/// The result of pinhole's functions.
pub type Result<T = ()> = std::result::Result<T, Error>;

/// Everything that can go wrong, each displayed as one sentence.
#[derive(Error)]
pub enum Error {
    /// The scene cannot be rendered as it is.
    #[error(transparent)]
    SceneError(#[from] SceneError),
    /// A scene file cannot be used.
    #[error(transparent)]
    File(#[from] FileProblem),
    /// No plan can be made from the stages offered.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// A file cannot be written.
    #[error("cannot write {}: {source}", printable_path(path))]
    Write {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// A request that cannot be carried out, or a check that failed.
    #[error("{0}")]
    Usage(String),
    /// The render was interrupted and nothing was kept.
    #[error("stopped before the picture was done; nothing was written")]
    Interrupted,
    /// The render was interrupted and can be continued from its checkpoint.
    #[error("{0}")]
    Stopped(String),
    /// Printing failed.
    #[error("cannot print: {0}")]
    Print(#[from] io::Error),
}

/// The sentence of `Display`, so that `fn main() -> pinhole::Result` prints that.
impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
