//! How messages quote a file: shortened, on one line, with control characters escaped.

use crate::printable;

/// The longest quotation, in characters.
const MAX_LETTERS: usize = 40;

/// The token at a byte offset: a word, a number, a quoted string, or a single character.
pub fn found(text: &str, at: usize) -> String {
    let rest = text.get(at..).unwrap_or("");
    let Some(first) = rest.chars().next() else { return "the end of the file".into() };
    let in_word = |letter: char| letter.is_alphanumeric() || "_.+-#".contains(letter);
    let length = if first == '"' {
        rest[1..].find(['"', '\n']).map_or(rest.len(), |end| end + 2).min(rest.len())
    } else if in_word(first) {
        rest.find(|letter| !in_word(letter)).unwrap_or(rest.len())
    } else {
        first.len_utf8()
    };
    format!("`{}`", shown(rest.get(..length).unwrap_or(rest)))
}

/// A part of a file on one line, with its white space collapsed, shortened if it is long.
pub fn shown(part: &str) -> String {
    let words: Vec<&str> = part.split_whitespace().collect();
    printable(&words.join(" "), MAX_LETTERS)
}
