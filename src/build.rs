//! Tells the program what it was built from: a checkpoint of another program must not be continued, for its samples were
//! taken by other code.

use std::hash::{DefaultHasher, Hasher};
use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let root = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    let mut out = io::stdout();
    for watched in ["src", "Cargo.lock"] {
        io::Write::write_all(&mut out, format!("cargo::rerun-if-changed={watched}\n").as_bytes())?;
    }
    io::Write::write_all(&mut out, format!("cargo::rustc-env=PINHOLE_SOURCES={}\n", hash_of(&root)?).as_bytes())
}

/// A hash of all that a program is built from below this folder, but for its chapters.
///
/// The same sources are the same program wherever they lie, so neither the folder nor the ends of lines count.
pub fn hash_of(root: &Path) -> io::Result<String> {
    let mut files = vec![root.join("Cargo.lock")];
    list(&root.join("src"), &mut files)?;
    let mut hasher = DefaultHasher::new();
    for file in files {
        let name = file.strip_prefix(root).unwrap_or(&file).to_string_lossy().replace('\\', "/");
        hasher.write(name.as_bytes());
        hasher.write(fs::read_to_string(&file)?.replace("\r\n", "\n").as_bytes());
    }
    Ok(format!("{:016x}", hasher.finish()))
}

/// The sources of a folder and of those in it, in the order of their names.
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
