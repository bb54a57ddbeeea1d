use crate::chapter::Chapter;
use crate::{Error, Result};

/// The chapter that a reader names by its stem, its number or its name.
pub fn chapter<'c>(chapters: &'c [Chapter], asked: &str) -> Result<&'c Chapter> {
    let number: Option<u32> = asked.parse().ok();
    let matches = |chapter: &&Chapter| {
        let (first, rest) = chapter.name.split_once('_').unwrap_or(("", chapter.name));
        chapter.name == asked || rest == asked || (number.is_some() && first.parse().ok() == number)
    };
    chapters.iter().find(matches).ok_or_else(|| Error::Usage(no_such_chapter(chapters, asked)))
}

fn no_such_chapter(chapters: &[Chapter], asked: &str) -> String {
    let likeness = |chapter: &&Chapter| {
        let rest = chapter.name.split_once('_').map_or(chapter.name, |(_, rest)| rest);
        (strsim::jaro_winkler(rest, asked).max(strsim::jaro_winkler(chapter.name, asked)) * 1e6) as u64
    };
    let nearest = chapters.iter().max_by_key(likeness).map_or("cover", |chapter| chapter.name);
    format!("there is no chapter \"{asked}\"; the nearest is {nearest}, and `cargo run --release -- list` shows all")
}
