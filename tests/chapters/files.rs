//! Which snapshot files there should be, and which there are.

use crate::snapshots::{FILES, folder};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// A sentence a file that is missing or that no chapter uses.
pub fn faults(chapters: &[&str]) -> Vec<String> {
    let mut expected = BTreeSet::new();
    for chapter in chapters {
        expected.extend(FILES.map(|file| format!("chapters/{chapter}/snapshots/{file}")));
    }
    let found = found(&Path::new(env!("CARGO_MANIFEST_DIR")).join("chapters"));
    let unused = found.difference(&expected).map(|file| format!("{file} is not used by any chapter: remove it"));
    let missing = expected
        .difference(&found)
        .filter(|_| !being_written())
        .map(|file| format!("{file} is missing: `INSTA_UPDATE=always cargo test --test chapters` writes it"));
    unused.chain(missing).collect()
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
