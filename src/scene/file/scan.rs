//! The structure of a file: entities, their words, and the byte range of each value.
//!
//! The contents of values are left to `ron`; only their brackets are matched here, in one pass over the text and
//! without recursion, so that everything has a position to report.

use super::found::{found, shown};
use super::mistake::{Mistake, place_of};
use std::ops::Range;

/// The deepest nesting of brackets within a value; components need three.
const DEEPEST: usize = 16;

/// The largest number of entities; each takes some hundreds of bytes of memory, however short its text.
const MAX_ENTITIES: usize = 1 << 20;

/// A word, and the value after its colon.
#[derive(Clone, Debug)]
pub struct Part<'t> {
    /// The word.
    pub word: &'t str,
    /// The word's byte offset.
    pub at: usize,
    /// The byte range of the value.
    pub value: Range<usize>,
}

/// The text of an entity.
#[derive(Clone, Debug)]
pub struct EntityText<'t> {
    /// The byte offset of its opening bracket.
    pub at: usize,
    /// Its words.
    pub parts: Vec<Part<'t>>,
}

/// Every entity of a file, in order.
pub fn entities(text: &str) -> Result<Vec<EntityText<'_>>, Mistake> {
    let mut cursor = Cursor { text, at: text.len() - text.trim_start_matches('\u{feff}').len() };
    cursor.skip_space()?;
    if cursor.rest().is_empty() {
        let what =
            "no list begins here, but a scene file is a list of entities, such as [(name: \"ball\", sphere: ())]";
        return Err(Mistake::new(cursor.at, what));
    }
    if !cursor.take('[') {
        return Err(cursor.expected("`[`, for a scene file is a list of entities"));
    }
    let mut entities = Vec::new();
    cursor.skip_space()?;
    while !cursor.take(']') {
        let at = cursor.at;
        if entities.len() == MAX_ENTITIES {
            return Err(Mistake::new(
                at,
                format!("one more entity begins here, but a file has at most {MAX_ENTITIES}"),
            ));
        }
        if !cursor.take('(') {
            return Err(cursor.expected("an entity, which begins with `(`, or the `]` that ends the list"));
        }
        let parts = cursor.parts().map_err(|mistake| unclosed(text, at, mistake))?;
        entities.push(EntityText { at, parts });
        cursor.skip_space()?;
        let comma = cursor.take(',');
        cursor.skip_space()?;
        if !comma && !cursor.rest().starts_with(']') {
            return Err(cursor.expected("`,` before the next entity, or the `]` that ends the list"));
        }
    }
    cursor.skip_space()?;
    if cursor.rest().is_empty() {
        Ok(entities)
    } else {
        Err(cursor.expected("nothing after the `]` that ends the list"))
    }
}

/// The fields of a component's value, such as `(radius: 1.0)`; empty if the value has another form.
pub fn fields(text: &str, value: Range<usize>) -> Vec<Part<'_>> {
    check_fields(text, value).unwrap_or_default()
}

/// The fields of a component's value.
///
/// Errors: the first mistake between the brackets.
pub fn check_fields(text: &str, value: Range<usize>) -> Result<Vec<Part<'_>>, Mistake> {
    let Some(inside) = text.get(..value.end) else { return Ok(Vec::new()) };
    let mut cursor = Cursor { text: inside, at: value.start };
    cursor.take_word();
    cursor.skip_space()?;
    if cursor.take('(') { cursor.parts() } else { Ok(Vec::new()) }
}

/// The name of an enum's variant with which a value begins; empty if it has another form.
pub fn variant(text: &str, value: Range<usize>) -> &str {
    Cursor { text, at: value.start }.take_word()
}

/// The byte offset after the bracket that opens a component's fields, if it has any.
pub fn after_bracket(text: &str, value: Range<usize>) -> Option<usize> {
    let mut cursor = Cursor { text: text.get(..value.end)?, at: value.start };
    cursor.take_word();
    cursor.skip_space().ok()?;
    cursor.take('(').then_some(cursor.at)
}

/// The byte ranges of the elements of a tuple or a list; empty if the value has another form.
pub fn elements(text: &str, value: Range<usize>) -> Vec<Range<usize>> {
    let mut cursor = Cursor { text: text.get(..value.end).unwrap_or(""), at: value.start };
    let mut elements = Vec::new();
    while cursor.take(if elements.is_empty() { '(' } else { ',' }) || (elements.is_empty() && cursor.take('[')) {
        match cursor.value() {
            Ok(element) => elements.push(element),
            Err(_) => break,
        }
    }
    elements
}

/// Whether a text is one value, without anything after it.
pub fn is_one_value(text: &str) -> bool {
    let closed = format!("{text})");
    let mut cursor = Cursor { text: &closed, at: 0 };
    cursor.value().is_ok_and(|value| value == (0..text.len()))
}

/// Reports a file that ends too early by the line on which the unfinished entity begins.
fn unclosed(text: &str, began: usize, mistake: Mistake) -> Mistake {
    if mistake.at < text.len() || mistake.what.starts_with("the file ends here") {
        return mistake;
    }
    let line = place_of(text, began).line;
    Mistake::new(mistake.at, format!("the file ends here, but the entity that begins on line {line} is not closed"))
}

struct Cursor<'t> {
    text: &'t str,
    at: usize,
}

impl<'t> Cursor<'t> {
    fn rest(&self) -> &'t str {
        self.text.get(self.at..).unwrap_or("")
    }

    fn expected(&self, expected: &str) -> Mistake {
        Mistake::new(self.at, format!("found {}, but expected {expected}", found(self.text, self.at)))
    }

    fn take(&mut self, letter: char) -> bool {
        let there = self.rest().starts_with(letter);
        if there {
            self.at += letter.len_utf8();
        }
        there
    }

    fn skip_while(&mut self, also: impl Fn(char) -> bool) {
        let rest = self.rest();
        self.at += rest.len() - rest.trim_start_matches(also).len();
    }

    /// Skips past the next `end`, or to the end of the file.
    fn skip_over(&mut self, end: &str) -> bool {
        let found = self.rest().find(end);
        self.at = found.map_or(self.text.len(), |before| self.at + before + end.len());
        found.is_some()
    }

    /// Skips white space and comments, as RON defines them.
    fn skip_space(&mut self) -> Result<(), Mistake> {
        loop {
            self.skip_while(is_space);
            let began = self.at;
            if self.rest().starts_with("//") {
                self.skip_over("\n");
            } else if self.rest().starts_with("/*") {
                self.skip_block_comment(began)?;
            } else {
                return Ok(());
            }
        }
    }

    fn skip_block_comment(&mut self, began: usize) -> Result<(), Mistake> {
        self.at += 2;
        let mut depth = 1;
        while depth > 0 {
            let rest = self.rest();
            let Some(next) = rest.find(['/', '*']) else {
                let line = place_of(self.text, began).line;
                let what =
                    format!("the file ends here, but the comment that begins on line {line} is not closed by `*/`");
                return Err(Mistake::new(self.text.len(), what));
            };
            let pair = rest.get(next..next + 2);
            depth += usize::from(pair == Some("/*"));
            depth -= usize::from(pair == Some("*/"));
            self.at += next + if matches!(pair, Some("/*" | "*/")) { 2 } else { 1 };
        }
        Ok(())
    }

    fn take_word(&mut self) -> &'t str {
        let rest = self.rest();
        if !rest.starts_with(|first: char| first.is_alphabetic() || first == '_') {
            return "";
        }
        self.skip_while(|letter| letter.is_alphanumeric() || letter == '_');
        &rest[..rest.len() - self.rest().len()]
    }

    /// Words with their values, up to and including the closing bracket.
    fn parts(&mut self) -> Result<Vec<Part<'t>>, Mistake> {
        let mut parts = Vec::new();
        self.skip_space()?;
        while !self.take(')') {
            let at = self.at;
            let word = self.take_word();
            if word.is_empty() {
                return Err(self.expected("a word with a colon, such as `name:`, or the `)` that ends this"));
            }
            self.skip_space()?;
            if !self.take(':') {
                return Err(self.expected(&format!("a `:` after `{}`", shown(word))));
            }
            let value = self.value()?;
            parts.push(Part { word, at, value });
            self.skip_space()?;
            let comma = self.take(',');
            self.skip_space()?;
            if !comma && !self.rest().starts_with(')') {
                return Err(self.expected("`,` or `)`"));
            }
        }
        Ok(parts)
    }

    /// Skips one value, up to the comma or bracket that ends it.
    fn value(&mut self) -> Result<Range<usize>, Mistake> {
        self.skip_space()?;
        let (start, mut end) = (self.at, self.at);
        let mut open: Vec<(char, usize)> = Vec::new();
        loop {
            self.skip_space()?;
            let began = self.at;
            let Some(letter) = self.rest().chars().next() else {
                return Err(self.expected("the rest of a value"));
            };
            let another =
                open.is_empty() && start < end && end < began && !matches!(letter, ',' | '(' | ')' | ']' | '}');
            if another {
                return Err(self.expected("`,` or `)` before it"));
            }
            match letter {
                ',' if open.is_empty() => break,
                ')' | ']' | '}' => match open.pop() {
                    None => break,
                    Some((closer, _)) if closer == letter => self.at += 1,
                    Some((closer, began)) => {
                        let line = place_of(self.text, began).line;
                        return Err(self.expected(&format!("the `{closer}` that closes a bracket of line {line}")));
                    }
                },
                '(' | '[' | '{' if open.len() == DEEPEST => {
                    let what = format!("brackets are nested deeper than {DEEPEST} here, and no component needs that");
                    return Err(Mistake::new(began, what));
                }
                '(' => self.open(&mut open, ')'),
                '[' => self.open(&mut open, ']'),
                '{' => self.open(&mut open, '}'),
                '"' => self.skip_text(began)?,
                '\'' => self.skip_letter(began)?,
                _ => match self.take_word() {
                    "" => self.at += letter.len_utf8(),
                    "r" | "br" if self.rest().starts_with(['"', '#']) => self.skip_raw_text(began)?,
                    _ => {}
                },
            }
            end = self.at;
        }
        if end == start { Err(self.expected("a value")) } else { Ok(start..end) }
    }

    fn open(&mut self, open: &mut Vec<(char, usize)>, closer: char) {
        open.push((closer, self.at));
        self.at += 1;
    }

    /// Skips a string in double quotes, in which `\` escapes the next character.
    fn skip_text(&mut self, began: usize) -> Result<(), Mistake> {
        self.at += 1;
        loop {
            self.skip_while(|letter| letter != '"' && letter != '\\');
            match self.rest().chars().next() {
                None => return Err(unclosed_text(self.text, began)),
                Some('"') => {
                    self.at += 1;
                    return Ok(());
                }
                Some(_) => self.at += 1 + self.rest().chars().nth(1).map_or(0, char::len_utf8),
            }
        }
    }

    /// Skips the rest of a raw string such as `r#"…"#` after its `r`.
    fn skip_raw_text(&mut self, began: usize) -> Result<(), Mistake> {
        let before = self.at;
        self.skip_while(|letter| letter == '#');
        let end = format!("\"{}", "#".repeat(self.at - before));
        if self.take('"') && !self.skip_over(&end) {
            return Err(unclosed_text(self.text, began));
        }
        Ok(())
    }

    /// Skips a character in single quotes.
    fn skip_letter(&mut self, began: usize) -> Result<(), Mistake> {
        self.at += 1;
        if self.take('\\') {
            self.at += self.rest().chars().next().map_or(0, char::len_utf8);
            self.skip_while(|letter| letter.is_alphanumeric() || matches!(letter, '{' | '}'));
        } else {
            self.at += self.rest().chars().next().map_or(0, char::len_utf8);
        }
        let what = "found `'`, but a single letter and another `'` do not follow; text is written in double quotes";
        if self.take('\'') { Ok(()) } else { Err(Mistake::new(began, what)) }
    }
}

fn unclosed_text(text: &str, began: usize) -> Mistake {
    let line = place_of(text, began).line;
    Mistake::new(
        text.len(),
        format!("the file ends here, but the text that begins on line {line} has no closing quote"),
    )
}

/// Whether RON treats a character as white space.
fn is_space(letter: char) -> bool {
    matches!(letter, '\t'..='\r' | ' ' | '\u{85}' | '\u{200e}' | '\u{200f}' | '\u{2028}' | '\u{2029}')
}
