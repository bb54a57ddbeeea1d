//! Which files have changed since one last looked.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// Every watched file, when it was last written and how long it is.
#[derive(Debug, Default)]
pub struct Watch {
    places: Vec<PathBuf>,
    seen: BTreeMap<PathBuf, (Option<SystemTime>, u64)>,
}

impl Watch {
    /// Begins to watch files, and folders with all that is in them.
    pub fn new(places: Vec<PathBuf>) -> Self {
        let mut watch = Self { places, seen: BTreeMap::new() };
        watch.changed();
        watch
    }

    /// The files that came, went or changed since the last look.
    pub fn changed(&mut self) -> Vec<PathBuf> {
        let mut now = BTreeMap::new();
        for place in &self.places {
            look(place, &mut now);
        }
        let came = now.iter().filter(|(path, state)| self.seen.get(*path) != Some(*state)).map(|(path, _)| path);
        let went = self.seen.keys().filter(|path| !now.contains_key(*path));
        let changed = came.chain(went).cloned().collect();
        self.seen = now;
        changed
    }
}

fn look(path: &Path, found: &mut BTreeMap<PathBuf, (Option<SystemTime>, u64)>) {
    if let Ok(entries) = std::fs::read_dir(path) {
        entries.flatten().for_each(|entry| look(&entry.path(), found));
    } else if let Ok(about) = path.metadata() {
        found.insert(path.to_path_buf(), (about.modified().ok(), about.len()));
    }
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
}
