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
        rest = match variant_of(name, after) {
            Some((written, after)) => {
                done.push_str(&written);
                after
            }
            None => {
                done.push_str(word_of(name).unwrap_or(name));
                after
            }
        };
    }
    done + rest
}

/// A variant such as `Integrator::Path` as a file has it, and what follows.
fn variant_of<'t>(name: &str, after: &'t str) -> Option<(String, &'t str)> {
    let after = after.strip_prefix("::")?;
    let (variant, after) = after.split_at(after.find(|letter: char| !letter.is_alphanumeric()).unwrap_or(after.len()));
    let written = match (name, variant) {
        ("Integrator", "RayCasting") => "integrator: RayCasting".into(),
        ("Integrator", _) => format!("integrator: {variant}()"),
        ("LightStrategy", _) => format!("lights: {variant}"),
        _ => return None,
    };
    Some((written, after))
}

/// The word of a component's name.
fn word_of(name: &str) -> Option<&'static str> {
    match name {
        "UsesMaterial" => Some("material"),
        "ChildOf" => Some("parent"),
        _ => Word::all().find(|word| (word.component)() == name).map(|word| word.word),
    }
}
