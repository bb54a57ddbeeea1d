//! Hands the renderer a hash of its own sources: a checkpoint written by another build must not be continued, because
//! its samples were taken by other code.

use std::hash::{DefaultHasher, Hasher};
use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let package = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    let lock = package.join("../../Cargo.lock");
    let mut out = io::stdout();
    for watched in [&package, &lock] {
        io::Write::write_all(&mut out, format!("cargo::rerun-if-changed={}\n", watched.display()).as_bytes())?;
    }
    let hash = hash_of(&package, &lock)?;
    io::Write::write_all(&mut out, format!("cargo::rustc-env=PINHOLE_SOURCES={hash}\n").as_bytes())
}

/// A hash of all sources below a folder, and of the versions that the lock file names, if there is one.
///
/// The same sources make the same program wherever they are checked out, so neither the folder nor the line endings
/// count.
pub fn hash_of(package: &Path, lock: &Path) -> io::Result<String> {
    let mut hasher = DefaultHasher::new();
    if lock.exists() {
        hasher.write(text_of(lock)?.as_bytes());
    }
    let mut files = Vec::new();
    list(package, &mut files)?;
    for file in files {
        let name = file.strip_prefix(package).unwrap_or(&file).to_string_lossy().replace('\\', "/");
        hasher.write(name.as_bytes());
        hasher.write(text_of(&file)?.as_bytes());
    }
    Ok(format!("{:016x}", hasher.finish()))
}

fn text_of(file: &Path) -> io::Result<String> {
    Ok(fs::read_to_string(file)?.replace("\r\n", "\n"))
}

/// Collects the sources of a folder and of its subfolders, sorted by name.
fn list(folder: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    let mut entries = fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<io::Result<Vec<_>>>()?;
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
