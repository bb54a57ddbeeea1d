use crate::chapter::Chapter;
use crate::{Error, Result};
use std::path::Path;

/// The chapter that a reader names by its stem, its number or its name.
pub fn chapter<'c>(chapters: &'c [Chapter], asked: &str) -> Result<&'c Chapter> {
    let number: Option<u32> = asked.parse().ok();
    let matches = |chapter: &&Chapter| {
        let (first, rest) = chapter.name.split_once('_').unwrap_or(("", chapter.name));
        chapter.name == asked || rest == asked || (number.is_some() && first.parse().ok() == number)
    };
    if is_scene_file(asked) {
        let what =
            format!("{asked} is a scene file, but this command takes a chapter; render, plan and trace take both");
        return Err(Error::Usage(what));
    }
    chapters.iter().find(matches).ok_or_else(|| Error::Usage(no_such_chapter(chapters, asked)))
}

/// Whether a reader means a scene file: a path that ends in `.ron`.
pub fn is_scene_file(asked: &str) -> bool {
    Path::new(asked).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("ron"))
}

fn no_such_chapter(chapters: &[Chapter], asked: &str) -> String {
    let likeness = |chapter: &&Chapter| {
        let rest = chapter.name.split_once('_').map_or(chapter.name, |(_, rest)| rest);
        (strsim::jaro_winkler(rest, asked).max(strsim::jaro_winkler(chapter.name, asked)) * 1e6) as u64
    };
    let nearest = chapters.iter().max_by_key(likeness).map_or("cover", |chapter| chapter.name);
    format!("there is no chapter \"{asked}\"; the nearest is {nearest}, and `cargo run --release -- list` shows all")
}
