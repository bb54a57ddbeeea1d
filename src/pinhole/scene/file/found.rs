//! How messages show what stands in a file: short, on one line, and nothing that a terminal would obey.

use crate::scene::printable;

/// The most letters of a file that a message repeats.
const MOST_LETTERS: usize = 40;

/// What stands at a place: a word, a number, a text in quotes, or one letter.
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

/// A piece of a file on one line, its white space as single spaces, cut where it is long.
pub fn shown(piece: &str) -> String {
    let words: Vec<&str> = piece.split_whitespace().collect();
    printable(&words.join(" "), MOST_LETTERS)
}
