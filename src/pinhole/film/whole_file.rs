use super::replaces::{Replaces, Target, taken};
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
const MAX_LINKS: usize = 40;
/// The most files that are set aside under one name.
const MAX_ASIDE: u32 = 9999;

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
/// Errors: the path and the error of the operating system (no permission, no space, a folder of that name), or what is
/// there may not be replaced; a previous file is then unchanged.
pub fn write_whole<'a>(
    target: impl Into<Target<'a>>,
    write: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>,
) -> Result {
    let (_in_progress, target) = (InProgress::begin(), target.into());
    write_beside(&target, write).map_err(|source| Error::Write { path: target.path.into(), source })
}

/// Checks that a file can be written at a path, before there is anything to write.
///
/// Missing folders are created.
///
/// Errors: as for [`write_whole`].
pub fn check_place<'a>(target: impl Into<Target<'a>>) -> Result {
    let (_in_progress, target) = (InProgress::begin(), target.into());
    let place = resolved(target.path).and_then(|path| place_beside(&path, &target));
    place.map(|_| ()).map_err(|source| Error::Write { path: target.path.into(), source })
}

/// Whether nothing is at a path, or what may be replaced.
pub fn may_be_written<'a>(target: impl Into<Target<'a>>) -> bool {
    let target = target.into();
    resolved(target.path).and_then(|path| target.check(&path)).is_ok()
}

/// Removes a file that may be replaced, if it is there; says whether it was.
///
/// Errors: the path and the error of the operating system, or what is there may not be removed; it is then unchanged.
pub fn remove_own<'a>(target: impl Into<Target<'a>>) -> Result<bool> {
    let target = target.into();
    let removed = target.check(target.path).and_then(|()| match fs::remove_file(target.path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
        removed => removed.map(|()| true),
    });
    removed.map_err(|source| Error::Write { path: target.path.into(), source })
}

/// Gives a file the first name that no file has of those with a number before the ending, and says which.
///
/// Errors: the path and the error of the operating system; the file then has its own name still.
pub fn set_aside(path: &Path, ending: &str) -> Result<PathBuf> {
    let aside = |number: u32| match number {
        1 => path.with_extension(ending),
        _ => path.with_extension(format!("{number}.{ending}")),
    };
    for number in 1..=MAX_ASIDE {
        match rename_to_nothing(path, &aside(number)) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            done => return done.map(|()| aside(number)).map_err(|source| Error::Write { path: path.into(), source }),
        }
    }
    Err(Error::Write { path: path.into(), source: taken() })
}

fn write_beside(target: &Target<'_>, write: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>) -> io::Result<()> {
    let path = resolved(target.path)?;
    let temporary = place_beside(&path, target)?;
    let mut buffered = BufWriter::new(&temporary.file);
    write(&mut buffered)?;
    buffered.flush()?;
    drop(buffered);
    #[cfg(unix)]
    if let Ok(before) = fs::metadata(&path) {
        temporary.file.set_permissions(before.permissions())?;
    }
    temporary.file.sync_all()?;
    if matches!(target.replaces, Replaces::Nothing) {
        rename_to_nothing(&temporary.path, &path)?;
    } else {
        // What is there may be another file by now.
        target.check(&path)?;
        fs::rename(&temporary.path, &path)?;
    }
    // The name is stored in the folder; some file systems cannot flush one, and the file is intact without that.
    #[cfg(unix)]
    let _ = File::open(folder_of(&path)).and_then(|folder| folder.sync_all());
    Ok(())
}

/// Renames a file to a name that no file has, even if one is made at the same moment.
fn rename_to_nothing(from: &Path, to: &Path) -> io::Result<()> {
    match fs::hard_link(from, to) {
        Ok(()) => fs::remove_file(from),
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Err(taken()),
        // A file system without hard links.
        Err(_) if fs::symlink_metadata(to).is_err_and(|why| why.kind() == io::ErrorKind::NotFound) => {
            fs::rename(from, to)
        }
        Err(error) => Err(if to.symlink_metadata().is_ok() { taken() } else { error }),
    }
}

/// The file that a path leads to through symbolic links, whether or not it exists.
fn resolved(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_path_buf();
    for _ in 0..MAX_LINKS {
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

/// A temporary file in the folder of the file to be written, if what is there may be replaced.
fn place_beside(path: &Path, target: &Target<'_>) -> io::Result<Temporary> {
    let folder = folder_of(path);
    if let Some(file) = folder.ancestors().find(|above| above.is_file()) {
        let what = format!("{} is a file, and would have to be a folder", printable_path(file));
        return Err(io::Error::new(io::ErrorKind::NotADirectory, what));
    }
    target.check(path)?;
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
        let is_temporary = name.to_str().is_some_and(is_temporary_name);
        let old = || entry.metadata().ok()?.modified().ok()?.elapsed().ok();
        if is_temporary && old().is_some_and(|old| old > age) {
            // A file that cannot be removed belongs to another user.
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Whether a name is one that [`Temporary`] gives: two numbers.
fn is_temporary_name(name: &str) -> bool {
    let numbers = name.strip_prefix(PREFIX).and_then(|rest| rest.strip_suffix(SUFFIX)?.split_once('-'));
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|digit| digit.is_ascii_digit());
    numbers.is_some_and(|(process, number)| is_number(process) && is_number(number))
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
        let names = [".pinhole-12-3.part", ".pinhole-abc.part", ".pinhole-1-2.png", "part.part"];
        names.iter().for_each(|name| fs::write(folder.path().join(name), "x").expect("written"));
        let there = || names.map(|name| folder.path().join(name).exists());
        remove_stale(folder.path(), STALE);
        assert_eq!(there(), [true; 4]);
        std::thread::sleep(Duration::from_millis(20));
        remove_stale(folder.path(), Duration::from_millis(1));
        assert_eq!(there(), [false, true, true, true]);
    }

    #[cfg(unix)]
    #[test]
    fn an_error_names_the_requested_file() {
        let path = Path::new("/proc/picture.png");
        let said = check_place(path).expect_err("refused").to_string();
        assert!(said.starts_with("cannot write /proc/picture.png: ") && said.ends_with(')'), "{said}");
    }
}
