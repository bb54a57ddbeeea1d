//! Which snapshot files there should be, and which there are.

use crate::message::Mismatch;
use crate::snapshots::folder;
use pinhole_lab::review::SNAPSHOT_FILES as FILES;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// Errors: the files that are missing and those that no chapter uses.
pub fn check(chapters: &[&str]) -> Result<(), Mismatch> {
    let mut expected = BTreeSet::new();
    for chapter in chapters {
        expected.extend(FILES.map(|file| format!("chapters/{chapter}/snapshots/{file}")));
    }
    let found = found(&Path::new(env!("CARGO_MANIFEST_DIR")).join("chapters"));
    let unused: Vec<String> = found.difference(&expected).cloned().collect();
    let missing: Vec<String> = expected.difference(&found).filter(|_| !being_written()).cloned().collect();
    let mut text = String::new();
    if !unused.is_empty() {
        text = format!("snapshots that no chapter uses, to be removed:\n  {}\n", unused.join("\n  "));
    }
    if !missing.is_empty() {
        text += &format!("snapshots that are missing:\n  {}\n", missing.join("\n  "));
        text += "`INSTA_UPDATE=always cargo test --test chapters` writes them\n";
    }
    if text.is_empty() { Ok(()) } else { Err(Mismatch(text)) }
}

/// All kept snapshots, whether their folder is a chapter's or not; not those that wait to be kept.
fn found(chapters: &Path) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for chapter in names(chapters) {
        let files = names(&chapters.join(&chapter).join("snapshots"));
        let kept = files.into_iter().filter(|file| !file.contains(".snap.new"));
        found.extend(kept.map(|file| format!("chapters/{chapter}/snapshots/{file}")));
    }
    found
}

fn names(folder: &Path) -> Vec<String> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned()).collect()
}

/// Whether the tests of the chapters, which run beside this one, were asked to write what is missing.
fn being_written() -> bool {
    std::env::var("INSTA_UPDATE").is_ok_and(|update| ["always", "force", "unseen"].contains(&update.as_str()))
}

#[test]
fn the_folder_of_a_chapter_is_where_its_main_is() {
    assert!(folder("cover").with_file_name("main.rs").is_file());
}
