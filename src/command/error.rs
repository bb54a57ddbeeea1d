use pinhole::plan::PlanError;
use pinhole::scene::{FileProblem, SceneError};
use std::{fmt, io};
use thiserror::Error;

/// What the commands answer.
pub type Result<T = ()> = std::result::Result<T, Error>;

/// Everything that can go wrong with a command, each in one sentence.
#[derive(Error)]
pub enum Error {
    /// The renderer or the laboratory failed.
    #[error(transparent)]
    Pinhole(#[from] pinhole::Error),
    /// The command line cannot be parsed, or asks for help.
    #[error("{0}")]
    Clap(Box<clap::Error>),
    /// Something is left to do, which the same command can do later.
    #[error("{0}")]
    Unfinished(String),
    /// A word of the command line names nothing that there is.
    #[error("{0}")]
    CommandLine(String),
}

impl Error {
    /// What was asked for cannot be done, or does not hold.
    pub fn usage(sentence: impl Into<String>) -> Self {
        pinhole::Error::Usage(sentence.into()).into()
    }
}

impl From<io::Error> for Error {
    fn from(error: io::Error) -> Self {
        Self::Pinhole(error.into())
    }
}

impl From<SceneError> for Error {
    fn from(error: SceneError) -> Self {
        Self::Pinhole(error.into())
    }
}

impl From<FileProblem> for Error {
    fn from(error: FileProblem) -> Self {
        Self::Pinhole(error.into())
    }
}

impl From<PlanError> for Error {
    fn from(error: PlanError) -> Self {
        Self::Pinhole(error.into())
    }
}

/// The same sentence, so that a `main` that answers with it prints it.
impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
