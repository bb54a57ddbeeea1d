use super::error::Result;
use std::io::Write;

/// Where a command's words go.
pub struct Streams<'a> {
    /// What was asked for.
    pub out: &'a mut dyn Write,
    /// What is said besides: notes and warnings.
    pub notes: &'a mut dyn Write,
    /// Whether a person or a script waits, so that it is told how far a render is.
    pub waits: bool,
    /// Whether `out` is a terminal.
    pub terminal: bool,
}

impl Streams<'_> {
    /// Says a note or a warning at once.
    pub fn note(&mut self, note: &str) -> Result {
        writeln!(self.notes, "{note}")?;
        Ok(())
    }
}
