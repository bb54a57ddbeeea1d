use crate::model_error::ModelError;

/// How many bytes of a model each byte of its files may become, and how many it may take in any case.
const BYTES_A_BYTE: u64 = 40;
const BYTES_IN_ANY_CASE: u64 = 1 << 18;

/// How much memory a model may still take.
///
/// A small file can name one part of a buffer a thousand times; what that would become is refused before it is there.
#[derive(Clone, Copy, Debug)]
pub struct Memory {
    read: u64,
    taken: u64,
}

impl Memory {
    /// That of a file of this many bytes.
    pub fn of(file: &[u8]) -> Self {
        Self { read: file.len() as u64, taken: 0 }
    }

    /// Another file was read.
    pub fn add_file(&mut self, file: &[u8]) {
        self.read += file.len() as u64;
    }

    /// Takes so many rows of so many bytes.
    ///
    /// Errors: there would be too many of them; what and where they are is asked only then.
    pub fn take(&mut self, rows: u64, bytes: u64, what: impl FnOnce() -> [String; 2]) -> Result<(), ModelError> {
        let max = self.read.saturating_mul(BYTES_A_BYTE).saturating_add(BYTES_IN_ANY_CASE);
        self.taken = self.taken.saturating_add(rows.saturating_mul(bytes));
        if self.taken <= max {
            return Ok(());
        }
        let [file, place] = what();
        let accepted = format!(
            "the model would take {} bytes with it, and a model may take {BYTES_A_BYTE} times the {} bytes of its \
             files",
            self.taken, self.read
        );
        Err(ModelError::new(&file, place, format!("{rows} rows of {bytes} bytes"), accepted))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_model_takes_is_bounded_by_its_files() {
        let mut memory = Memory::of(&[0; 100]);
        let place = || ["a.gltf".to_owned(), "meshes[0]".to_owned()];
        assert_eq!(memory.take(BYTES_IN_ANY_CASE, 1, place), Ok(()));
        assert_eq!(memory.take(1000, 4, place), Ok(()));
        memory.add_file(&[0; 1]);
        assert_eq!(memory.take(40, 1, place), Ok(()));
        let error = memory.take(3, 5, place).expect_err("too much");
        assert_eq!(
            error.to_string(),
            "a.gltf: meshes[0] is 3 rows of 5 bytes, but the model would take 266199 bytes with it, and a model may \
             take \
             40 times the 101 bytes of its files"
        );
        assert!(Memory::of(&[]).take(u64::MAX, u64::MAX, place).is_err());
    }
}
