use pinhole_models::is_invisible;
use std::path::Path;

/// The longest path that a message shows whole, in characters.
const LONGEST_PATH: usize = 160;

/// The longest message, in characters.
const LONGEST_MESSAGE: usize = 2000;

/// Text from a file or a command line, made safe for a message: on one line, with control characters and invisible
/// characters escaped, and shortened in the middle to at most `max` characters.
pub fn printable(text: &str, max: usize) -> String {
    // No text has more characters than bytes, so a short one need not be counted, nor a long one to its end.
    let is_long = text.len() > max && text.chars().nth(max).is_some();
    if !is_long {
        return escaped(text.chars());
    }
    let after = max.saturating_sub(1) / 3;
    let before = max.saturating_sub(1) - after;
    let end: Vec<char> = text.chars().rev().take(after).collect();
    format!("{}…{}", escaped(text.chars().take(before)), escaped(end.into_iter().rev()))
}

/// A path as a message may show it.
pub fn printable_path(path: &Path) -> String {
    printable(&path.to_string_lossy(), LONGEST_PATH)
}

/// An error as the program's last message may show it.
pub fn printable_message(error: &impl std::fmt::Display) -> String {
    printable(&error.to_string(), LONGEST_MESSAGE)
}

fn escaped(letters: impl Iterator<Item = char>) -> String {
    let mut line = String::new();
    for letter in letters {
        if letter.is_control() || is_invisible(letter) {
            line.extend(letter.escape_default());
        } else {
            line.push(letter);
        }
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_would_obey_is_escaped() {
        let text = "a\u{1b}[2Jb\nc\u{7}\u{9b}31m";
        assert_eq!(printable(text, 80), r"a\u{1b}[2Jb\nc\u{7}\u{9b}31m");
        for letter in ['\u{200e}', '\u{200f}', '\u{61c}', '\u{202a}', '\u{202e}', '\u{2066}', '\u{2069}', '\u{7f}'] {
            assert_eq!(printable(&letter.to_string(), 80), letter.escape_unicode().to_string());
        }
        assert_eq!(printable("Tür, 球, שלום", 80), "Tür, 球, שלום", "ordinary letters stay");
    }

    #[test]
    fn long_text_loses_its_middle() {
        assert_eq!(printable("0123456789", 10), "0123456789");
        assert_eq!(printable("0123456789a", 10), "012345…89a");
        assert_eq!(printable(&"ü".repeat(1 << 20), 7), "üüüü…üü");
        assert_eq!(printable("ab", 0), "…");
    }
}
