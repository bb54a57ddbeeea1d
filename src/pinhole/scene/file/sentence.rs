//! Messages about components → messages about the words of a file.

use super::word::Word;

/// A sentence in which the names of components are replaced by their words in scene files, except within quotation
/// marks: `a UsesMaterial` becomes `a material`.
pub fn in_words_of_files(sentence: &str) -> String {
    let mut parts: Vec<String> = sentence.split('"').map(String::from).collect();
    for part in parts.iter_mut().step_by(2) {
        *part = replaced(part);
    }
    parts.join("\"")
}

fn replaced(text: &str) -> String {
    let (mut done, mut rest) = (String::new(), text);
    while let Some(start) = rest.find(|letter: char| letter.is_alphanumeric()) {
        let (before, from) = rest.split_at(start);
        let end = from.find(|letter: char| !letter.is_alphanumeric() && letter != '_').unwrap_or(from.len());
        let (name, after) = from.split_at(end);
        done.push_str(before);
        done.push_str(word_of(name).unwrap_or(name));
        rest = after;
    }
    done + rest
}

/// The word of a component's name.
fn word_of(name: &str) -> Option<&'static str> {
    match name {
        "UsesMaterial" => Some("material"),
        "ChildOf" => Some("parent"),
        _ => Word::all().find(|word| (word.component)() == name).map(|word| word.word),
    }
}
