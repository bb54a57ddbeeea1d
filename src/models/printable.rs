/// Text from a file, fit for a message: on one line, what is not visible escaped, at most this many characters.
pub fn printable(text: &str, most: usize) -> String {
    let letters = text.chars().take(most).flat_map(|letter| {
        let is_visible = letter == ' ' || !(letter.is_control() || letter.is_whitespace());
        let escaped = (!is_visible).then(|| letter.escape_default());
        is_visible.then_some(letter).into_iter().chain(escaped.into_iter().flatten())
    });
    let mut line: String = letters.collect();
    if text.chars().nth(most).is_some() {
        line.push('…');
    }
    line
}

#[cfg(test)]
mod tests {
    use super::printable;

    #[test]
    fn text_stays_on_its_line_and_within_its_length() {
        assert_eq!(printable("a b\n\u{1b}c", 80), "a b\\n\\u{1b}c");
        assert_eq!(printable("0123456789", 4), "0123…");
        assert_eq!(printable("Tür", 3), "Tür");
    }
}
