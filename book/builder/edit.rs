//! Changes to a page, found on the text as its author wrote it so that line numbers stay true.

use std::ops::Range;

/// Replace these bytes by that text; an empty range inserts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Edit {
    /// Which bytes of the page.
    pub range: Range<usize>,
    /// What stands there instead.
    pub text: String,
}

/// Applies edits that do not overlap.
pub fn apply(text: &str, mut edits: Vec<Edit>) -> String {
    edits.sort_by_key(|edit| (edit.range.start, edit.range.end));
    let mut done = 0;
    let mut result = String::with_capacity(text.len());
    for edit in edits {
        result.push_str(&text[done..edit.range.start]);
        result.push_str(&edit.text);
        done = edit.range.end;
    }
    result + &text[done..]
}

/// Makes text safe inside an HTML element or a double-quoted attribute.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edits_are_applied_in_order() {
        let edit = |range, text: &str| Edit { range, text: text.to_owned() };
        assert_eq!(apply("abcdef", vec![edit(4..5, "E"), edit(1..1, "-"), edit(1..3, "")]), "a-dEf");
    }
}
