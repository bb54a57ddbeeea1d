//! A cache of decoded images, so that each file is decoded once, however many entities name it and however often it is
//! requested: by validation, by the tables, by the preflight checks.

use crate::scene::{FileError, IMAGE_FILE, open_file};
use std::fs::{self, Metadata};
use std::hash::{DefaultHasher, Hasher};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use std::time::{Duration, SystemTime};

/// Images that are no longer used are kept up to this many bytes.
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

/// An image, and the state of the file that it was decoded from.
struct Kept<T> {
    state: FileState,
    /// The hash of the bytes, where the file was too recent to be identified by its time stamp.
    hash: Option<u64>,
    bytes: usize,
    image: Weak<T>,
    /// Keeps an image that is no longer used.
    unused: Option<Arc<T>>,
}

/// Decoded images of one kind, the most recently used at the end.
pub struct ImageStore<T>(Mutex<Vec<Kept<T>>>);

impl<T> ImageStore<T> {
    /// An empty cache.
    pub const fn new() -> Self {
        Self(Mutex::new(Vec::new()))
    }

    /// The image of a file: the one decoded before, or the result of `decode` for its bytes, together with the image's
    /// memory in bytes.
    ///
    /// Errors: the file cannot be read, or the error of `decode`.
    pub fn get(
        &self,
        path: &Path,
        decode: impl FnOnce(&[u8]) -> Result<(T, usize), String>,
    ) -> Result<Arc<T>, Undecoded> {
        let file = open_file(path, IMAGE_FILE)?;
        let state = FileState::of(path, &file.metadata);
        let mut kept = self.lock();
        let known = take(&mut kept, &state).and_then(|kept| Some((kept.image.upgrade()?, kept.hash, kept.bytes)));
        if let Some((image, None, bytes)) = known {
            return Ok(keep(&mut kept, state, None, image, bytes));
        }
        let held = file.bytes()?;
        if let Some((image, Some(hash), bytes)) = known
            && hash_of(&held) == hash
        {
            return Ok(keep(&mut kept, state, Some(hash), image, bytes));
        }
        let hash = (!state.is_settled()).then(|| hash_of(&held));
        let (image, bytes) = decode(&held).map_err(Undecoded::Image)?;
        Ok(keep(&mut kept, state, hash, Arc::new(image), bytes))
    }

    /// Whether the image of a file is in memory.
    pub fn holds(&self, path: &Path, metadata: &Metadata) -> bool {
        let state = FileState::of(path, metadata);
        self.lock().iter().any(|kept| kept.state == state && kept.image.strong_count() > 0)
    }

    fn lock(&self) -> MutexGuard<'_, Vec<Kept<T>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn take<T>(kept: &mut Vec<Kept<T>>, state: &FileState) -> Option<Kept<T>> {
    let at = kept.iter().position(|kept| kept.state == *state)?;
    Some(kept.remove(at))
}

/// Adds an image at the end, and drops unused ones before it that exceed the limit.
fn keep<T>(kept: &mut Vec<Kept<T>>, state: FileState, hash: Option<u64>, image: Arc<T>, bytes: usize) -> Arc<T> {
    let unused = Some(Arc::clone(&image));
    kept.push(Kept { state, hash, bytes, image: Arc::downgrade(&image), unused });
    let mut sum = 0;
    for (age, kept) in kept.iter_mut().rev().enumerate() {
        sum += kept.bytes;
        if age > 0 && sum > UNUSED {
            kept.unused = None;
        }
    }
    kept.retain(|kept| kept.image.strong_count() > 0);
    image
}

fn hash_of(bytes: &[u8]) -> u64 {
    let mut hasher = DefaultHasher::new();
    hasher.write(bytes);
    hasher.finish()
}

/// The reason why there is no image.
#[derive(Debug)]
pub enum Undecoded {
    /// The file could not be read.
    File(FileError),
    /// Its content is not an image that can be used.
    Image(String),
}

impl From<FileError> for Undecoded {
    fn from(error: FileError) -> Self {
        Self::File(error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    #[test]
    fn a_file_is_decoded_once_until_it_changes() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = |name: &str| folder.path().join(name);
        let store: ImageStore<Vec<u8>> = ImageStore::new();
        let decoded = Cell::new(0);
        let get = |name: &str| {
            let decode = |bytes: &[u8]| {
                decoded.set(decoded.get() + 1);
                Ok((bytes.to_vec(), bytes.len()))
            };
            store.get(&file(name), decode).expect("decoded")
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
        let store: ImageStore<usize> = ImageStore::new();
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
            store.get(&path, decode).expect("decoded")
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
