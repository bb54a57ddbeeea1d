use crate::{Error, Result};
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use tempfile::{Builder, NamedTempFile};

/// Writes a file whole or not at all: into a temporary file beside it, which then takes its name.
///
/// Missing folders are made.
/// Errors: the path and what the system said (no permission, no space, a folder in the way); what stood there before
/// is then still there.
pub fn write_whole(path: &Path, write: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>) -> Result {
    write_beside(path, write).map_err(|source| Error::Write { path: path.into(), source })
}

/// Whether a file could be written here: what [`write_whole`] would be refused for, before there is anything to write.
///
/// Missing folders are made.
/// Errors: as [`write_whole`].
pub fn check_place(path: &Path) -> Result {
    let _counted = UnderWay::begin();
    place_beside(path).map(|_| ()).map_err(|source| Error::Write { path: path.into(), source })
}

/// How many files are being written at this moment, for whoever is about to end the program.
pub fn writes_under_way() -> usize {
    UNDER_WAY.load(Ordering::SeqCst)
}

static UNDER_WAY: AtomicUsize = AtomicUsize::new(0);

/// Counts a file while it is there under another name.
struct UnderWay;

impl UnderWay {
    fn begin() -> Self {
        UNDER_WAY.fetch_add(1, Ordering::SeqCst);
        Self
    }
}

impl Drop for UnderWay {
    fn drop(&mut self) {
        UNDER_WAY.fetch_sub(1, Ordering::SeqCst);
    }
}

fn write_beside(path: &Path, write: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>) -> io::Result<()> {
    let _counted = UnderWay::begin();
    let temporary = place_beside(path)?;
    let mut buffered = BufWriter::new(temporary.as_file());
    write(&mut buffered)?;
    buffered.flush()?;
    drop(buffered);
    temporary.persist(path).map_err(|refused| refused.error)?;
    Ok(())
}

/// A temporary file in the folder that the file is to stand in.
fn place_beside(path: &Path) -> io::Result<NamedTempFile> {
    if path.is_dir() {
        return Err(io::Error::new(io::ErrorKind::IsADirectory, "a folder of that name is in the way"));
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if let Some(file) = folder.ancestors().find(|above| above.is_file()) {
        let what = format!("{} is a file, and would have to be a folder", file.display());
        return Err(io::Error::new(io::ErrorKind::NotADirectory, what));
    }
    fs::create_dir_all(folder)?;
    temporary_in(folder)
}

/// A temporary file that will get the permissions a person's own files get, less what their umask takes away.
fn temporary_in(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = Builder::new();
    builder.prefix(".pinhole-").suffix(".part");
    #[cfg(unix)]
    let permissions: fs::Permissions = std::os::unix::fs::PermissionsExt::from_mode(0o666);
    #[cfg(unix)]
    builder.permissions(permissions);
    builder.tempfile_in(folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failed_write_leaves_what_was_there_and_nothing_else() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("picture.png");
        fs::write(&path, "before").expect("written");
        let failed = write_whole(&path, |file| {
            file.write_all(b"half")?;
            Err(io::Error::other("no space"))
        });
        assert_eq!(failed.expect_err("refused").to_string(), format!("cannot write {}: no space", path.display()));
        assert_eq!(fs::read_to_string(&path).expect("read"), "before");
        assert_eq!(fs::read_dir(folder.path()).expect("listed").count(), 1);
    }
}
