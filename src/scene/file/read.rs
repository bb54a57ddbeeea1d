//! The words of one entity → its components.

use super::found::{found, shown};
use super::mistake::{Mistake, byte_at};
use super::nearest::nearest;
use super::scan::{EntityText, Part, check_fields, fields};
use super::word::{Put, RELATIONS, Word, words};
use crate::printable;
use ron::error::{Error, SpannedError};
use std::ops::Range;

/// The longest name, in characters, so that a message can show every name whole.
pub const LONGEST_NAME: usize = 100;

const THREE_NUMBERS: &str = "three numbers in round brackets, such as (0.0, 1.0, 0.0)";
const TWO_NUMBERS: &str = "two numbers in round brackets, such as (0.0, 1.0)";
const FOUR_NUMBERS: &str = "four numbers in round brackets, such as (0.0, 0.0, 0.0, 1.0)";

const THREE_OF_THEM: &str = "three of them in round brackets, one per vertex, each in brackets of its own";

/// A word of an entity, and its position.
#[derive(Clone)]
pub struct FilePart {
    /// The word.
    pub word: String,
    /// Its byte offset.
    pub at: usize,
    /// The byte range of its value.
    pub value: Range<usize>,
}

/// An entity as it was read.
#[derive(Clone)]
pub struct FileEntity {
    /// The byte offset of its opening bracket.
    pub at: usize,
    /// Its name.
    pub name: Option<String>,
    /// The index of its parent in the file.
    pub parent: Option<usize>,
    /// The index of the entity whose material it uses.
    pub material: Option<usize>,
    /// Whether it is excluded from the scene.
    pub disabled: bool,
    /// Its components, each a function that inserts it.
    pub components: Vec<Put>,
    /// Its words.
    pub parts: Vec<FilePart>,
}

/// Reads an entity's words; its references are resolved later, by [`resolve`](super::refer::resolve).
pub fn read_entity(text: &str, entity: &EntityText<'_>) -> Result<FileEntity, Mistake> {
    let mut read = FileEntity {
        at: entity.at,
        name: None,
        parent: None,
        material: None,
        disabled: false,
        components: Vec::new(),
        parts: Vec::new(),
    };
    if let Some(part) = entity.parts.iter().find(|part| part.word == "name") {
        read.name = Some(read_name(text, part)?);
    }
    let who = read.name.as_ref().map_or_else(|| "an unnamed entity".into(), |name| quoted(name));
    for part in &entity.parts {
        if read.parts.iter().any(|earlier| earlier.word == part.word) {
            let what = format!("{who} is given `{}` twice, but an entity has each component once", part.word);
            return Err(Mistake::new(part.at, what));
        }
        match (part.word, Word::find(part.word)) {
            (_, Some(word)) => {
                let value = text.get(part.value.clone()).unwrap_or("");
                let put = (word.read)(value).map_err(|error| value_mistake(text, part, &who, &error))?;
                read.components.push(put);
            }
            ("name" | "parent" | "material", None) => {}
            ("disabled", None) => read.disabled = read_value(text, part, &who)?,
            (unknown, None) => return Err(Mistake::new(part.at, unknown_word(unknown, &who))),
        }
        read.parts.push(FilePart { word: part.word.into(), at: part.at, value: part.value.clone() });
    }
    Ok(read)
}

/// A name as messages show it.
pub fn quoted(name: &str) -> String {
    format!("\"{}\"", printable(name, LONGEST_NAME))
}

fn read_name(text: &str, part: &Part<'_>) -> Result<String, Mistake> {
    let name: String = read_value(text, part, "an entity")?;
    if name.chars().any(char::is_control) || name.chars().count() > LONGEST_NAME {
        let what = format!(
            "an entity's name is {}, but a name is one line of at most {LONGEST_NAME} characters",
            shown(text.get(part.value.clone()).unwrap_or(""))
        );
        return Err(Mistake::new(part.value.start, what));
    }
    Ok(name)
}

/// The value of a word that is not a component.
pub fn read_value<V: serde::de::DeserializeOwned>(text: &str, part: &Part<'_>, who: &str) -> Result<V, Mistake> {
    let value = text.get(part.value.clone()).unwrap_or("");
    ron::from_str(value).map_err(|error| value_mistake(text, part, who, &error))
}

fn unknown_word(unknown: &str, who: &str) -> String {
    let nearest = nearest(words().chain(RELATIONS), &snake_case(unknown)).unwrap_or("sphere");
    format!("{who} has a component `{}`, but there is none of that name; the nearest is `{nearest}`", shown(unknown))
}

/// A type's name as a file would have it: `PointLight` → `point_light`.
fn snake_case(word: &str) -> String {
    let mut snake = String::new();
    for letter in word.chars() {
        if letter.is_uppercase() && !snake.is_empty() {
            snake.push('_');
        }
        snake.extend(letter.to_lowercase());
    }
    snake
}

/// Translates an error of `ron` about a value into one of pinhole's messages.
fn value_mistake(text: &str, part: &Part<'_>, who: &str, error: &SpannedError) -> Mistake {
    let value = text.get(part.value.clone()).unwrap_or("");
    let stopped = part.value.start + byte_at(value, error.span.end.line, error.span.end.col);
    let fields = fields(text, part.value.clone());
    let kind = part.word.replace('_', " ");
    let whose = if who.starts_with('"') { format!("{kind} {who}") } else { format!("unnamed {kind}") };
    match &error.code {
        Error::NoSuchStructField { expected, found, .. } => {
            let nested = fields.iter().flat_map(|field| self::fields(text, field.value.clone()));
            let at = fields.iter().cloned().chain(nested).find(|field| field.word == found);
            let at = at.map_or(part.value.start, |field| field.at);
            let words: Vec<String> = expected.iter().map(|field| format!("`{field}`")).collect();
            let fields = match &words[..] {
                [one] => format!("its field is {one}"),
                _ => format!("its fields are {}", words.join(", ")),
            };
            Mistake::new(at, format!("{whose}: a field `{}` is given, but {fields}", shown(found)))
        }
        Error::MissingStructField { field, .. } => {
            Mistake::new(part.value.start, format!("{whose}: {field} is missing, but it must be given"))
        }
        Error::DuplicateStructField { field, .. } => {
            let at = fields.iter().rev().find(|own| own.word == *field).map_or(stopped, |own| own.at);
            Mistake::new(at, format!("{whose}: {field} is given twice, but a component has each field once"))
        }
        Error::ExpectedComma => {
            let at = token_at(text, &part.value, stopped);
            let fraction = text.get(at..).is_some_and(|rest| rest.starts_with('.'));
            if let Some(field) = fields.iter().find(|field| fraction && field.value.contains(&at)) {
                let whole = shown(text.get(field.value.clone()).unwrap_or(""));
                let what = format!("{whose}: {} is {whole}, but it must be {}", field.word, whole_number(field.word));
                return Mistake::new(field.value.start, what);
            }
            Mistake::new(at, format!("{whose}: found {}, but expected `,` or a closing bracket", found(text, at)))
        }
        code => {
            if let Err(mistake) = check_fields(text, part.value.clone()) {
                return Mistake::new(mistake.at, format!("{whose}: {}", mistake.what));
            }
            let field = fields.iter().find(|field| (field.at..=field.value.end).contains(&stopped));
            let (name, range) = field.map_or((part.word, &part.value), |field| (field.word, &field.value));
            let whole = text.get(range.clone()).unwrap_or("");
            let whose = if field.is_some() { whose } else { who.to_string() };
            let in_variant = whole.starts_with(char::is_alphabetic)
                && matches!(
                    code,
                    Error::ExpectedStructLike | Error::ExpectedIdentifier | Error::SuggestRawIdentifier(_)
                );
            let named = matches!(code, Error::ExpectedDifferentStructName { .. } | Error::NoSuchEnumVariant { .. });
            let at = if named || in_variant { range.start } else { token_at(text, range, stopped) };
            let expected = match code {
                _ if in_variant && name == "integrator" => {
                    "a word with its fields in round brackets, such as Path()".into()
                }
                _ if in_variant => "a word with its fields in round brackets, such as Tent(radius: 1.0)".into(),
                Error::IntegerOutOfBounds | Error::ExpectedInteger | Error::InvalidIntegerDigit { .. } => {
                    whole_number(name)
                }
                _ => expected(code, part.word),
            };
            let stands = found(text, at);
            let instead = if at == range.start { String::new() } else { format!(", and at {stands} it is not") };
            Mistake::new(at, format!("{whose}: {name} is {}, but it must be {expected}{instead}", shown(whole)))
        }
    }
}

/// The start of the token at which the parser stopped, which may be before the white space in front of it.
fn token_at(text: &str, value: &Range<usize>, stopped: usize) -> usize {
    let rest = text.get(stopped..value.end).unwrap_or("");
    let at = stopped + rest.len() - rest.trim_start().len();
    if at >= value.end { value.start } else { at.max(value.start) }
}

/// The whole numbers that a field may hold.
fn whole_number(field: &str) -> String {
    let max = if field == "seed" { u64::MAX } else { u32::MAX.into() };
    format!("a whole number from 0 to {max}")
}

/// What `ron` expected.
fn expected(code: &Error, word: &str) -> String {
    let example = || Word::find(word).and_then(|word| (word.of_default)()).unwrap_or_else(|| "(…)".into());
    match code {
        Error::ExpectedFloat => "a number".into(),
        Error::ExpectedBoolean => "true or false".into(),
        Error::ExpectedString => "a text in double quotes".into(),
        Error::NoSuchEnumVariant { expected, .. } => format!("one of {}", expected.join(", ")),
        Error::ExpectedNamedStructLike("DVec3") | Error::ExpectedStructLike => THREE_NUMBERS.into(),
        Error::ExpectedNamedStructLike("DVec2") => TWO_NUMBERS.into(),
        Error::ExpectedNamedStructLike("DQuat") => FOUR_NUMBERS.into(),
        Error::ExpectedDifferentLength { expected, .. } if expected.contains("of 4") => FOUR_NUMBERS.into(),
        // A colour is an array of three as well, but of numbers.
        Error::ExpectedDifferentLength { expected, .. } if word == "triangle" && expected.contains("array") => {
            THREE_OF_THEM.into()
        }
        Error::ExpectedDifferentLength { expected, .. } if expected.contains("of 2") => TWO_NUMBERS.into(),
        Error::ExpectedDifferentLength { .. } => THREE_NUMBERS.into(),
        Error::ExpectedStructLikeEnd => "closed by `)` after fewer values".into(),
        Error::ExpectedUnit | Error::ExpectedNamedStructLike(_) | Error::ExpectedDifferentStructName { .. } => {
            format!("fields in round brackets, such as {}", example())
        }
        Error::ExpectedIdentifier | Error::SuggestRawIdentifier(_) => "a word without quotes".into(),
        Error::InvalidValueForType { expected, .. } => expected.clone(),
        Error::InvalidEscape(_) => "a text whose backslashes are escapes of RON, such as \\n or \\\"".into(),
        Error::Message(accepted) if ["placement", "keys"].contains(&word) => accepted.clone(),
        _ => "a value in RON syntax".into(),
    }
}
