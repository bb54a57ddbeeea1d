//! The folders of chapters, for the build scripts that list them: a new chapter is entered nowhere.

use std::path::Path;
use std::{fs, io};

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
