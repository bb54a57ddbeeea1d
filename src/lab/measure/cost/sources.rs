//! Which sources a measurement was made from.

use pinhole::scene::{FNV_BASIS, FileKind, fnv, printable_path, read_file};
use pinhole::{Error, Result};
use std::fs;
use std::path::{Path, PathBuf};

const SOURCE: FileKind = FileKind { name: "a source", most: 16 << 20 };

/// The folders whose code decides what a stage costs.
const FOLDERS: [&str; 16] = [
    "plan",
    "cameras",
    "bvh",
    "shapes",
    "material",
    "lights",
    "filters",
    "extract",
    "sample",
    "rays",
    "intersect",
    "rasterise",
    "shade",
    "follow",
    "film",
    "render",
];

/// A fingerprint (FNV-1a, 64 bits) of the sources that decide what a chapter's stages cost: those of the stages and of
/// the loop that runs them, and the chapter's own. The ends of lines do not count, nor do the marks of the book's listings.
///
/// Errors: the sources are not there to be read.
pub fn made_from(chapter: &str) -> Result<String> {
    made_from_these(chapter, &[])
}

/// The same, of these files beside, each a path from the repository's root.
///
/// Errors: as [`made_from`].
pub fn made_from_these(chapter: &str, beside: &[&str]) -> Result<String> {
    let root = crate::repository();
    let mut files = Vec::new();
    for folder in FOLDERS {
        let folder = root.join("src/pinhole").join(folder);
        list(&folder, &mut files).map_err(|_| missing(&folder))?;
    }
    files.push(root.join("chapters").join(chapter).join("main.rs"));
    files.extend(beside.iter().map(|file| root.join(file)));
    let mut hash = FNV_BASIS;
    for file in files {
        let text = read_file(&file, SOURCE).map_err(|_| missing(&file))?;
        let text = String::from_utf8_lossy(&text);
        let name = file.strip_prefix(root).unwrap_or(&file).to_string_lossy().replace('\\', "/");
        hash = fnv(hash, name.as_bytes());
        for line in text.lines().filter(|line| !line.trim_start().starts_with("// ANCHOR")) {
            hash = fnv(fnv(hash, line.as_bytes()), b"\n");
        }
    }
    Ok(format!("{hash:016x}"))
}

/// The files of a folder and of those in it, in the order of their names.
fn list(folder: &Path, files: &mut Vec<PathBuf>) -> std::io::Result<()> {
    let mut entries = fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<std::io::Result<Vec<_>>>()?;
    entries.sort();
    for entry in entries {
        if entry.is_dir() {
            list(&entry, files)?;
        } else if entry.extension().is_some_and(|ending| ending == "rs") {
            files.push(entry);
        }
    }
    Ok(())
}

fn missing(path: &Path) -> Error {
    Error::Usage(format!("the sources that this was built from are not here ({} cannot be read)", printable_path(path)))
}

/// The same hash of any bytes.
pub fn fingerprint(bytes: &[u8]) -> String {
    format!("{:016x}", fnv(FNV_BASIS, bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chapters_differ() {
        let [cover, pinhole] = ["cover", "05_pinhole"].map(|stem| made_from(stem).expect("sources"));
        assert_ne!(cover, pinhole);
        assert!(made_from("no such chapter").is_err());
    }
}
