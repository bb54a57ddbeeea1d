use std::borrow::Cow;

/// The lines of a text, numbered from 1, without comments; a line that ends with a backslash goes on in the next.
///
/// They end as on any system: with a line feed, a carriage return or both.
pub fn lines(text: &[u8]) -> impl Iterator<Item = (usize, Cow<'_, [u8]>)> {
    let mut physical = physical_lines(text).enumerate();
    std::iter::from_fn(move || {
        let (number, line) = physical.next()?;
        let Some(begun) = goes_on(line) else { return Some((number + 1, Cow::Borrowed(without_comment(line)))) };
        let mut whole = begun.to_vec();
        for (_, line) in physical.by_ref() {
            whole.push(b' ');
            match goes_on(line) {
                Some(part) => whole.extend_from_slice(part),
                None => {
                    whole.extend_from_slice(without_comment(line));
                    break;
                }
            }
        }
        Some((number + 1, Cow::Owned(whole)))
    })
}

/// The lines as they stand in the text.
fn physical_lines(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    let by_return = text.windows(2).any(|pair| pair[0] == b'\r' && pair[1] != b'\n') || !text.contains(&b'\n');
    let mut rest = Some(text);
    std::iter::from_fn(move || {
        let text = rest?;
        let end = text.iter().position(|byte| *byte == b'\n' || by_return && *byte == b'\r');
        let Some(end) = end else {
            rest = None;
            return Some(text);
        };
        let both = text[end] == b'\r' && text.get(end + 1) == Some(&b'\n');
        rest = Some(&text[end + if both { 2 } else { 1 }..]);
        let line = &text[..end];
        Some(line.strip_suffix(b"\r").unwrap_or(line))
    })
}

/// What stands before a backslash at the end of a line; a comment does not go on.
fn goes_on(line: &[u8]) -> Option<&[u8]> {
    let line = line.strip_suffix(b"\r").unwrap_or(line);
    (line.last() == Some(&b'\\') && without_comment(line).len() == line.len()).then(|| &line[..line.len() - 1])
}

/// A comment begins a line or follows a space: file names may have the sign in them.
fn without_comment(line: &[u8]) -> &[u8] {
    let mut from = 0;
    while let Some(at) = line[from..].iter().position(|byte| *byte == b'#').map(|ahead| from + ahead) {
        if at == 0 || line[at - 1].is_ascii_whitespace() {
            return &line[..at.saturating_sub(1)];
        }
        from = at + 1;
    }
    line
}

/// What follows a line's first word, without spaces about it, as text.
pub fn rest_of(line: &[u8]) -> Cow<'_, str> {
    let line = line.trim_ascii();
    let end = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
    String::from_utf8_lossy(line[end..].trim_ascii())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split(text: &str) -> Vec<(usize, String)> {
        lines(text.as_bytes()).map(|(number, line)| (number, String::from_utf8_lossy(&line).into_owned())).collect()
    }

    fn line(number: usize, text: &str) -> (usize, String) {
        (number, text.into())
    }

    #[test]
    fn a_backslash_joins_two_lines() {
        assert_eq!(split("f 1 \\\n2 3\nv 0"), [line(1, "f 1  2 3"), line(3, "v 0")]);
        assert_eq!(split("f 1\\\r\n2\\\n3\nv"), [line(1, "f 1 2 3"), line(4, "v")]);
        assert_eq!(split("f 1 \\"), [line(1, "f 1 ")]);
    }

    #[test]
    fn comments_are_left_out() {
        assert_eq!(split("# all\nv 1 # end\nusemtl a#1"), [line(1, ""), line(2, "v 1"), line(3, "usemtl a#1")]);
        assert_eq!(split("usemtl a#1 ##\n #"), [line(1, "usemtl a#1"), line(2, "")]);
        assert_eq!(split("f 1 # \\\n2"), [line(1, "f 1"), line(2, "2")]);
        assert_eq!(split("# C:\\models\\\nv 1\\\n2 # \\\nf"), [line(1, ""), line(2, "v 1 2"), line(4, "f")]);
    }

    #[test]
    fn lines_end_as_on_any_system() {
        for end in ["\n", "\r\n", "\r"] {
            let text = ["v 1", "", "# a", "f 1 \\", "2", "g"].join(end);
            let expected = [line(1, "v 1"), line(2, ""), line(3, ""), line(4, "f 1  2"), line(6, "g")];
            assert_eq!(split(&text), expected, "{end:?}");
        }
        assert_eq!(split("v 1\r\nv 2\rv 3\n"), [line(1, "v 1"), line(2, "v 2"), line(3, "v 3"), line(4, "")]);
    }

    #[test]
    fn the_rest_of_a_line_keeps_its_spaces_within() {
        assert_eq!(rest_of(b"  usemtl  red  brick \r"), "red  brick");
        assert_eq!(rest_of(b"usemtl"), "");
        assert_eq!(rest_of(b"usemtl \xff"), "\u{fffd}");
    }
}
