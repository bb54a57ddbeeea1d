//! A cache of what files hold, such as images and models, so that each file is decoded once, however many entities name
//! it and however often it is requested: by validation, by the tables, by the preflight checks.

use super::{FileError, FileKind, open_file};
use std::fs::{self, Metadata};
use std::hash::{DefaultHasher, Hasher};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use std::time::{Duration, SystemTime};

/// What is no longer used is kept up to this many bytes.
const UNUSED: usize = 512 << 20;
/// A file written less than this before it was read may be written again with the same time stamp.
const SETTLED: Duration = Duration::from_secs(2);

/// What distinguishes the states of a file without reading it.
#[derive(Clone, Debug, PartialEq, Eq)]
struct FileState {
    path: PathBuf,
    length: u64,
    modified: Option<SystemTime>,
    /// The inode number and the time of the last change, where the system has them.
    inode: [i64; 4],
}

impl FileState {
    fn of(path: &Path, metadata: &Metadata) -> Self {
        #[cfg(unix)]
        let inode = {
            use std::os::unix::fs::MetadataExt;
            [metadata.dev() as i64, metadata.ino() as i64, metadata.ctime(), metadata.ctime_nsec()]
        };
        #[cfg(not(unix))]
        let inode = [0; 4];
        let path = fs::canonicalize(path).unwrap_or_else(|_| path.into());
        Self { path, length: metadata.len(), modified: metadata.modified().ok(), inode }
    }

    /// Whether it has been unchanged for long enough that its time stamp identifies it.
    fn is_settled(&self) -> bool {
        let age = self.modified.and_then(|modified| SystemTime::now().duration_since(modified).ok());
        age.is_some_and(|age| age > SETTLED)
    }
}

/// What a file held, and the state of the file.
struct Kept<T> {
    state: FileState,
    /// The hash of the bytes, where the file was too recent to be identified by its time stamp.
    hash: Option<u64>,
    bytes: usize,
    content: Weak<T>,
    /// Keeps what is no longer used.
    unused: Option<Arc<T>>,
}

/// What files of one kind hold, the most recently used at the end.
pub struct FileStore<T>(Mutex<Vec<Kept<T>>>);

impl<T> Default for FileStore<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T> FileStore<T> {
    /// An empty cache.
    pub const fn new() -> Self {
        Self(Mutex::new(Vec::new()))
    }

    /// What a file holds: decoded before, or the result of `decode` for its bytes, together with its memory in bytes.
    ///
    /// Errors: the file cannot be read, or the error of `decode`.
    pub fn get(
        &self,
        path: &Path,
        kind: FileKind,
        decode: impl FnOnce(&[u8]) -> Result<(T, usize), String>,
    ) -> Result<Arc<T>, Undecoded> {
        let file = open_file(path, kind)?;
        let state = FileState::of(path, &file.metadata);
        let mut kept = self.lock();
        let known = take(&mut kept, &state).and_then(|kept| Some((kept.content.upgrade()?, kept.hash, kept.bytes)));
        if let Some((content, None, bytes)) = known {
            return Ok(keep(&mut kept, state, None, content, bytes));
        }
        let held = file.bytes()?;
        if let Some((content, Some(hash), bytes)) = known
            && hash_of(&held) == hash
        {
            return Ok(keep(&mut kept, state, Some(hash), content, bytes));
        }
        let hash = (!state.is_settled()).then(|| hash_of(&held));
        let (content, bytes) = decode(&held).map_err(Undecoded::Content)?;
        Ok(keep(&mut kept, state, hash, Arc::new(content), bytes))
    }

    /// The same for bytes that another file held, under a name.
    ///
    /// Errors: that of `decode`.
    pub fn of_bytes(
        &self,
        name: &Path,
        bytes: &[u8],
        decode: impl FnOnce(&[u8]) -> Result<(T, usize), String>,
    ) -> Result<Arc<T>, String> {
        let state = FileState { path: name.into(), length: bytes.len() as u64, modified: None, inode: [0; 4] };
        let hash = hash_of(bytes);
        let mut kept = self.lock();
        let known = take(&mut kept, &state).filter(|kept| kept.hash == Some(hash));
        if let Some((content, bytes)) = known.and_then(|kept| Some((kept.content.upgrade()?, kept.bytes))) {
            return Ok(keep(&mut kept, state, Some(hash), content, bytes));
        }
        let (content, bytes) = decode(bytes)?;
        Ok(keep(&mut kept, state, Some(hash), Arc::new(content), bytes))
    }

    /// Whether what a file holds is in memory.
    pub fn holds(&self, path: &Path, metadata: &Metadata) -> bool {
        let state = FileState::of(path, metadata);
        self.lock().iter().any(|kept| kept.state == state && kept.content.strong_count() > 0)
    }

    fn lock(&self) -> MutexGuard<'_, Vec<Kept<T>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn take<T>(kept: &mut Vec<Kept<T>>, state: &FileState) -> Option<Kept<T>> {
    let at = kept.iter().position(|kept| kept.state == *state)?;
    Some(kept.remove(at))
}

/// Adds one at the end, and drops unused ones before it that exceed the limit.
fn keep<T>(kept: &mut Vec<Kept<T>>, state: FileState, hash: Option<u64>, content: Arc<T>, bytes: usize) -> Arc<T> {
    let unused = Some(Arc::clone(&content));
    kept.push(Kept { state, hash, bytes, content: Arc::downgrade(&content), unused });
    let mut sum = 0;
    for (age, kept) in kept.iter_mut().rev().enumerate() {
        sum += kept.bytes;
        if age > 0 && sum > UNUSED {
            kept.unused = None;
        }
    }
    kept.retain(|kept| kept.content.strong_count() > 0);
    content
}

fn hash_of(bytes: &[u8]) -> u64 {
    let mut hasher = DefaultHasher::new();
    hasher.write(bytes);
    hasher.finish()
}

/// Why a file was not decoded.
#[derive(Debug)]
pub enum Undecoded {
    /// The file could not be read.
    File(FileError),
    /// Its content cannot be used.
    Content(String),
}

impl From<FileError> for Undecoded {
    fn from(error: FileError) -> Self {
        Self::File(error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::IMAGE_FILE;
    use std::cell::Cell;

    #[test]
    fn a_file_is_decoded_once_until_it_changes() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = |name: &str| folder.path().join(name);
        let store: FileStore<Vec<u8>> = FileStore::new();
        let decoded = Cell::new(0);
        let get = |name: &str| {
            let decode = |bytes: &[u8]| {
                decoded.set(decoded.get() + 1);
                Ok((bytes.to_vec(), bytes.len()))
            };
            store.get(&file(name), IMAGE_FILE, decode).expect("decoded")
        };
        fs::write(file("a"), b"one").expect("written");
        fs::write(file("b"), b"one").expect("written");
        let first = get("a");
        assert!(Arc::ptr_eq(&first, &get("a")) && Arc::ptr_eq(&first, &get("./a")));
        assert_eq!(decoded.get(), 1);
        assert!(!Arc::ptr_eq(&first, &get("b")), "another file is another image");
        assert_eq!((get("a").as_slice(), decoded.get()), (&b"one"[..], 2));
        // Of the same length, and perhaps within one tick of the file system's clock.
        fs::write(file("a"), b"two").expect("written");
        assert_eq!((get("a").as_slice(), decoded.get()), (&b"two"[..], 3));
        assert_eq!(first.as_slice(), b"one", "a user of the old image keeps it");
    }

    #[test]
    fn an_image_in_use_is_never_decoded_again_and_an_unused_one_is_dropped() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let store: FileStore<usize> = FileStore::new();
        let decoded = Cell::new(0);
        let get = |number: usize| {
            let path = folder.path().join(number.to_string());
            if !path.exists() {
                fs::write(&path, number.to_string()).expect("written");
            }
            let decode = |_: &[u8]| {
                decoded.set(decoded.get() + 1);
                Ok((number, UNUSED / 2))
            };
            store.get(&path, IMAGE_FILE, decode).expect("decoded")
        };
        let used = get(0);
        (1..6).for_each(|number| _ = get(number));
        assert_eq!(decoded.get(), 6);
        assert!(Arc::ptr_eq(&used, &get(0)) && decoded.get() == 6, "in use");
        get(5);
        assert_eq!(decoded.get(), 6, "the last is still there");
        get(1);
        assert_eq!(decoded.get(), 7, "the oldest unused one is not");
    }
}
