//! Listings and printed lines made to fit the book's column: what is wider is broken between words.

use std::cmp::Reverse;

/// The characters of a monospaced line that fit the column at a window 1,280 pixels wide.
pub const COLUMNS: usize = 84;

/// Rust source: comments are filled anew, and code is broken at a space outside of strings.
pub fn source(listing: &str) -> String {
    let lines: Vec<&str> = listing.lines().collect();
    let mut out: Vec<String> = Vec::new();
    let mut at = 0;
    while at < lines.len() {
        let Some(head) = comment_head(lines[at]) else {
            out.extend(broken(lines[at], 8, true));
            at += 1;
            continue;
        };
        let is_same = |line: &&&str| is_plain(line, head) && comment_head(line) == Some(head);
        let end = at + lines[at..].iter().take_while(is_same).count().max(1);
        out.extend(filled(&lines[at..end], head));
        at = end;
    }
    out.join("\n")
}

/// Whether a line does not fit.
pub fn is_wide(line: &str) -> bool {
    width(line) > COLUMNS
}

/// What a program printed: a line that is too wide goes on below, indented.
pub fn printed(text: &str) -> String {
    text.lines().flat_map(|line| broken(line, 4, false)).collect::<Vec<_>>().join("\n")
}

/// The indentation and the marks of a line that is a comment only, and says something.
fn comment_head(line: &str) -> Option<&str> {
    let text = line.trim_start();
    let mark = ["/// ", "//! ", "// "].into_iter().find(|mark| text.starts_with(mark))?;
    Some(&line[..line.len() - text.len() + mark.len()])
}

/// Whether a comment with this head goes on with the line before it: a list, a heading or a table keeps its lines.
fn is_plain(line: &str, head: &str) -> bool {
    let kept = ["- ", "* ", "#", "|", "```", " "];
    line.strip_prefix(head).is_some_and(|says| !kept.iter().any(|start| says.starts_with(start)))
}

/// The lines of a comment, filled anew if one of them is too wide.
fn filled(lines: &[&str], head: &str) -> Vec<String> {
    if !lines.iter().any(|line| is_wide(line)) {
        return lines.iter().map(|&line| line.to_owned()).collect();
    }
    let (mut out, mut line) = (Vec::new(), head.trim_end().to_owned());
    for word in lines.iter().flat_map(|line| line[head.len()..].split_whitespace()) {
        if width(&line) + 1 + width(word) > COLUMNS && line != head.trim_end() {
            out.push(std::mem::replace(&mut line, head.trim_end().to_owned()));
        }
        line.push(' ');
        line.push_str(word);
    }
    out.push(line);
    out
}

/// A line in parts that fit, all but the first indented by so much more; within a string only where nothing else is left,
/// and then with the mark by which Rust reads on as if it were not broken. What a comment behind code says remains one.
fn broken(line: &str, further: usize, has_strings: bool) -> Vec<String> {
    let indent = line.len() - line.trim_start().len() + further;
    let (mut out, mut rest, mut begins_inside) = (Vec::new(), line.to_owned(), false);
    while is_wide(&rest) {
        let min = rest.len() - rest.trim_start().len();
        let quotes = |at: usize| usize::from(begins_inside) + rest[..at].matches('"').count();
        let comment = rest.match_indices("//").map(|(at, _)| at).find(|&at| has_strings && quotes(at) % 2 == 0);
        let is_comment = |at: usize| comment.is_some_and(|start| at > start);
        let is_outside = |at: usize| !has_strings || is_comment(at) || quotes(at) % 2 == 0;
        // A comment is not broken between its mark and its first word.
        let min = if is_comment(min + 1) { min + COMMENT.len() } else { min };
        let fits = |at: usize, mark: usize| at > min && width(&rest[..at]) + mark <= COLUMNS;
        let place = |of: &dyn Fn(usize) -> bool| rest.match_indices(' ').map(|(at, _)| at).rfind(|&at| of(at));
        // Code parts best behind what ends a part of it, and not so that brackets alone are left.
        let is_end = |at: usize| rest[..at].ends_with([',', ';', '{', '=', '&', '|']) && rest[at..].trim().len() > 4;
        let is_good = |at: usize| has_strings && at > COLUMNS / 2 && is_outside(at) && !is_comment(at) && is_end(at);
        // Of several such places the one within the fewest brackets, so that no call in it is torn apart.
        let depth = |at: usize| -> i32 {
            let sign = |byte| i32::from(b"([{".contains(byte)) - i32::from(b")]}".contains(byte));
            rest.as_bytes()[..at].iter().map(sign).sum()
        };
        let good = rest.match_indices(' ').map(|(at, _)| at).filter(|&at| fits(at, 0) && is_good(at));
        let good = good.min_by_key(|&at| (depth(at), Reverse(at)));
        let outside = good.or_else(|| place(&|at| fits(at, 0) && is_outside(at)));
        let Some(at) = outside.or_else(|| place(&|at| fits(at, MARK.len()))) else { break };
        let mark = if outside.is_some() { "" } else { MARK };
        let again = if is_comment(at) { COMMENT } else { "" };
        let next = format!("{}{again}{}", " ".repeat(indent), rest[at..].trim_start());
        // A part that is no shorter would be broken for ever.
        if next.len() >= rest.len() {
            break;
        }
        begins_inside = has_strings && !is_comment(at) && quotes(at) % 2 == 1;
        out.push(format!("{}{mark}", rest[..at].trim_end()));
        rest = next;
    }
    out.push(rest);
    out
}

/// What stands before the words of a comment that goes on below.
const COMMENT: &str = "// ";

/// What stands at the end of a line within a string that goes on below: the space, and a mark.
const MARK: &str = " \\";

fn width(text: &str) -> usize {
    text.chars().count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_fits_stays_as_it_is() {
        let listing = "/// A comment.\n/// Another.\nfn one() {\n    two(\"three\");\n}";
        assert_eq!(source(listing), listing);
        assert_eq!(printed(listing), listing);
    }

    #[test]
    fn no_call_is_torn_apart_where_another_place_is_as_good() {
        let text = source("    Thing(Plane { normal: V(0.0, 1.0, 0.0), height: -1.0 }, Matte(V(0.5, 0.6, 0.5, 0.5))),");
        assert_eq!(text.lines().last().map(str::trim), Some("Matte(V(0.5, 0.6, 0.5, 0.5))),"), "{text}");
    }

    #[test]
    fn a_long_string_goes_on_below() {
        let words = "word ".repeat(18);
        let text = source(&format!("    Chapter::new(\"cover\", \"{}\", scene)", words.trim_end()));
        let lines: Vec<&str> = text.lines().collect();
        assert!(lines.len() > 2 && lines.iter().all(|line| !is_wide(line)), "{text}");
        assert!(lines.iter().any(|line| line.ends_with("word \\")), "{text}");
        assert_eq!(text.replace(" \\\n", " ").matches("word").count(), 18);
    }

    #[test]
    fn comments_are_filled_anew_and_keep_their_words() {
        let long = format!(
            "    /// {}\n    /// last.\n    ///\n    /// - item {}",
            "word ".repeat(30).trim(),
            "x ".repeat(60)
        );
        let filled = source(&long);
        let words = |text: &str| -> Vec<String> {
            text.split_whitespace().filter(|word| *word != "///").map(str::to_owned).collect()
        };
        assert_eq!(words(&filled), words(&long));
        let comment: Vec<&str> = filled.lines().take_while(|line| line.trim() != "///").collect();
        assert_eq!(comment.len(), 3, "{filled}");
        assert!(comment.iter().all(|line| line.starts_with("    /// ") && width(line) <= COLUMNS), "{filled}");
        assert!(comment[2].ends_with("last."));
    }

    /// A comment behind code goes on below as one, whatever quotation marks it has; two strokes in a string are none.
    #[test]
    fn a_comment_behind_code_stays_a_comment() {
        let words = "one \"two three".to_owned() + &" word".repeat(30);
        let text = source(&format!("    let a = call(\"x // y\"); // {words}"));
        let lines: Vec<&str> = text.lines().collect();
        assert!(lines.len() > 2 && lines[0].starts_with("    let a = call(\"x // y\"); // one"), "{text}");
        assert!(lines[1..].iter().all(|line| line.trim_start().starts_with("// ") && !is_wide(line)), "{text}");
        let said: Vec<&str> = lines.iter().filter_map(|line| line.rsplit("// ").next()).collect();
        assert_eq!(said.join(" "), words);
        assert!(!text.contains('\\'), "{text}");
    }

    /// What goes on below is a comment, too.
    #[test]
    fn no_part_of_a_comment_becomes_code() {
        for start in ["`name` is", "- item", "| cell", "*Stressed*", "-1 is"] {
            let text = source(&format!("    /// {start} {}\n    fn one()", "word ".repeat(30).trim()));
            let lines: Vec<&str> = text.lines().collect();
            let (code, comment) = lines.split_last().expect("a line");
            assert!(comment.len() > 1 && comment.iter().all(|line| line.starts_with("    /// ")), "{text}");
            assert_eq!(*code, "    fn one()");
        }
        let filled = source(&format!("/// {}\n/// `name` is one of them.", "word ".repeat(20).trim()));
        assert!(filled.ends_with("word `name` is one of them."), "{filled}");
    }

    #[test]
    fn code_and_output_go_on_below_and_lose_nothing() {
        let call = format!("    let sum = {};", ["one_of_many"; 12].join(" + "));
        let text = source(&call);
        assert!(text.lines().count() == 3 && text.lines().all(|line| width(line) <= COLUMNS), "{text}");
        assert!(text.lines().skip(1).all(|line| line.starts_with(&" ".repeat(12))), "{text}");
        let squeezed = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(squeezed(&text), squeezed(&call));
        let string = format!("let a = \"{}\";", "never broken ".repeat(12));
        assert_eq!(source(&string), string);
        let head = format!("fn share(one: Distances, {}: f64, distance_squared: f64)", "b".repeat(40));
        assert!(
            source(&head).starts_with(&format!("fn share(one: Distances, {}: f64,\n        distance", "b".repeat(40)))
        );
        let number = "1".repeat(200);
        assert_eq!(printed(&number), number);
    }
}
