//! The lists that must name the same chapters, and the length of a page.

use super::inline::BIBLIOGRAPHY;
use super::pattern::visible_words;
use super::scan::Scan;
use super::{Page, Problem};
use std::collections::BTreeSet;
use std::path::Path;

/// The most words of prose a page may have before anything is unfolded.
pub const MAX_WORDS: usize = 1_500;

/// A set of chapters, by stem: `05_pinhole`, and `cover`.
pub type Stems = BTreeSet<String>;

/// `SUMMARY.md` must list exactly the pages that exist, each once.
pub fn summary(all: &[Page]) -> Vec<Problem> {
    let Some(summary) = all.iter().find(|page| page.name == "SUMMARY.md") else {
        return vec![Problem::new("book/src/SUMMARY.md", 0, "is not there: it lists the pages of the book.")];
    };
    let mut listed = BTreeSet::new();
    let mut problems = Vec::new();
    for line in Scan::new(&summary.text).prose() {
        let target = line.text.split_once("](").and_then(|(_, rest)| rest.split_once(')'));
        let Some((target, _)) = target else { continue };
        let name = target.strip_prefix("./").unwrap_or(target);
        if !listed.insert(name.to_owned()) {
            problems.push(Problem::new(&summary.label, line.number, format!("lists `{name}` twice.")));
        }
    }
    let missing = all.iter().filter(|page| page.name != summary.name && !listed.contains(&page.name));
    let what = |page: &Page| format!("does not list the page `{}`: add it, or it will not be in the book.", page.name);
    problems.extend(missing.map(|page| Problem::new(&summary.label, 0, what(page))));
    problems
}

/// Pages that are too long to be read in one go.
pub fn long_pages(all: &[Page]) -> Vec<Problem> {
    let long = |page: &Page| {
        let count = visible_words(&page.text);
        let what = format!("has {count} words of prose, and a page has at most {MAX_WORDS}: split or shorten it.");
        (count > MAX_WORDS).then(|| Problem::new(&page.label, 0, what))
    };
    // Nobody reads a bibliography in one go.
    all.iter().filter(|page| page.name != BIBLIOGRAPHY).filter_map(long).collect()
}

/// Whether a name is that of a chapter: two digits and an underscore, or the cover.
pub fn is_chapter(stem: &str) -> bool {
    let digits = stem.bytes().take_while(u8::is_ascii_digit).count();
    stem == "cover" || (digits == 2 && stem[2..].starts_with('_'))
}

/// The chapters among the pages.
pub fn page_stems(all: &[Page]) -> Stems {
    let stems = all.iter().filter_map(|page| page.name.strip_suffix(".md"));
    stems.filter(|stem| is_chapter(stem)).map(str::to_owned).collect()
}

/// The folders of `chapters/` that are chapters.
pub fn chapter_stems(root: &Path) -> Stems {
    let folders = std::fs::read_dir(root.join("chapters")).into_iter().flatten().flatten();
    let folders = folders.filter(|entry| entry.path().is_dir());
    folders.map(|entry| entry.file_name().to_string_lossy().into_owned()).filter(|stem| is_chapter(stem)).collect()
}

/// The chapters that have at least one snapshot.
pub fn snapshot_stems(root: &Path) -> Stems {
    let kept = |stem: &String| {
        let entries = std::fs::read_dir(root.join("chapters").join(stem).join("snapshots"));
        let mut names = entries.into_iter().flatten().flatten().map(|entry| entry.file_name());
        names.any(|name| Path::new(&name).extension().is_some_and(|extension| extension == "snap"))
    };
    chapter_stems(root).into_iter().filter(kept).collect()
}

/// The `[[example]]` entries of a manifest; the problems are those whose path is not their chapter's.
pub fn example_stems(manifest: &str) -> (Stems, Vec<Problem>) {
    let (mut stems, mut problems) = (Stems::new(), Vec::new());
    for table in manifest.split("[[example]]").skip(1) {
        let table = table.split("\n[").next().unwrap_or_default();
        let value = |key: &str| {
            let named = |line: &&str| line.split('=').next().is_some_and(|name| name.trim() == key);
            table.lines().find(named).and_then(|line| line.split('"').nth(1)).unwrap_or_default()
        };
        let (name, path) = (value("name"), value("path"));
        let expected = format!("{name}/main.rs");
        if path != expected {
            let what = format!("the example `{name}` has the path `{path}`, and should have `{expected}`.");
            problems.push(Problem::new("chapters/Cargo.toml", 0, what));
        }
        stems.insert(name.to_owned());
    }
    (stems, problems)
}

/// What is missing from each list that some other list has.
pub fn disagreements(lists: &[(&str, Stems)]) -> Vec<Problem> {
    let all: Stems = lists.iter().flat_map(|(_, stems)| stems.iter().cloned()).collect();
    let mut problems = Vec::new();
    for stem in &all {
        let of = |wanted: bool| {
            let these = lists.iter().filter(|(_, stems)| stems.contains(stem) == wanted);
            these.map(|(name, _)| *name).collect::<Vec<_>>().join(", ")
        };
        if lists.iter().any(|(_, stems)| !stems.contains(stem)) {
            let what = format!("is in {}, but not in {}: the lists must name the same chapters.", of(true), of(false));
            problems.push(Problem::new(stem, 0, what));
        }
    }
    problems
}

#[cfg(test)]
mod tests {
    use super::super::made_up;
    use super::*;

    #[test]
    fn the_summary_lists_every_page_once() {
        let summary_page = made_up("SUMMARY.md", "# S\n\n- [A](a.md)\n- [A](./a.md)\n");
        let all = [summary_page, made_up("a.md", ""), made_up("b.md", "")];
        let found: Vec<String> = summary(&all).iter().map(ToString::to_string).collect();
        let missing = "SUMMARY.md: does not list the page `b.md`: add it, or it will not be in the book.";
        assert_eq!(found, ["SUMMARY.md:4: lists `a.md` twice.", missing]);
        assert!(summary(&all[1..])[0].what.starts_with("is not there"));
    }

    #[test]
    fn a_long_page_is_counted() {
        let found = long_pages(&[made_up("a.md", &"word ".repeat(MAX_WORDS + 1)), made_up("b.md", "short")]);
        assert_eq!(found.len(), 1);
        assert!(found[0].what.starts_with("has 1501 words of prose, and a page has at most 1500"));
    }

    #[test]
    fn examples_are_chapters() {
        let manifest = "[package]\nname = \"x\"\n\n[[example]]\nname = \"01_a\"\npath = \"01_a/main.rs\"\n\n\
                        [[example]]\nname = \"cover\"\npath = \"cover.rs\"\n\n[lints]\nname = \"y\"\n";
        let (stems, problems) = example_stems(manifest);
        assert!(stems.iter().map(String::as_str).eq(["01_a", "cover"]));
        let what = "the example `cover` has the path `cover.rs`, and should have `cover/main.rs`.";
        assert_eq!(problems, [Problem::new("chapters/Cargo.toml", 0, what)]);
    }

    #[test]
    fn lists_that_part_are_named() {
        let set = |stems: &[&str]| stems.iter().map(|stem| (*stem).to_owned()).collect::<Stems>();
        let lists = [
            ("chapters/", set(&["01_a", "02_b"])),
            ("book/src/", set(&["01_a"])),
            ("chapters/Cargo.toml", set(&["02_b"])),
        ];
        let found: Vec<String> = disagreements(&lists).iter().map(ToString::to_string).collect();
        let first =
            "01_a: is in chapters/, book/src/, but not in chapters/Cargo.toml: the lists must name the same chapters.";
        let second =
            "02_b: is in chapters/, chapters/Cargo.toml, but not in book/src/: the lists must name the same chapters.";
        assert_eq!(found, [first, second]);
        assert!(is_chapter("12_x") && is_chapter("cover") && !is_chapter("mod.rs") && !is_chapter("123_x"));
    }
}
