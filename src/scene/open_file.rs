//! The only place where files are opened for reading.
//!
//! A name in a scene may lead to anything: a pipe that nobody writes to, a device that never ends, a folder.
//! Therefore nothing here blocks, only regular files are read, and no more bytes of them than their kind allows.

use super::{TooLittleMemory, check_memory, printable_path};
use std::collections::BTreeSet;
use std::fmt;
use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// The files that were opened since the program began.
static OPENED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// The files that this program has opened for reading, by the paths by which it did: what another machine needs to render
/// the same.
pub fn opened_files() -> Vec<PathBuf> {
    OPENED.lock().unwrap_or_else(PoisonError::into_inner).iter().cloned().collect()
}

/// A kind of file: its name in messages, and its largest size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FileKind {
    /// With its article, such as `a texture`.
    pub name: &'static str,
    /// The largest number of bytes.
    pub max: u64,
}

/// A regular file that is open for reading.
#[derive(Debug)]
pub struct OpenFile {
    /// The file.
    pub file: File,
    /// Its metadata when it was opened.
    pub metadata: Metadata,
    kind: FileKind,
    shown: String,
}

/// Why a file was not opened or read.
#[derive(Debug)]
pub enum Unopened {
    /// There is no file of that name.
    Missing,
    /// It is a folder.
    Folder,
    /// It is a pipe, a device or a socket.
    NotRegular,
    /// It is too long; its number of bytes.
    TooLong(u64),
    /// It does not fit into memory.
    TooLittleMemory(TooLittleMemory),
    /// Another error of the operating system.
    System(io::Error),
}

/// Why which file was not opened or read; displayed as a clause that names the file.
#[derive(Debug)]
pub struct FileError {
    /// The file as messages show it.
    pub shown: String,
    /// The kind of file expected.
    pub kind: FileKind,
    /// Why it was not read.
    pub why: Unopened,
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { shown, kind: FileKind { name, max }, why } = self;
        match why {
            Unopened::Missing => write!(f, "there is no file {shown}"),
            Unopened::Folder => write!(f, "{shown} is a folder, but {name} is a file"),
            Unopened::NotRegular => write!(f, "{shown} is not a regular file"),
            Unopened::TooLong(bytes) => write!(f, "{shown} has {bytes} bytes, but {name} has at most {max}"),
            Unopened::TooLittleMemory(said) => write!(f, "{shown} cannot be read: it {said}"),
            Unopened::System(said) => write!(f, "{shown} cannot be read: {said}"),
        }
    }
}

impl std::error::Error for FileError {}

impl From<io::Error> for Unopened {
    fn from(error: io::Error) -> Self {
        if error.kind() == io::ErrorKind::NotFound { Self::Missing } else { Self::System(error) }
    }
}

/// Opens a regular file for reading, without blocking.
///
/// Errors: it is missing, not a regular file, longer than its kind allows, or the operating system reports another
/// error.
pub fn open_file(path: &Path, kind: FileKind) -> Result<OpenFile, FileError> {
    let shown = printable_path(path);
    match open(path, kind) {
        Ok((file, metadata)) => Ok(OpenFile { file, metadata, kind, shown }),
        Err(why) => Err(FileError { shown, kind, why }),
    }
}

/// All bytes of a regular file.
///
/// Errors: as [`open_file`].
pub fn read_file(path: &Path, kind: FileKind) -> Result<Vec<u8>, FileError> {
    open_file(path, kind)?.bytes()
}

fn open(path: &Path, kind: FileKind) -> Result<(File, Metadata), Unopened> {
    // Opening a device can have side effects, so check first; the name may mean another file by then, so check again.
    check_kind(&fs::metadata(path)?, kind)?;
    let mut options = OpenOptions::new();
    options.read(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::custom_flags(&mut options, libc::O_NONBLOCK | libc::O_NOCTTY);
    let file = options.open(path)?;
    let metadata = file.metadata()?;
    check_kind(&metadata, kind)?;
    OPENED.lock().unwrap_or_else(PoisonError::into_inner).insert(path.into());
    Ok((file, metadata))
}

fn check_kind(metadata: &Metadata, kind: FileKind) -> Result<(), Unopened> {
    match metadata.is_file() {
        true if metadata.len() > kind.max => Err(Unopened::TooLong(metadata.len())),
        true => Ok(()),
        false if metadata.is_dir() => Err(Unopened::Folder),
        false => Err(Unopened::NotRegular),
    }
}

impl OpenFile {
    /// Its bytes; it may have grown since it was opened, but not beyond what its kind allows.
    ///
    /// Errors: as [`open_file`].
    pub fn bytes(self) -> Result<Vec<u8>, FileError> {
        let Self { file, metadata, kind, shown } = self;
        // A file may be longer than what it takes on the disk.
        if let Err(too_little) = check_memory(metadata.len()) {
            return Err(FileError { shown, kind, why: Unopened::TooLittleMemory(too_little) });
        }
        let mut bytes = Vec::with_capacity(metadata.len() as usize);
        let read = file.take(kind.max.saturating_add(1)).read_to_end(&mut bytes);
        let why = match read {
            Err(error) => Unopened::from(error),
            Ok(_) if bytes.len() as u64 > kind.max => Unopened::TooLong(bytes.len() as u64),
            Ok(_) => return Ok(bytes),
        };
        Err(FileError { shown, kind, why })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOTE: FileKind = FileKind { name: "a note", max: 8 };

    #[test]
    fn only_regular_files_within_their_bound_are_read() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = |name: &str| folder.path().join(name);
        fs::write(path("short"), b"12345678").expect("written");
        fs::write(path("long"), b"123456789").expect("written");
        assert_eq!(read_file(&path("short"), NOTE).expect("read"), b"12345678");
        let message = |path: &Path| read_file(path, NOTE).expect_err("refused").to_string();
        assert!(message(&path("long")).ends_with("long has 9 bytes, but a note has at most 8"));
        assert!(message(&path("none")).starts_with("there is no file "));
        assert!(message(folder.path()).ends_with("is a folder, but a note is a file"));
    }

    /// A pipe that nobody writes to and a device that never ends: both are refused at once.
    #[cfg(unix)]
    #[test]
    fn pipes_and_devices_are_refused_without_waiting() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let pipe = folder.path().join("pipe");
        let made = std::process::Command::new("mkfifo").arg(&pipe).status().expect("mkfifo");
        assert!(made.success());
        for path in [pipe.as_path(), Path::new("/dev/zero"), Path::new("/dev/null")] {
            assert!(matches!(read_file(path, NOTE).expect_err("refused").why, Unopened::NotRegular), "{path:?}");
        }
    }
}
