use pinhole::scene::is_invisible;
use std::io::{Result, Write};

/// What a terminal is sent: text in which every letter is escaped that is not shown as itself, whichever file or entity it
/// is the name of; and bytes that are no text, such as a picture's, as they are.
pub struct Visible<'w>(pub &'w mut dyn Write);

impl Write for Visible<'_> {
    fn write(&mut self, bytes: &[u8]) -> Result<usize> {
        match std::str::from_utf8(bytes) {
            Ok(text) if text.contains(is_hidden) => self.0.write_all(visible(text).as_bytes())?,
            _ => self.0.write_all(bytes)?,
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> Result<()> {
        self.0.flush()
    }
}

/// Whether a terminal obeys a letter, or shows others differently because of it.
pub fn is_hidden(letter: char) -> bool {
    (letter.is_control() && letter != '\n') || is_invisible(letter)
}

/// The same text with every hidden letter escaped as Rust and RON write it.
pub fn visible(text: &str) -> String {
    let mut visible = String::with_capacity(text.len());
    for letter in text.chars() {
        if is_hidden(letter) {
            visible.extend(letter.escape_unicode());
        } else {
            visible.push(letter);
        }
    }
    visible
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_shown_and_pictures_stay() {
        let mut out = Vec::new();
        let name = "\u{1b}[31m\t\u{202e}\u{9b}\r";
        writeln!(Visible(&mut out), "a{name}b").expect("written");
        Visible(&mut out).write_all(b"\x89PNG\r\n\x1a\n").expect("written");
        assert_eq!(out, b"a\\u{1b}[31m\\u{9}\\u{202e}\\u{9b}\\u{d}b\n\x89PNG\r\n\x1a\n");
    }
}
