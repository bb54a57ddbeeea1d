//! Which files have changed since one last looked.

use std::collections::BTreeMap;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// When each file was last written, and how long it is.
type Files = BTreeMap<PathBuf, (Option<SystemTime>, u64)>;

/// Every watched file, as it was when one last looked.
#[derive(Debug, Default)]
pub struct Watch {
    places: Vec<PathBuf>,
    seen: Files,
}

impl Watch {
    /// Begins to watch files, and folders with all that is in them.
    pub fn new(places: Vec<PathBuf>) -> Self {
        let mut watch = Self { places, seen: Files::new() };
        watch.changed();
        watch
    }

    /// The files that came, went or changed since the last look.
    pub fn changed(&mut self) -> Vec<PathBuf> {
        let mut now = Files::new();
        for place in &self.places {
            look(place, &self.seen, &mut now);
        }
        let came = now.iter().filter(|(path, state)| self.seen.get(*path) != Some(*state)).map(|(path, _)| path);
        let went = self.seen.keys().filter(|path| !now.contains_key(*path));
        let changed = came.chain(went).cloned().collect();
        self.seen = now;
        changed
    }
}

/// Finds what is at a path now; what cannot be read, for want of file descriptors say, is taken to be as it was.
fn look(path: &Path, seen: &Files, found: &mut Files) {
    let failed = match path.metadata() {
        Ok(about) if about.is_dir() => read_folder(path, seen, found),
        Ok(about) => {
            found.insert(path.to_path_buf(), (about.modified().ok(), about.len()));
            Ok(())
        }
        Err(error) => Err(error),
    };
    if failed.is_err_and(|error| error.kind() != ErrorKind::NotFound) {
        let below = seen.range(path.to_path_buf()..).take_while(|(known, _)| known.starts_with(path));
        found.extend(below.map(|(known, state)| (known.clone(), *state)));
    }
}

fn read_folder(path: &Path, seen: &Files, found: &mut Files) -> io::Result<()> {
    for entry in path.read_dir()? {
        let path = entry?.path();
        // A link to a folder may lead back to where it stands.
        if !(path.is_symlink() && path.is_dir()) {
            look(&path, seen, found);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_are_seen_once() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = folder.path().join("a.md");
        let mut watch = Watch::new(vec![folder.path().to_path_buf()]);
        assert!(watch.changed().is_empty());
        std::fs::write(&file, "one").expect("a file");
        assert_eq!(watch.changed(), std::slice::from_ref(&file));
        assert!(watch.changed().is_empty());
        std::fs::remove_file(&file).expect("a file");
        assert_eq!(watch.changed(), [file]);
    }

    #[cfg(unix)]
    #[test]
    fn links_in_a_circle_are_not_followed() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let inner = folder.path().join("inner");
        std::fs::create_dir(&inner).expect("a folder");
        std::fs::write(inner.join("a.md"), "one").expect("a file");
        for link in ["one", "two"] {
            std::os::unix::fs::symlink(folder.path(), inner.join(link)).expect("a link");
        }
        std::os::unix::fs::symlink(inner.join("a.md"), folder.path().join("b.md")).expect("a link");
        std::os::unix::fs::symlink("itself", folder.path().join("itself")).expect("a link");
        let watch = Watch::new(vec![folder.path().to_path_buf()]);
        let seen: Vec<&PathBuf> = watch.seen.keys().collect();
        assert_eq!(seen, [&folder.path().join("b.md"), &inner.join("a.md")]);
    }
}
