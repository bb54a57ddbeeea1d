use super::PlaceInFile;

/// Something wrong at a place of a text, in one sentence.
#[derive(Debug)]
pub struct Mistake {
    /// Bytes before the place.
    pub at: usize,
    /// What is wrong, and what would be accepted.
    pub what: String,
}

impl Mistake {
    /// A slip at a place.
    pub fn new(at: usize, what: impl Into<String>) -> Self {
        Self { at, what: what.into() }
    }
}

/// Line and column of a byte, both from 1, a column a letter.
pub fn place_of(text: &str, at: usize) -> PlaceInFile {
    let before = text.get(..at).unwrap_or(text);
    let line = before.rsplit_once('\n').map_or(before, |(_, line)| line);
    PlaceInFile { line: 1 + before.matches('\n').count(), column: 1 + line.chars().count() }
}

/// The byte at a line and a column.
pub fn byte_at(text: &str, line: usize, column: usize) -> usize {
    let start: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    let rest = text.get(start..).unwrap_or("");
    start + rest.chars().take(column.saturating_sub(1)).map(char::len_utf8).sum::<usize>()
}
