//! Another value in the text of a file: `camera.perspective_camera.fov=62`.

use super::found::shown;
use super::nearest::nearest;
use super::read::{FileEntity, quoted};
use super::scan::{after_bracket, elements, fields, is_one_value, variant};
use super::word::Word;
use crate::LookAt;
use glam::DVec3;
use std::ops::Range;

const FORM: &str = "a value is set as ENTITY.COMPONENT.FIELD=VALUE, such as camera.perspective_camera.fov=62 or lamp.placement.position.x=-2";

/// A file's text with another value in the place of one.
///
/// Errors: the setting has another form, or names nothing that the text has.
pub fn with_value(text: &str, entities: &[FileEntity], setting: &str) -> Result<String, String> {
    let (path, value) = setting.split_once('=').ok_or(FORM)?;
    let value = value.trim();
    if !is_one_value(value) {
        return Err(format!("`{}` is not one value; {FORM}", shown(value)));
    }
    let (entity, words) = find(entities, path.trim())?;
    let Place { range, left_out } = place(text, entity, &words)?;
    let new = match left_out {
        [] => value.into(),
        [word, ..] if is_variant(word) => nested(left_out, value),
        [word, inner @ ..] => format!("{word}: {}, ", nested(inner, value)),
    };
    Ok([&text[..range.start], &new, &text[range.end..]].concat())
}

/// The text of a value, or that of its default where the file leaves it out.
///
/// Errors: the path names nothing that the text has.
pub fn value_at(text: &str, entities: &[FileEntity], path: &str) -> Result<String, String> {
    let (entity, words) = find(entities, path)?;
    let Place { range, left_out } = place(text, entity, &words)?;
    if left_out.is_empty() {
        return Ok(text[range].into());
    }
    let default = Word::find(words[0]).and_then(|word| (word.of_default)());
    let default = default.ok_or_else(|| format!("`{path}` is left out and has no default"))?;
    let Place { range, left_out } = within(&default, 0..default.len(), &words[1..])?;
    if left_out.is_empty() { Ok(default[range].into()) } else { Err(format!("`{path}` has no value")) }
}

/// A file's text with its camera looking from one point to another, and with this height of view where it is orthographic.
///
/// Errors: it has no camera, or one that is carried by something else.
pub fn with_view(text: &str, entities: &[FileEntity], view: &LookAt, height: f64) -> Result<String, String> {
    let is_camera = |entity: &&FileEntity| entity.parts.iter().any(|part| part.word.ends_with("_camera"));
    let camera = entities.iter().filter(|entity| !entity.disabled).find(is_camera).ok_or("there is no camera in it")?;
    let part = |word: &str| camera.parts.iter().find(|part| part.word == word);
    if let Some(carrier) = ["parent", "motion"].into_iter().find(|word| part(word).is_some()) {
        return Err(format!("its camera has a {carrier}, which would move it once more: take that away first"));
    }
    let triple = |v: DVec3| format!("({:?}, {:?}, {:?})", v.x, v.y, v.z);
    let up = if view.up == DVec3::Y { String::new() } else { format!(", up: {}", triple(view.up)) };
    let look = format!("look_at: (eye: {}, target: {}{up})", triple(view.eye), triple(view.target));
    let mut edits = vec![match part("look_at").or_else(|| part("placement")) {
        Some(part) => (part.at..part.value.end, look),
        None => (camera.at + 1..camera.at + 1, format!("{look}, ")),
    }];
    if let Some(part) = part("orthographic_camera") {
        let Place { range, left_out } = within(text, part.value.clone(), &["view_height"])?;
        let field = if left_out.is_empty() { "" } else { "view_height: " };
        let comma = if left_out.is_empty() { "" } else { ", " };
        edits.push((range, format!("{field}{height:?}{comma}")));
    }
    edits.sort_by_key(|(range, _)| range.start);
    let mut edited = text.to_owned();
    for (range, new) in edits.into_iter().rev() {
        edited.replace_range(range, &new);
    }
    Ok(edited)
}

/// Where a value stands, or where it belongs with the words that are left out there.
struct Place<'w> {
    range: Range<usize>,
    left_out: &'w [&'w str],
}

/// The entity that a path names, and the words that follow its name.
fn find<'e, 'p>(entities: &'e [FileEntity], path: &'p str) -> Result<(&'e FileEntity, Vec<&'p str>), String> {
    let after = |entity: &'e FileEntity| {
        let rest = path.strip_prefix(entity.name.as_ref()?)?.strip_prefix('.')?;
        Some((entity, rest))
    };
    // A name may hold a full stop, so the longest is meant.
    let Some((entity, rest)) = entities.iter().filter_map(after).min_by_key(|(_, rest)| rest.len()) else {
        let typed = path.split('.').next().unwrap_or_default();
        let names = entities.iter().filter_map(|entity| entity.name.as_deref());
        let nearest = nearest(names, typed).map_or(String::new(), |name| format!("; the nearest is {}", quoted(name)));
        return Err(format!("no entity is named \"{}\"{nearest}, and {FORM}", shown(typed)));
    };
    let name = &entity.name;
    let count = entities.iter().filter(|other| other.name == *name).count();
    if count > 1 {
        let name = quoted(name.as_deref().unwrap_or_default());
        return Err(format!("{count} entities are named {name}, but a value is set on one"));
    }
    let words: Vec<&str> = rest.split('.').collect();
    let is_word =
        |word: &&str| !word.is_empty() && word.chars().all(|letter| letter.is_alphanumeric() || letter == '_');
    if words.iter().all(is_word) { Ok((entity, words)) } else { Err(FORM.into()) }
}

fn place<'w>(text: &str, entity: &FileEntity, words: &'w [&'w str]) -> Result<Place<'w>, String> {
    match entity.parts.iter().find(|part| part.word == words[0]) {
        Some(part) => within(text, part.value.clone(), &words[1..]),
        None => Ok(Place { range: entity.at + 1..entity.at + 1, left_out: words }),
    }
}

/// Follows words into a value: a variant by its name, a field by its word, an element by its number or its axis.
fn within<'w>(text: &str, mut range: Range<usize>, words: &'w [&'w str]) -> Result<Place<'w>, String> {
    for (number, word) in words.iter().enumerate() {
        let left_out = &words[number..];
        let fields = fields(text, range.clone());
        if is_variant(word) {
            if variant(text, range.clone()) != *word {
                return Ok(Place { range, left_out });
            }
        } else if let Some(field) = fields.iter().find(|field| field.word == *word) {
            range = field.value.clone();
        } else if let Some(index) = index_of(word).filter(|_| fields.is_empty()) {
            let values = elements(text, range.clone());
            let missing = || format!("{} has no element `{word}`", shown(&text[range.clone()]));
            range = values.get(index).cloned().ok_or_else(missing)?;
        } else {
            let missing = || format!("{} has no field `{word}`", shown(&text[range.clone()]));
            let at = after_bracket(text, range.clone()).ok_or_else(missing)?;
            return Ok(Place { range: at..at, left_out });
        }
    }
    Ok(Place { range, left_out: &[] })
}

fn is_variant(word: &str) -> bool {
    word.starts_with(char::is_uppercase)
}

/// The index of an element that a path names, as 0 or as x.
fn index_of(word: &str) -> Option<usize> {
    word.parse().ok().or_else(|| "xyzw".find(word).filter(|_| word.len() == 1))
}

/// A value inside the variants and fields that lead to it.
fn nested(words: &[&str], value: &str) -> String {
    match words {
        [] => value.into(),
        [variant, inner @ ..] if is_variant(variant) => format!("{variant}{}", nested(inner, value)),
        [field, inner @ ..] => format!("({field}: {})", nested(inner, value)),
    }
}
