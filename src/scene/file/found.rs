//! How messages show what stands in a file: short, on one line, and nothing that a terminal would obey.

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

/// A piece of a file on one line, cut where it is long.
pub fn shown(piece: &str) -> String {
    let mut line = String::new();
    let words = piece.split_whitespace().enumerate();
    let spaced = words.flat_map(|(count, word)| (count > 0).then_some(' ').into_iter().chain(word.chars()));
    for (count, letter) in spaced.enumerate() {
        if count == MOST_LETTERS {
            line.push('…');
            break;
        }
        if letter.is_control() || is_format(letter) {
            line.extend(letter.escape_unicode());
        } else {
            line.push(letter);
        }
    }
    line
}

/// Letters that are not seen and change how others are shown.
fn is_format(letter: char) -> bool {
    matches!(letter, '\u{ad}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{feff}')
}
