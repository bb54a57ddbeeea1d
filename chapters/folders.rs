//! The folders of chapters, for the build scripts that list them: a new chapter is entered nowhere.

use std::io::Write;
use std::path::Path;
use std::{fs, io};

/// Has cargo run a build script again when a chapter comes or one of these files changes, and not at an edit of any other
/// file of a chapter, which would compile whatever stands on the list.
///
/// Cargo.toml lists the chapters' examples, so no chapter comes without a change of it; a file that is added to a chapter
/// that is there already is seen when Cargo.toml is touched.
pub fn run_again_for(chapters: &Path, files: &[&str]) -> io::Result<()> {
    let mut watched = vec![chapters.join("Cargo.toml")];
    for file in files {
        watched.extend(with_file(chapters, file)?.into_iter().map(|stem| chapters.join(stem).join(file)));
    }
    let mut out = io::stdout();
    watched.iter().try_for_each(|file| writeln!(out, "cargo::rerun-if-changed={}", file.display()))
}

/// The folders with a file of this name: the cover, then the chapters in the order of their numbers.
pub fn with_file(chapters: &Path, file: &str) -> io::Result<Vec<String>> {
    let mut stems = Vec::new();
    for entry in fs::read_dir(chapters)? {
        let path = entry?.path();
        if path.join(file).exists()
            && let Some(stem) = path.file_name()
        {
            stems.push(stem.to_string_lossy().into_owned());
        }
    }
    stems.sort_by_key(|stem| (stem != "cover", stem.clone()));
    Ok(stems)
}
