use crate::scene::printable_path;
use crate::{Error, Result};
use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

const PREFIX: &str = ".pinhole-";
const SUFFIX: &str = ".part";
/// A temporary file older than this is no longer being written by anyone.
const STALE: Duration = Duration::from_secs(3600);
/// The largest number of symbolic links followed.
const MOST_LINKS: usize = 40;

static IN_PROGRESS: AtomicUsize = AtomicUsize::new(0);

/// The number of files being written; a process that exits now leaves as many temporary files behind.
pub fn writes_in_progress() -> usize {
    IN_PROGRESS.load(Ordering::SeqCst)
}

/// Counts a write as in progress until it is dropped.
struct InProgress;

impl InProgress {
    fn begin() -> Self {
        IN_PROGRESS.fetch_add(1, Ordering::SeqCst);
        Self
    }
}

impl Drop for InProgress {
    fn drop(&mut self) {
        IN_PROGRESS.fetch_sub(1, Ordering::SeqCst);
    }
}

/// Writes a file atomically: to a temporary file beside it, which is then renamed.
///
/// The data is flushed to disk before the file is renamed, so that a power cut leaves either the old file or the new
/// one.
/// Symbolic links are followed, an existing file keeps its permissions, and missing folders are created.
///
/// Errors: the path and the error of the operating system (no permission, no space, a folder of that name); a previous
/// file is then unchanged.
pub fn write_whole(path: &Path, write: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>) -> Result {
    let _in_progress = InProgress::begin();
    write_beside(path, write).map_err(|source| Error::Write { path: path.into(), source })
}

/// Checks that a file can be written at a path, before there is anything to write.
///
/// Missing folders are created.
///
/// Errors: as for [`write_whole`].
pub fn check_place(path: &Path) -> Result {
    let _in_progress = InProgress::begin();
    let place = resolved(path).and_then(|path| place_beside(&path));
    place.map(|_| ()).map_err(|source| Error::Write { path: path.into(), source })
}

fn write_beside(path: &Path, write: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>) -> io::Result<()> {
    let path = resolved(path)?;
    let temporary = place_beside(&path)?;
    let mut buffered = BufWriter::new(&temporary.file);
    write(&mut buffered)?;
    buffered.flush()?;
    drop(buffered);
    #[cfg(unix)]
    if let Ok(before) = fs::metadata(&path) {
        temporary.file.set_permissions(before.permissions())?;
    }
    temporary.file.sync_all()?;
    fs::rename(&temporary.path, &path)?;
    // The name is stored in the folder; some file systems cannot flush one, and the file is intact without that.
    #[cfg(unix)]
    let _ = File::open(folder_of(&path)).and_then(|folder| folder.sync_all());
    Ok(())
}

/// The file that a path leads to through symbolic links, whether or not it exists.
fn resolved(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_path_buf();
    for _ in 0..MOST_LINKS {
        match fs::read_link(&path) {
            Ok(target) => path = folder_of(&path).join(target),
            Err(_) => return Ok(path),
        }
    }
    Err(io::Error::other("too many links lead on from here"))
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// A file that is removed when it is dropped, unless it has got its final name by then.
struct Temporary {
    file: File,
    path: PathBuf,
}

impl Temporary {
    /// A new file with the usual permissions, under a name that no other process and no other thread has.
    fn in_folder(folder: &Path) -> io::Result<Self> {
        static NUMBER: AtomicU64 = AtomicU64::new(0);
        loop {
            let number = NUMBER.fetch_add(1, Ordering::Relaxed);
            let path = folder.join(format!("{PREFIX}{}-{number}{SUFFIX}", std::process::id()));
            match File::create_new(&path) {
                // A killed process of the same number has left it.
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                file => return Ok(Self { file: file?, path }),
            }
        }
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.path);
    }
}

/// A temporary file in the folder of the file to be written.
fn place_beside(path: &Path) -> io::Result<Temporary> {
    if path.is_dir() {
        return Err(io::Error::new(io::ErrorKind::IsADirectory, "a folder of that name is in the way"));
    }
    if path.exists() && !path.is_file() {
        return Err(io::Error::other("what is there is not a regular file"));
    }
    let folder = folder_of(path);
    if let Some(file) = folder.ancestors().find(|above| above.is_file()) {
        let what = format!("{} is a file, and would have to be a folder", printable_path(file));
        return Err(io::Error::new(io::ErrorKind::NotADirectory, what));
    }
    fs::create_dir_all(folder)?;
    sweep(folder);
    Temporary::in_folder(folder)
}

/// Removes what interrupted writes have left in a folder, the first time that something is written there.
fn sweep(folder: &Path) {
    static SWEPT: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
    if SWEPT.lock().unwrap_or_else(PoisonError::into_inner).insert(folder.into()) {
        remove_stale(folder, STALE);
    }
}

fn remove_stale(folder: &Path, age: Duration) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let is_temporary = name.to_str().is_some_and(|name| name.starts_with(PREFIX) && name.ends_with(SUFFIX));
        let old = || entry.metadata().ok()?.modified().ok()?.elapsed().ok();
        if is_temporary && old().is_some_and(|old| old > age) {
            // A file that cannot be removed belongs to another user.
            let _ = fs::remove_file(entry.path());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn put(path: &Path, text: &str) {
        write_whole(path, |file| file.write_all(text.as_bytes())).expect("written");
    }

    #[test]
    fn a_failed_write_leaves_what_was_there_and_nothing_else() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("picture.png");
        fs::write(&path, "before").expect("written");
        let failed = write_whole(&path, |file| {
            assert!(writes_in_progress() > 0);
            file.write_all(b"half")?;
            Err(io::Error::other("no space"))
        });
        assert_eq!(failed.expect_err("refused").to_string(), format!("cannot write {}: no space", path.display()));
        assert_eq!(fs::read_to_string(&path).expect("read"), "before");
        assert_eq!(fs::read_dir(folder.path()).expect("listed").count(), 1);
    }

    #[cfg(unix)]
    #[test]
    fn a_link_is_written_through_and_permissions_stay() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let folder = tempfile::tempdir().expect("a temporary folder");
        let [file, link, dangling, circle] =
            ["file", "link", "dangling", "circle"].map(|name| folder.path().join(name));
        put(&file, "one");
        fs::set_permissions(&file, fs::Permissions::from_mode(0o600)).expect("set");
        symlink("file", &link).expect("linked");
        put(&link, "two");
        assert!(link.is_symlink() && !file.is_symlink());
        assert_eq!(fs::read_to_string(&file).expect("read"), "two");
        assert_eq!(fs::metadata(&file).expect("there").permissions().mode() & 0o777, 0o600);
        symlink("new", &dangling).expect("linked");
        put(&dangling, "three");
        assert_eq!(fs::read_to_string(folder.path().join("new")).expect("read"), "three");
        symlink("circle", &circle).expect("linked");
        assert!(check_place(&circle).expect_err("refused").to_string().contains("too many links"));
    }

    #[test]
    fn stale_temporary_files_are_removed_and_recent_ones_are_not() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let names = [".pinhole-abc.part", ".pinhole-abc.png", "part.part"];
        names.iter().for_each(|name| fs::write(folder.path().join(name), "x").expect("written"));
        let there = || names.map(|name| folder.path().join(name).exists());
        remove_stale(folder.path(), STALE);
        assert_eq!(there(), [true; 3]);
        std::thread::sleep(Duration::from_millis(20));
        remove_stale(folder.path(), Duration::from_millis(1));
        assert_eq!(there(), [false, true, true]);
    }

    #[cfg(unix)]
    #[test]
    fn an_error_names_the_requested_file() {
        let path = Path::new("/proc/picture.png");
        let said = check_place(path).expect_err("refused").to_string();
        assert!(said.starts_with("cannot write /proc/picture.png: ") && said.ends_with(')'), "{said}");
    }
}
