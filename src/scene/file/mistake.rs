use super::PlaceInFile;

/// A mistake in a text file: where it is, and one sentence about it.
#[derive(Debug)]
pub struct Mistake {
    /// Its byte offset.
    pub at: usize,
    /// What is wrong, and what is accepted.
    pub what: String,
}

impl Mistake {
    /// A mistake at a byte offset.
    pub fn new(at: usize, what: impl Into<String>) -> Self {
        Self { at, what: what.into() }
    }
}

/// Line and column of a byte offset, both from 1; columns count characters.
pub fn place_of(text: &str, at: usize) -> PlaceInFile {
    let before = text.get(..at).unwrap_or(text);
    let line = before.rsplit_once('\n').map_or(before, |(_, line)| line);
    PlaceInFile { line: 1 + before.matches('\n').count(), column: 1 + line.chars().count() }
}

/// The byte offset of a line and column.
pub fn byte_at(text: &str, line: usize, column: usize) -> usize {
    let start: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    let rest = text.get(start..).unwrap_or("");
    start + rest.chars().take(column.saturating_sub(1)).map(char::len_utf8).sum::<usize>()
}
