/// The type of an accessor's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// 5120
    I8,
    /// 5121
    U8,
    /// 5122
    I16,
    /// 5123
    U16,
    /// 5125
    U32,
    /// 5126
    F32,
}

impl Component {
    /// The type of this code.
    pub fn of(code: u64) -> Option<Self> {
        Some(match code {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    /// Its size, in bytes.
    pub fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }
}

/// Rows of numbers in a buffer: each begins so many bytes behind the one before.
#[derive(Clone, Copy, Debug)]
pub struct Strided<'a> {
    /// The bytes, from the first row's first on.
    pub bytes: &'a [u8],
    /// The bytes from row to row.
    pub stride: usize,
    /// The type of the numbers.
    pub component: Component,
    /// Whether whole numbers stand for those from 0 to 1, or from −1 to 1.
    pub normalized: bool,
}

impl Strided<'_> {
    /// These rows, each of N numbers; those that are not there are zero.
    pub fn floats<const N: usize>(&self, rows: impl Iterator<Item = usize>) -> Vec<[f32; N]> {
        match (self.component, self.normalized) {
            (Component::F32, _) => self.read(rows, f32::from_le_bytes),
            (Component::I8, true) => self.read(rows, |byte| (f32::from(i8::from_le_bytes(byte)) / 127.0).max(-1.0)),
            (Component::U8, true) => self.read(rows, |byte| f32::from(u8::from_le_bytes(byte)) / 255.0),
            (Component::I16, true) => {
                self.read(rows, |bytes| (f32::from(i16::from_le_bytes(bytes)) / 32_767.0).max(-1.0))
            }
            (Component::U16, true) => self.read(rows, |bytes| f32::from(u16::from_le_bytes(bytes)) / 65_535.0),
            (Component::I8, false) => self.read(rows, |byte| f32::from(i8::from_le_bytes(byte))),
            (Component::U8, false) => self.read(rows, |byte| f32::from(u8::from_le_bytes(byte))),
            (Component::I16, false) => self.read(rows, |bytes| f32::from(i16::from_le_bytes(bytes))),
            (Component::U16, false) => self.read(rows, |bytes| f32::from(u16::from_le_bytes(bytes))),
            (Component::U32, _) => self.read(rows, |bytes| u32::from_le_bytes(bytes) as f32),
        }
    }

    /// These rows of one index each; those that are not there are zero.
    pub fn indices(&self, rows: impl Iterator<Item = usize>) -> Vec<u32> {
        let indices = |rows: Vec<[u32; 1]>| rows.into_iter().map(|[index]| index).collect();
        match self.component {
            Component::U8 => indices(self.read(rows, |byte| u32::from(u8::from_le_bytes(byte)))),
            Component::U16 => indices(self.read(rows, |bytes| u32::from(u16::from_le_bytes(bytes)))),
            Component::U32 => indices(self.read(rows, u32::from_le_bytes)),
            Component::I8 | Component::I16 | Component::F32 => Vec::new(),
        }
    }

    #[inline(always)]
    fn read<T: Copy + Default, const N: usize, const SIZE: usize>(
        &self,
        rows: impl Iterator<Item = usize>,
        number: impl Fn([u8; SIZE]) -> T,
    ) -> Vec<[T; N]> {
        let read = |row: usize| {
            let start = row.checked_mul(self.stride);
            let bytes = start.and_then(|start| self.bytes.get(start..)?.get(..N * SIZE)).unwrap_or(&[]);
            let mut numbers = [T::default(); N];
            for (own, bytes) in numbers.iter_mut().zip(bytes.as_chunks().0) {
                *own = number(*bytes);
            }
            numbers
        };
        rows.map(read).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers_may_stand_for_fractions() {
        let bytes = [0x80, 0xff, 0x7f, 0x00, 0xff, 0xff, 0x01, 0x80];
        let read = |component, normalized| {
            Strided { bytes: &bytes, stride: 2, component, normalized }.floats::<1>(0..4).concat()
        };
        assert_eq!(read(Component::U8, true), [128.0 / 255.0, 127.0 / 255.0, 1.0, 1.0 / 255.0]);
        assert_eq!(read(Component::I8, true), [-1.0, 1.0, -1.0 / 127.0, 1.0 / 127.0]);
        assert_eq!(read(Component::U16, true), [1.0 - 127.0 / 65_535.0, 127.0 / 65_535.0, 1.0, 32_769.0 / 65_535.0]);
        assert_eq!(read(Component::I16, true), [-128.0 / 32_767.0, 127.0 / 32_767.0, -1.0 / 32_767.0, -1.0]);
        assert_eq!(read(Component::U8, false), [128.0, 127.0, 255.0, 1.0]);
        assert_eq!(read(Component::I8, false), [-128.0, 127.0, -1.0, 1.0]);
        assert_eq!(read(Component::U16, false), [65_408.0, 127.0, 65_535.0, 32_769.0]);
        assert_eq!(read(Component::I16, false), [-128.0, 127.0, -1.0, -32_767.0]);
    }

    #[test]
    fn rows_that_are_not_there_are_zero() {
        let rows = Strided { bytes: &[1, 2, 3], stride: 2, component: Component::U8, normalized: false };
        assert_eq!(rows.floats([0, 1, usize::MAX].into_iter()), [[1.0, 2.0], [0.0; 2], [0.0; 2]]);
        assert_eq!(rows.indices(0..3), [1, 3, 0]);
    }
}
