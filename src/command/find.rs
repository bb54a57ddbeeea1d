use super::called::called;
use super::error::{Error, Result};
use pinhole::Chapter;
use pinhole::scene::{is_model_file, printable};
use std::ffi::OsStr;
use std::path::{Component, Path};

/// Words of which more letters than this are shown or compared with nothing.
const LONGEST: usize = 64;
/// The most chapters that are named as what may have been meant.
const MAX_NEAREST: usize = 3;
/// How the names of files end that hold models or scenes of other programs.
const FOREIGN: [&str; 10] = ["stl", "pbrt", "usd", "usda", "usdz", "fbx", "blend", "xml", "dae", "3ds"];

/// The chapter that a reader names: by its stem, its number, its name, or the folder that holds it.
///
/// Errors: there is none, told with what comes nearest to it.
pub fn chapter(chapters: &[Chapter], asked: impl AsRef<OsStr>) -> Result<&Chapter> {
    let asked = asked.as_ref();
    known(chapters, asked).ok_or_else(|| Error::CommandLine(missing(chapters, asked)))
}

/// The chapter of a name, if there is one.
pub fn known<'c>(chapters: &'c [Chapter], asked: &OsStr) -> Option<&'c Chapter> {
    let word = plain_word(asked)?;
    let number = |text: &str| text.parse::<u32>().ok();
    chapters.iter().find(|chapter| {
        let (first, rest) = chapter.name.split_once('_').unwrap_or(("", chapter.name));
        let numbered = match word.split_once('_') {
            Some((asked, after)) => number(asked).is_some() && number(asked) == number(first) && after == rest,
            None => number(&word).is_some() && number(&word) == number(first),
        };
        numbered || word == rest || word == chapter.name
    })
}

/// Whether a word at the place of a command names what is to be rendered: a chapter, a number, or a file.
pub fn is_subject(chapters: &[Chapter], word: &OsStr) -> bool {
    let text = word.to_string_lossy();
    let number = !text.is_empty() && text.bytes().all(|letter| letter.is_ascii_digit());
    number || text == "-" || (!text.starts_with('-') && text.contains(['/', '.'])) || known(chapters, word).is_some()
}

/// Whether a reader means a scene file: a path that ends in `.ron`.
pub fn is_scene_file(asked: impl AsRef<OsStr>) -> bool {
    Path::new(&asked).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("ron"))
}

/// The chapters whose names come nearest to a word, the names of as near a kind only; none where none is near.
pub fn nearest(chapters: &[Chapter], word: &str) -> Vec<&'static str> {
    let word: String = word.chars().take(LONGEST).collect::<String>().to_lowercase();
    let max = (word.chars().count() / 3).max(1);
    let far = |chapter: &Chapter| {
        let rest = chapter.name.split_once('_').map_or(chapter.name, |(_, rest)| rest);
        let parts = rest.split('_').filter(|part| part.len() > 3);
        let begun = (word.len() > 2 && rest.starts_with(&word)).then_some(1);
        let spelt = [chapter.name, rest].into_iter().chain(parts).map(|own| strsim::osa_distance(own, &word)).min();
        spelt.into_iter().chain(begun).min().unwrap_or(usize::MAX)
    };
    let Some(min) = chapters.iter().map(far).min().filter(|min| *min <= max) else { return Vec::new() };
    chapters.iter().filter(|own| far(own) == min).map(|own| own.name).take(MAX_NEAREST).collect()
}

/// A word as it is shown.
pub fn shown(word: &OsStr) -> String {
    printable(&word.to_string_lossy(), LONGEST)
}

/// The chapter's name within a word: without folders before it and the source after it, without `chapter`, in small
/// letters.
fn plain_word(asked: &OsStr) -> Option<String> {
    let mut parts: Vec<String> = Path::new(asked)
        .components()
        .filter(|part| !matches!(part, Component::CurDir))
        .map(|part| part.as_os_str().to_string_lossy().to_lowercase())
        .collect();
    if parts.len() > 1 && parts.last().is_some_and(|last| last == "main.rs" || last == "exercise.rs") {
        parts.pop();
    }
    let word = parts.pop()?;
    if parts.last().is_some_and(|folder| folder != "chapters") || word.chars().count() > LONGEST {
        return None;
    }
    let bare = word.strip_prefix("chapter").map(|rest| rest.trim_start_matches(['_', '-', ' ']));
    Some(bare.filter(|rest| !rest.is_empty()).map_or(word.clone(), String::from))
}

/// Why a word names no chapter, and what is near to it.
fn missing(chapters: &[Chapter], asked: &OsStr) -> String {
    let word = shown(asked);
    let list = called("list");
    let ending = Path::new(asked).extension().map(|ending| ending.to_string_lossy().to_lowercase());
    if is_model_file(Path::new(asked)) {
        return format!("{word} is a model file, but this command takes a chapter, such as 05_pinhole");
    }
    if is_scene_file(asked) {
        return format!("{word} is a scene file, but this command takes a chapter, such as 05_pinhole");
    }
    if ending.as_ref().is_some_and(|ending| FOREIGN.contains(&ending.as_str())) {
        return format!(
            "cannot read {word}: models are read from .gltf, .glb, .obj and .ply files, and scenes from .ron files; \
             `{list}` shows the chapters, which can be rendered too"
        );
    }
    let plain = plain_word(asked).unwrap_or_default();
    let numbers = || chapters.iter().filter_map(|chapter| chapter.name.split('_').next()?.parse::<u32>().ok());
    if let (Ok(number), Some(first), Some(last)) = (plain.parse::<u128>(), numbers().min(), numbers().max()) {
        return format!("there is no chapter {number}; the chapters go from {first} to {last}, and `{list}` shows all");
    }
    if ending.is_some() {
        return format!("there is no chapter \"{word}\", and a scene file ends in .ron; `{list}` shows the chapters");
    }
    match nearest(chapters, &plain).split_last() {
        None => format!("there is no chapter \"{word}\", and none has a similar name; `{list}` shows all"),
        Some((one, [])) => format!("there is no chapter \"{word}\"; the nearest is {one}, and `{list}` shows all"),
        Some((last, others)) => {
            let others = others.join(", ");
            format!("there is no chapter \"{word}\"; the nearest are {others} and {last}, and `{list}` shows all")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chapters() -> Vec<Chapter> {
        ["cover", "02_ray", "05_pinhole", "10_light_and_shadow", "20_glass", "21_soft_shadows", "27_caustics"]
            .map(|name| Chapter::new(name, "", |_| ()))
            .to_vec()
    }

    #[test]
    fn a_chapter_has_many_names() {
        for word in [
            "5",
            "05",
            "pinhole",
            "PINHOLE",
            "05_pinhole",
            "5_pinhole",
            "chapter5",
            "chapter_05",
            "chapters/05_pinhole",
            "./chapters/05_pinhole/",
            "chapters/05_pinhole/main.rs",
            "../chapters/05_pinhole",
            "/a/chapters/5_Pinhole",
        ] {
            assert_eq!(known(&chapters(), word.as_ref()).map(|own| own.name), Some("05_pinhole"), "{word}");
        }
        for word in ["", "6", "5_ray", "pin", "a/05_pinhole", "chapter", "-5", "5.0", "main.rs"] {
            assert_eq!(known(&chapters(), word.as_ref()).map(|own| own.name), None, "{word}");
        }
    }

    #[test]
    fn the_nearest_is_what_a_person_would_choose() {
        for (word, expected) in [
            ("pinhol", &["05_pinhole"][..]),
            ("glas", &["20_glass"]),
            ("caustic", &["27_caustics"]),
            ("covr", &["cover"]),
            ("05_pinhloe", &["05_pinhole"]),
            ("light", &["10_light_and_shadow"]),
            ("shado", &["10_light_and_shadow"]),
            ("soft", &["21_soft_shadows"]),
            ("xyzzy", &[]),
            ("q", &[]),
            ("", &[]),
        ] {
            assert_eq!(nearest(&chapters(), word), expected, "{word}");
        }
        let alike = ["01_aaaa", "02_aaab", "03_aaac", "04_aaad"].map(|name| Chapter::new(name, "", |_| ()));
        assert_eq!(nearest(&alike, "aaax"), ["01_aaaa", "02_aaab", "03_aaac"]);
    }

    #[test]
    fn a_word_of_a_million_letters_is_cut() {
        let began = std::time::Instant::now();
        let told = chapter(&chapters(), "é".repeat(1_000_000)).err().expect("refused").to_string();
        assert!(told.chars().count() < 250, "{} letters", told.chars().count());
        assert!(began.elapsed().as_secs() < 1, "{:?}", began.elapsed());
        assert!(!shown("\u{1b}[2J\u{7}".as_ref()).contains(char::is_control));
    }
}
