/// Text from a file, fit for a message: on one line, what is not visible escaped, at most this many characters.
pub fn printable(text: &str, max: usize) -> String {
    let letters = text.chars().take(max).flat_map(|letter| {
        let is_visible = letter == ' ' || !(letter.is_control() || letter.is_whitespace() || is_invisible(letter));
        let escaped = (!is_visible).then(|| letter.escape_default());
        is_visible.then_some(letter).into_iter().chain(escaped.into_iter().flatten())
    });
    let mut line: String = letters.collect();
    if text.chars().nth(max).is_some() {
        line.push('…');
    }
    line
}

/// Whether a character is not visible itself and changes how others are shown: direction controls, line separators,
/// joiners and tags.
pub fn is_invisible(letter: char) -> bool {
    matches!(
        letter,
        '\u{ad}'
            | '\u{61c}'
            | '\u{180e}'
            | '\u{200b}'..='\u{200f}'
            | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}'
            | '\u{feff}'
            | '\u{fff9}'..='\u{fffb}'
            | '\u{e0000}'..='\u{e0fff}'
    )
}

#[cfg(test)]
mod tests {
    use super::printable;

    #[test]
    fn text_stays_on_its_line_and_within_its_length() {
        assert_eq!(printable("a b\n\u{1b}c", 80), "a b\\n\\u{1b}c");
        assert_eq!(
            printable("\u{202e}gnp.exe\u{2028}\u{9b}31m\u{e0041}", 80),
            "\\u{202e}gnp.exe\\u{2028}\\u{9b}31m\\u{e0041}"
        );
        assert_eq!(printable("0123456789", 4), "0123…");
        assert_eq!(printable("Tür", 3), "Tür");
    }
}
