use crate::printable::printable;
use std::fmt;
use thiserror::Error;

/// Why a model file cannot be read; displayed as one sentence with the file, the place in it, the value and what would
/// be accepted.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{file}: {place} is {value}, but {accepted}")]
pub struct ModelError {
    /// The name of the file.
    pub file: String,
    /// The place in it, such as `accessors[3].count`.
    pub place: String,
    /// The offending value, as the file has it.
    pub value: String,
    /// What would be accepted.
    pub accepted: String,
}

impl ModelError {
    /// An error from its four parts.
    pub(super) fn new(
        file: &str,
        place: impl fmt::Display,
        value: impl fmt::Display,
        accepted: impl fmt::Display,
    ) -> Self {
        let place = place.to_string();
        Self { file: printable(file, 200), place, value: value.to_string(), accepted: accepted.to_string() }
    }
}

/// Words of a file as messages show them.
pub(super) fn shown(words: &str) -> String {
    format!("\"{}\"", printable(words, 80))
}

/// Bytes of a file as messages show them.
pub(super) fn shown_bytes(bytes: &[u8]) -> String {
    // Four bytes a character at most.
    shown(&String::from_utf8_lossy(&bytes[..bytes.len().min(400)]))
}
