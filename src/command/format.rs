use super::error::Result;
use clap::ValueEnum;
use pinhole::scene::{is_invisible, printable_path};
use serde::Serialize;
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::io::Write;
use std::path::Path;

/// How a command prints what it found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Sentences and tables for a person
    #[default]
    Text,
    /// One JSON value for a program, and nothing else
    Json,
}

impl Format {
    /// Whether it is JSON.
    pub fn is_json(self) -> bool {
        self == Self::Json
    }
}

/// Prints one JSON value, indented, with a newline at its end.
///
/// Letters that a terminal does not show as themselves are escaped, so that no name can disguise what is printed.
pub fn print_json(value: &impl Serialize, out: &mut dyn Write) -> Result {
    let text = serde_json::to_string_pretty(value).map_err(std::io::Error::from)?;
    writeln!(out, "{}", escaped(&text))?;
    Ok(())
}

/// Says which file was written: in JSON, or in a sentence.
pub fn print_written(file: &Path, format: Format, out: &mut dyn Write) -> Result {
    match format {
        Format::Json => print_json(&json!({ "files": [shown(file)] }), out),
        Format::Text => Ok(writeln!(out, "wrote {}", printable_path(file))?),
    }
}

/// A path as JSON holds it.
pub fn shown(file: &Path) -> String {
    file.display().to_string()
}

/// A number for JSON, which has no infinity: that is the word for it instead, and NaN is null.
pub fn number_or_word(number: f64) -> Value {
    if number.is_infinite() { json!(if number > 0.0 { "infinite" } else { "minus infinite" }) } else { json!(number) }
}

/// The same JSON, with every letter that hides or turns text round written as `\u` and its number.
///
/// Such letters stand inside strings only, where the two are equal.
fn escaped(json: &str) -> String {
    let mut text = String::with_capacity(json.len());
    for letter in json.chars() {
        if is_hidden(letter) {
            letter.encode_utf16(&mut [0; 2]).iter().for_each(|unit| {
                let _ = write!(text, "\\u{unit:04x}");
            });
        } else {
            text.push(letter);
        }
    }
    text
}

/// Whether a terminal does not show a letter as itself; serde_json escapes those below a space.
fn is_hidden(letter: char) -> bool {
    ('\u{7f}'..='\u{9f}').contains(&letter) || is_invisible(letter)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_that_disguise_text_are_escaped_and_stay_the_same_text() {
        let turned = ('\u{202a}'..='\u{202e}').chain('\u{2066}'..='\u{2069}');
        let others = "\u{200e}\u{200f}\u{61c}\u{200b}\u{2028}\u{feff}\u{7f}\u{9b}\u{e0041}\u{1b}\r\n".chars();
        for letter in turned.chain(others) {
            let name = format!("ball{letter}\"gnp.exr");
            let mut out = Vec::new();
            print_json(&json!({ "name": name }), &mut out).expect("printed");
            let text = String::from_utf8(out).expect("UTF-8");
            let line = text.lines().nth(1).expect("an object of one line");
            assert!(line.chars().all(|letter| (' '..='~').contains(&letter)), "{letter:?} stands in {line:?}");
            assert_eq!(serde_json::from_str::<Value>(&text).expect("JSON")["name"], name);
        }
        assert_eq!(escaped("\"é 球 ° ε ²\""), "\"é 球 ° ε ²\"");
    }

    #[test]
    fn what_is_not_finite_is_null_or_a_word() {
        let told = [1.5, f64::INFINITY, f64::NEG_INFINITY, f64::NAN].map(number_or_word);
        assert_eq!(told, [json!(1.5), json!("infinite"), json!("minus infinite"), Value::Null]);
    }
}
