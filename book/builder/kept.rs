//! Answers of earlier builds, kept below `target/`: a command runs again only where what it depends on has changed.

use std::collections::HashSet;
use std::fs;
use std::hash::{DefaultHasher, Hasher};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::SystemTime;

/// How many programs keep their answers: the one for release, and the one of the profile for editing.
const PROGRAMS: usize = 2;

/// The answers of one program, in a folder of their own.
#[derive(Debug)]
pub struct Kept {
    folder: PathBuf,
    asked: Mutex<HashSet<String>>,
}

/// The name that a copy of the program has in the folder of its answers.
const PROGRAM: &str = "pinhole";

impl Kept {
    /// The answers that a program gave while the files in `data`, which it reads unasked, were as they are now.
    ///
    /// The program is copied beside them, so that cargo may replace the one it came from while a build runs.
    /// Errors: one sentence, where the copy cannot be made.
    pub fn of(program: &Path, data: &Path, shelf: &Path) -> Result<Self, String> {
        let bytes = fs::read(program).map_err(|error| format!("{} cannot be read: {error}.", program.display()))?;
        let mut hash = DefaultHasher::new();
        hash.write(&bytes);
        for path in below(data) {
            hash.write(path.as_os_str().as_encoded_bytes());
            hash.write(&fs::read(&path).unwrap_or_default());
        }
        let folder = shelf.join(format!("{:016x}", hash.finish()));
        let kept = Self { asked: Mutex::default(), folder };
        let made = fs::create_dir_all(&kept.folder).and_then(|()| match kept.program().exists() {
            true => Ok(()),
            false => kept.write(PROGRAM, |part| {
                fs::write(part, &bytes)?;
                fs::set_permissions(part, program.metadata()?.permissions())
            }),
        });
        made.map_err(|error| format!("{} cannot be written: {error}.", kept.folder.display()))?;
        Ok(kept)
    }

    /// The copy of the program.
    pub fn program(&self) -> PathBuf {
        self.folder.join(PROGRAM)
    }

    /// What the command answered before, and the name to keep a new answer under.
    pub fn find(&self, command: &str, words: &[String], extension: Option<&str>) -> (String, Option<Vec<u8>>) {
        let mut hash = DefaultHasher::new();
        hash.write(command.as_bytes());
        for path in words.iter().map(Path::new).filter(|path| path.is_file()) {
            hash.write(&fs::read(path).unwrap_or_default());
            hash.write(neighbours(path).as_bytes());
        }
        let name = format!("{:016x}.{}", hash.finish(), extension.unwrap_or("txt"));
        self.asked.lock().unwrap_or_else(PoisonError::into_inner).insert(name.clone());
        let answer = fs::read(self.folder.join(&name)).ok();
        (name, answer)
    }

    /// Keeps an answer at once, so that a build which is stopped has what it made; one that cannot be kept is made again.
    pub fn keep(&self, name: &str, answer: &[u8]) {
        let _ = self.write(name, |part| fs::write(part, answer));
    }

    /// A file is there whole or not at all.
    fn write(&self, name: &str, make: impl FnOnce(&Path) -> io::Result<()>) -> io::Result<()> {
        let part = tempfile::Builder::new().prefix("part").tempfile_in(&self.folder)?.into_temp_path();
        make(&part)?;
        Ok(part.persist(self.folder.join(name))?)
    }

    /// Lets go of the answers that nobody asked for, and of the programs that were not asked for longest.
    pub fn let_go(&self) {
        let asked = self.asked.lock().unwrap_or_else(PoisonError::into_inner);
        for path in entries(&self.folder) {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            if name != PROGRAM && !asked.contains(&*name) {
                let _ = fs::remove_file(&path);
            }
        }
        let _ = fs::File::open(self.program()).and_then(|file| file.set_modified(SystemTime::now()));
        let mut programs = entries(self.folder.parent().unwrap_or(&self.folder));
        programs.sort_by_key(|folder| folder.join(PROGRAM).metadata().and_then(|about| about.modified()).ok());
        let old = programs.len().saturating_sub(PROGRAMS);
        programs.iter().take(old).filter(|folder| **folder != self.folder).for_each(|folder| {
            let _ = fs::remove_dir_all(folder);
        });
    }
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    folder.read_dir().into_iter().flatten().flatten().map(|entry| entry.path()).collect()
}

/// The files below a folder that are no sources: what sources say is in the program.
fn below(folder: &Path) -> Vec<PathBuf> {
    let mut paths = entries(folder);
    paths.sort();
    let files = paths.into_iter().flat_map(|path| if path.is_dir() { below(&path) } else { vec![path] });
    files.filter(|path| path.extension().is_none_or(|extension| extension != "rs")).collect()
}

/// What lies beside a file, which it may name in turn: a model its textures.
fn neighbours(path: &Path) -> String {
    let about = |path: &PathBuf| path.metadata().map(|about| (about.len(), about.modified().ok())).ok();
    let mut beside: Vec<_> =
        entries(path.parent().unwrap_or(path)).iter().map(|path| (path.clone(), about(path))).collect();
    beside.sort();
    format!("{beside:?}")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A folder with a program, data that it reads, and a file that commands name.
    fn place() -> (tempfile::TempDir, PathBuf) {
        let folder = tempfile::tempdir().expect("a temporary folder");
        fs::create_dir(folder.path().join("data")).expect("a folder");
        for (name, text) in [("program", "one"), ("data/costs.txt", "1"), ("data/mod.rs", "1"), ("scene.ron", "[]")] {
            fs::write(folder.path().join(name), text).expect("a file");
        }
        let top = folder.path().to_path_buf();
        (folder, top)
    }

    fn of(top: &Path) -> Kept {
        Kept::of(&top.join("program"), &top.join("data"), &top.join("shelf")).expect("a shelf")
    }

    fn found(top: &Path, kept: &Kept) -> bool {
        let scene = top.join("scene.ron").display().to_string();
        let (name, answer) = kept.find(&format!("render {scene}"), &["render".to_owned(), scene], Some("png"));
        kept.keep(&name, b"picture");
        answer.is_some_and(|answer| answer == b"picture")
    }

    #[test]
    fn an_answer_holds_until_what_it_depends_on_changes() {
        let (_folder, top) = place();
        assert!(!found(&top, &of(&top)));
        assert!(found(&top, &of(&top)));
        for (name, is_told) in
            [("program", true), ("data/costs.txt", true), ("scene.ron", true), ("data/mod.rs", false)]
        {
            fs::write(top.join(name), "two").expect("a file");
            assert_eq!(found(&top, &of(&top)), !is_told, "{name}");
            assert!(found(&top, &of(&top)), "{name}");
        }
        fs::write(top.join("texture.png"), "beside it").expect("a file");
        assert!(!found(&top, &of(&top)));
        let kept = of(&top);
        assert_ne!(kept.find("plan 5", &[], None).0, kept.find("plan 6", &[], None).0);
        assert_ne!(kept.find("plan 5", &[], None).0, kept.find("plan 5", &[], Some("png")).0);
    }

    #[test]
    fn what_nobody_asks_for_goes() {
        let (_folder, top) = place();
        of(&top).keep("old.txt", b"");
        let kept = of(&top);
        kept.keep(&kept.find("plan 5", &[], None).0, b"");
        kept.let_go();
        assert_eq!(entries(&kept.folder).len(), 2, "the program and one answer");
        for program in ["two", "three", "four"] {
            fs::write(top.join("program"), program).expect("a program");
            std::thread::sleep(std::time::Duration::from_millis(20));
            of(&top).let_go();
        }
        assert_eq!(entries(&top.join("shelf")).len(), PROGRAMS);
        assert_eq!(fs::read(of(&top).program()).expect("a copy"), b"four");
    }
}
