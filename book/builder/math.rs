//! Formulas: `$…$` and `$$…$$` become MathML, which a browser draws without scripts, fonts or network.

use crate::edit::{Edit, apply};
use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};
use pulldown_latex::config::{DisplayMode, RenderConfig};
use pulldown_latex::{Storage, push_mathml};
use std::error::Error;
use std::ops::Range;

/// A formula, or a `$` that belongs to none, that cannot be shown.
#[derive(Debug, PartialEq, Eq)]
pub struct Mistake {
    /// Where in the text.
    pub at: usize,
    /// One sentence.
    pub what: String,
}

/// The options of mdBook's own reading, and formulas.
fn options() -> Options {
    Options::ENABLE_TABLES
        | Options::ENABLE_FOOTNOTES
        | Options::ENABLE_STRIKETHROUGH
        | Options::ENABLE_HEADING_ATTRIBUTES
        | Options::ENABLE_GFM
        | Options::ENABLE_MATH
}

/// Finds every formula of a markdown text outside code, and what to put in its place.
pub fn edits(text: &str) -> (Vec<Edit>, Vec<Mistake>) {
    let (mut edits, mut mistakes) = (Vec::new(), Vec::new());
    let mut in_code = false;
    for (event, range) in Parser::new_ext(text, options()).into_offset_iter() {
        let found = match event {
            Event::Start(Tag::CodeBlock(_)) => {
                in_code = true;
                continue;
            }
            Event::End(TagEnd::CodeBlock) => {
                in_code = false;
                continue;
            }
            Event::InlineMath(latex) => formula(&latex, false),
            Event::DisplayMath(latex) => formula(&latex, true),
            Event::Text(_) if !in_code => {
                mistakes.extend(stray(text, range));
                continue;
            }
            _ => continue,
        };
        match found {
            Ok(mathml) => edits.push(with_punctuation(text, range, mathml)),
            Err(what) => mistakes.push(Mistake { at: range.start, what }),
        }
    }
    (edits, mistakes)
}

/// A formula with the punctuation mark after it, which browsers would put at the start of the next line.
fn with_punctuation(text: &str, range: Range<usize>, mathml: String) -> Edit {
    let mark = text[range.end..].chars().next().filter(|next| ".,;:!?)".contains(*next));
    match (mark, mathml.rfind("<math")) {
        (Some(mark), Some(last)) if !mathml.ends_with("</span>") => {
            let (before, last) = mathml.split_at(last);
            let range = range.start..range.end + mark.len_utf8();
            Edit { range, text: format!("{before}<span class=\"whole\">{last}{mark}</span>") }
        }
        _ => Edit { range, text: mathml },
    }
}

/// A short text with its formulas converted.
pub fn expand(text: &str) -> Result<String, String> {
    let (edits, mistakes) = edits(text);
    match mistakes.into_iter().next() {
        Some(mistake) => Err(mistake.what),
        None => Ok(apply(text, edits)),
    }
}

/// A `$` that markdown took for plain text is most often half a formula.
fn stray(text: &str, range: Range<usize>) -> Option<Mistake> {
    let here = |at: &usize| !text[..*at].ends_with('\\');
    let at = text[range.clone()].match_indices('$').map(|(at, _)| range.start + at).find(here)?;
    let what = "a `$` stands alone: a formula is $x$, without a space just inside; for a dollar sign write `\\$`.";
    Some(Mistake { at, what: what.to_owned() })
}

fn formula(latex: &str, display: bool) -> Result<String, String> {
    let latex = latex.trim();
    let storage = Storage::new();
    let broken = |error: &dyn std::fmt::Display| format!("the formula `{latex}` cannot be read: {error}.");
    if let Some(error) = pulldown_latex::Parser::new(latex, &storage).find_map(Result::err) {
        // The error's own text draws a box over several lines; its cause is the sentence.
        return Err(match error.source() {
            Some(cause) => broken(cause),
            None => broken(&error),
        });
    }
    let mode = if display { DisplayMode::Block } else { DisplayMode::Inline };
    let config = RenderConfig { display_mode: mode, ..RenderConfig::default() };
    let mut mathml = String::new();
    let parser = pulldown_latex::Parser::new(latex, &storage);
    push_mathml(&mut mathml, parser, config).map_err(|error| broken(&error))?;
    // pulldown-latex 0.8 escapes its own `&nbsp;` once too often.
    let spaces = mathml.replace("&amp;nbsp;", "\u{a0}").replace("&nbsp;", "\u{a0}");
    let mathml = spaces_before_scripts(&spaces.replace('\n', " "));
    let mathml = guarded(&breakable(&mathml, display).unwrap_or(mathml));
    Ok(if display { format!("<span class=\"formula\">{mathml}</span>") } else { mathml })
}

/// pulldown-latex 0.8 puts the space before a function into the function's own exponent: `x\cos^2 y` gives an `msup` of
/// three parts, which browsers draw as small letters in a row.
fn spaces_before_scripts(mathml: &str) -> String {
    let mut result = mathml.to_owned();
    for tag in ["<msup>", "<msub>", "<msubsup>"] {
        while let Some(at) = result.find(&format!("{tag}<mspace ")) {
            let Some(length) = result[at + tag.len()..].find("/>") else { break };
            let space = result[at + tag.len()..at + tag.len() + length + 2].to_owned();
            result.replace_range(at..at + tag.len() + space.len(), &format!("{space}{tag}"));
        }
    }
    result
}

/// Browsers do not break a formula, but they break a line between two: a long one becomes a row of shorter ones, parted
/// where a hand would part it. Nothing, where there is no such place.
fn breakable(mathml: &str, display: bool) -> Option<String> {
    let (tag, body) = mathml.strip_suffix("</math>")?.split_once('>')?;
    let (mut pieces, mut inside, mut is_wide_space) = (vec![String::new()], 0_usize, false);
    let mut is_between_bars = false;
    for element in elements(body) {
        // A bracket may have an exponent.
        let base =
            ["<msup>", "<msub>", "<msubsup>"].iter().find_map(|tag| element.strip_prefix(tag)).unwrap_or(element);
        let is_letter = (base.starts_with("<mo") && !base.starts_with("<mover")) || base.starts_with("<mi");
        let says =
            base.split_once('>').and_then(|(_, rest)| rest.split('<').next()).filter(|_| is_letter).unwrap_or_default();
        let is_operator = element.starts_with("<mo") && is_letter;
        let is_place = is_wide_space || (is_operator && RELATIONS_AND_SIGNS.contains(&says));
        let piece = match pieces.last_mut() {
            Some(piece) if !is_place || inside > 0 || is_between_bars || piece.is_empty() => piece,
            _ => {
                pieces.push(String::new());
                pieces.last_mut()?
            }
        };
        // What joins two terms keeps its spaces at the beginning of a piece.
        let joins = is_operator && !is_wide_space && RELATIONS_AND_SIGNS.contains(&says);
        let is_first = piece.is_empty() && joins && pieces.len() > 1;
        let element = if is_first { element.replacen("<mo", "<mo form=\"infix\"", 1) } else { element.to_owned() };
        pieces.last_mut()?.push_str(&element);
        match says {
            "(" | "[" | "{" => inside += 1,
            ")" | "]" | "}" => inside = inside.saturating_sub(1),
            "|" | "‖" | "∥" => is_between_bars = !is_between_bars,
            _ => {}
        }
        is_wide_space = WIDE_SPACES.iter().any(|width| element.starts_with(&format!("<mspace width=\"{width}")));
    }
    let letters = |piece: &String| {
        piece.split('<').filter_map(|part| part.split_once('>')).map(|(_, text)| text.len()).sum::<usize>()
    };
    let is_long = display || pieces.iter().map(letters).sum::<usize>() > LONG;
    let tag = if display { "<math displaystyle=\"true\"" } else { tag };
    (is_long && pieces.len() > 1).then(|| pieces.iter().map(|piece| format!("{tag}>{piece}</math>")).collect())
}

/// Where a long formula is parted: before these, and after a wide space.
const RELATIONS_AND_SIGNS: [&str; 12] = ["=", "≈", "≤", "≥", "&lt;", "&gt;", "∝", "≪", "→", "+", "−", "⋅"];

/// How the widths of `\;`, `\quad` and `\qquad` begin.
const WIDE_SPACES: [&str; 3] = ["0.27", "1em", "2em"];

/// Within a sentence, formulas of more letters than this are parted.
const LONG: usize = 24;

/// The elements that stand directly in a text of MathML.
fn elements(body: &str) -> Vec<&str> {
    let (mut found, mut depth, mut begun) = (Vec::new(), 0_usize, 0);
    for (at, _) in body.match_indices('<') {
        let end = body[at..].find('>').map_or(body.len(), |length| at + length + 1);
        match &body[at..end] {
            tag if tag.starts_with("</") => depth = depth.saturating_sub(1),
            tag if !tag.ends_with("/>") => depth += 1,
            _ => {}
        }
        if depth == 0 {
            found.push(&body[begun..end]);
            begun = end;
        }
    }
    found
}

/// The MathML goes through markdown once more: what markdown would read as marks is written by number.
fn guarded(mathml: &str) -> String {
    let mut inside_tag = false;
    let mut inside_entity = false;
    let mut result = String::with_capacity(mathml.len());
    for letter in mathml.chars() {
        match letter {
            '<' => inside_tag = true,
            '>' => inside_tag = false,
            '&' => inside_entity = true,
            ';' if inside_entity => inside_entity = false,
            _ => {}
        }
        let plain = inside_tag || inside_entity || !letter.is_ascii_punctuation() || "<>;".contains(letter);
        if plain {
            result.push(letter);
        } else {
            result.push_str(&format!("&#{};", u32::from(letter)));
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_become_mathml() {
        let text = expand("the angle $\\theta$ is").expect("a formula");
        assert!(text.starts_with("the angle <math"), "{text}");
        assert!(text.contains("<mi>θ</mi>") && text.ends_with("</math> is"), "{text}");
        let text = expand("by $\\theta$. So").expect("a formula");
        assert!(text.starts_with("by <span class=\"whole\"><math") && text.ends_with("</math>.</span> So"), "{text}");
        let text = expand("$$\n\\frac{a}{b}\n$$").expect("a formula");
        assert!(text.starts_with("<span class=\"formula\"><math display=\"block\""), "{text}");
        let space = expand("$a,\\ b$").expect("a formula");
        assert!(space.contains("<mtext>\u{a0}</mtext>"), "{space}");
        assert!(text.contains("<mfrac>") && !text.contains('\n'), "{text}");
    }

    #[test]
    fn a_long_formula_is_parted_where_a_hand_would_part_it() {
        let pieces = |latex: &str| {
            let text = expand(latex).expect("a formula");
            let says =
                |part: &str| part.split('<').filter_map(|part| part.split_once('>')).map(|(_, text)| text).collect();
            let pieces: Vec<String> = text.split("<math").skip(1).map(says).collect();
            pieces
                .iter()
                .map(|piece| {
                    piece
                        .replace("&#40;", "(")
                        .replace("&#41;", ")")
                        .replace("&#43;", "+")
                        .replace("&#61;", "=")
                        .replace("&#124;", "|")
                })
                .collect::<Vec<_>>()
        };
        assert_eq!(
            pieces("$$a = (b + c)^2d + |e - f|^2 \\qquad g = \\frac{h + i}{j}$$"),
            ["a", "=(b+c)2d", "+|e−f|2", "g", "=h+ij"]
        );
        assert_eq!(pieces("$a = b + c$").len(), 1, "it is short");
        assert_eq!(pieces("$0.1234 \\cdot 0.5678 + 0.1234 \\cdot 0.5678 = 0.1401$").len(), 5);
        assert_eq!(pieces("$$\\frac{a + b}{c}$$").len(), 1, "there is no place");
        let text = expand("$$a = b$$").expect("a formula");
        assert!(text.contains("<math displaystyle=\"true\"><mo form=\"infix\">"), "{text}");
        // A bar or a sign that begins a formula of its own keeps no space from what it stands before.
        let text = expand("$$a \\qquad \\lVert b \\rVert \\qquad -c$$").expect("a formula");
        assert!(!text.contains("infix") && text.matches("<math").count() == 3, "{text}");
    }

    #[test]
    fn a_function_keeps_its_exponent() {
        for latex in ["$x\\cos^2 y$", "$2\\sin_a\\cos^{n+1}\\beta$", "$x\\log_2^3 y$"] {
            let text = expand(latex).expect("a formula");
            assert!(
                !["<msup><mspace", "<msub><mspace", "<msubsup><mspace"].iter().any(|mistake| text.contains(mistake)),
                "{text}"
            );
        }
        let text = expand("$x\\cos^2 y$").expect("a formula");
        assert!(text.contains("/><msup><mi>cos</mi><mn>2</mn></msup>"), "{text}");
    }

    #[test]
    fn code_is_left_alone() {
        for text in ["`$x$`", "``$x$ ` $y$``", "```text\n$x$ and $\n```", "    $x$", "\\$5 and \\$6", "<b title=\"$\">"]
        {
            assert_eq!(expand(text).as_deref(), Ok(text));
        }
    }

    #[test]
    fn what_markdown_would_read_is_guarded() {
        let text = expand("$a*b*c$ | $x_1' [y](z)$").expect("formulas");
        let inside: String = text.split('<').filter_map(|part| part.split_once('>')).map(|(_, text)| text).collect();
        assert!(!inside.contains(['*', '_', '[', '(', '\'']), "{text}");
    }

    #[test]
    fn a_broken_formula_is_named() {
        let told = expand("so $\\frac{a}$ is").expect_err("a mistake");
        assert!(told.starts_with("the formula `\\frac{a}` cannot be read: "), "{told}");
        let told = expand("so $\\nosuchthing$ is").expect_err("a mistake");
        assert!(told.starts_with("the formula `\\nosuchthing` cannot be read: "), "{told}");
        assert!(!told.contains('\n'), "{told}");
    }

    #[test]
    fn every_formula_of_the_book_can_be_read() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        let pages = crate::check::read_pages(&folder).expect("the pages can be read");
        for page in &pages {
            expand(&page.text).unwrap_or_else(|error| panic!("{}: {error}", page.label));
        }
        assert!(pages.iter().map(|page| edits(&page.text).0.len()).sum::<usize>() > 300);
    }

    #[test]
    fn half_a_formula_is_named() {
        let (_, mistakes) = edits("one\n\nx $ y\n\n`$`\n");
        assert_eq!(mistakes.len(), 1);
        assert_eq!(mistakes[0].at, 7);
        assert!(mistakes[0].what.starts_with("a `$` stands alone"));
    }
}
