//! A chapter is one folder: whoever adds one edits two lists outside it.

use super::{listed, root};
use std::fs;
use std::path::{Path, PathBuf};

/// Late chapters, whose names no other thing has.
const LATE: [&str; 2] = ["24_motion_blur", "08_field_of_view"];

/// The lists that a new chapter is entered in.
const LISTS: [&str; 2] = ["chapters/Cargo.toml", "book/src/SUMMARY.md"];

/// Files outside that name one of these chapters without being a list of chapters: each takes a scene that suits it.
const NAMED: [(&str, &str); 9] = [
    ("book/builder/live_page.rs", "the five figures that a test moves in a browser"),
    ("src/lab/review/mutation/table.rs", "a mutation is tried in whichever chapter runs the stage that it spoils"),
    ("tests/bench/wrong_answers/from_08.rs", "wrong answers, chapter by chapter"),
    ("tests/bench/wrong_answers/from_22.rs", "wrong answers, chapter by chapter"),
    ("tests/bench/wrong_answers/latest.rs", "wrong answers, chapter by chapter"),
    ("tests/book_numbers/spaces.rs", "the numbers that page 08 prints, computed from its scene"),
    ("tests/exercises/folders.rs", "this file"),
    ("tests/long_renders/parts.rs", "a scene of every integrator, to be rendered in parts"),
    ("tests/follow.rs", "pictures of sampled scenes that must not change when an integrator is forced on them"),
];

#[test]
fn a_new_chapter_edits_two_lists_outside_its_folder() {
    let (mut elsewhere, mut lists, mut named) = (Vec::new(), Vec::new(), Vec::new());
    for path in files_below(root()) {
        // Pictures are no text.
        let Ok(text) = fs::read_to_string(&path) else { continue };
        let file = path.strip_prefix(root()).expect("within the repository");
        for stem in LATE.into_iter().filter(|stem| text.contains(stem)) {
            if LISTS.iter().any(|list| file == Path::new(list)) {
                lists.push((file.to_path_buf(), stem));
            } else if let Some((exception, _)) = NAMED.iter().find(|(named, _)| file == Path::new(named)) {
                named.push(*exception);
            } else if !file.starts_with(Path::new("chapters").join(stem)) && !is_page(file) && !is_kept(file) {
                elsewhere.push(format!("{} names {stem}", file.display()));
            }
        }
    }
    assert!(elsewhere.is_empty(), "{}", elsewhere.join("\n"));
    assert_eq!(lists.len(), LISTS.len() * LATE.len(), "{lists:?}");
    let unused: Vec<_> = NAMED.iter().filter(|(file, _)| !named.contains(file)).collect();
    assert!(unused.is_empty(), "no exceptions any more: {unused:?}");
}

#[test]
fn what_a_folder_holds_is_on_the_lists_that_were_compiled() {
    let figures = fs::read_to_string(concat!(env!("OUT_DIR"), "/figures.rs")).expect("the list of figures");
    let folders =
        fs::read_dir(root().join("chapters")).expect("the chapters").map(|entry| entry.expect("an entry").path());
    let (mut asking, mut drawing) = (0, 0);
    for folder in folders.filter(|folder| folder.is_dir()) {
        let stem = folder.file_name().expect("a name").to_string_lossy().into_owned();
        let listed = listed::all().iter().any(|(chapter, _)| *chapter == stem);
        let again = "touch chapters/Cargo.toml, and build again";
        assert_eq!(listed, folder.join("check.rs").exists(), "{stem}/check.rs: {again}");
        let draws = folder.join("figures.rs").exists();
        assert_eq!(figures.contains(&format!("chapter_{stem}::figures")), draws, "{stem}/figures.rs: {again}");
        asking += usize::from(listed);
        drawing += usize::from(draws);
    }
    assert!(asking > 0 && drawing > 0);
    eprintln!("chapters: {asking} ask for a function, {drawing} draw figures, all listed");
}

/// A page of the book: what prose speaks of is no list.
fn is_page(file: &Path) -> bool {
    file.starts_with("book/src") && file.extension().is_some_and(|ending| ending == "md")
}

/// What tests keep and renew by themselves.
fn is_kept(file: &Path) -> bool {
    file.components().any(|part| part.as_os_str() == "snapshots")
        || file.extension().is_some_and(|ending| ending == "snap" || ending == "lock")
}

/// The repository's files, without what is built from them and what git keeps.
fn files_below(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a readable folder") {
            let path = entry.expect("a readable entry").path();
            let name = path.file_name().expect("a name").to_string_lossy().into_owned();
            let built = ["target", "out", "mutants.out"].contains(&name.as_str()) || path.ends_with("book/book");
            if path.is_symlink() || name == ".git" || built {
                continue;
            }
            if path.is_dir() { folders.push(path) } else { found.push(path) }
        }
    }
    found
}
