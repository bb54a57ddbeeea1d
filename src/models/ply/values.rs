//! The numbers of a file, one after another.

use super::element::Number;
use crate::number::{double, float, whole};

/// Why a number cannot be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Absent<'b> {
    /// The file ends there.
    End,
    /// Another word is there.
    Word(&'b [u8]),
}

/// Reads numbers.
pub trait Values<'b> {
    /// The next number as a coordinate.
    fn float(&mut self, number: Number) -> Result<f32, Absent<'b>>;

    /// The same in f64.
    fn double(&mut self, number: Number) -> Result<f64, Absent<'b>>;

    /// The next number, which is whole.
    fn whole(&mut self, number: Number) -> Result<i64, Absent<'b>>;

    /// Passes over so many numbers.
    fn skip(&mut self, number: Number, count: u64) -> Result<(), Absent<'b>>;

    /// The bytes of so many rows of this size, if that is how the file has them.
    fn rows(&mut self, count: u64, size: usize) -> Option<&'b [u8]>;

    /// The corners of a list of three, if that is what follows and it can be read at once.
    fn triangle(&mut self, count: Number, index: Number) -> Option<[u32; 3]>;

    /// The number of bytes that are left.
    fn left(&self) -> usize;

    /// A row has been read: where each has a line of its own, what is left of that is passed over.
    ///
    /// Whether there was anything.
    fn end_row(&mut self) -> bool {
        false
    }
}

/// Numbers as text.
pub struct Text<'b> {
    /// What is left.
    pub rest: &'b [u8],
    /// Whether each row has a line of its own.
    pub a_line_each: bool,
}

impl<'b> Text<'b> {
    /// The numbers of so many rows.
    ///
    /// A row has a line of its own unless there are fewer lines than rows.
    pub fn of(rest: &'b [u8], rows: u64) -> Self {
        let lines = rest.split(|byte| matches!(byte, b'\n' | b'\r')).filter(|line| !line.trim_ascii().is_empty());
        Self { rest, a_line_each: lines.count() as u64 >= rows }
    }

    fn word(&mut self) -> Result<&'b [u8], Absent<'b>> {
        let start = self.rest.iter().position(|byte| !byte.is_ascii_whitespace()).ok_or(Absent::End)?;
        let rest = &self.rest[start..];
        let end = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        self.rest = &rest[end..];
        Ok(&rest[..end])
    }
}

impl<'b> Values<'b> for Text<'b> {
    fn float(&mut self, _: Number) -> Result<f32, Absent<'b>> {
        let word = self.word()?;
        float(word).ok_or(Absent::Word(word))
    }

    fn double(&mut self, _: Number) -> Result<f64, Absent<'b>> {
        let word = self.word()?;
        double(word).ok_or(Absent::Word(word))
    }

    fn whole(&mut self, _: Number) -> Result<i64, Absent<'b>> {
        let word = self.word()?;
        whole(word).ok_or(Absent::Word(word))
    }

    fn skip(&mut self, _: Number, count: u64) -> Result<(), Absent<'b>> {
        (0..count).try_for_each(|_| self.word().map(|_| ()))
    }

    fn rows(&mut self, _: u64, _: usize) -> Option<&'b [u8]> {
        None
    }

    fn triangle(&mut self, _: Number, _: Number) -> Option<[u32; 3]> {
        None
    }

    fn left(&self) -> usize {
        self.rest.len()
    }

    fn end_row(&mut self) -> bool {
        if !self.a_line_each {
            return false;
        }
        let end = self.rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')).unwrap_or(self.rest.len());
        let (line, rest) = self.rest.split_at(end);
        self.rest = rest;
        !line.trim_ascii().is_empty()
    }
}

/// Numbers in binary.
pub struct Binary<'b, const BIG: bool> {
    /// What is left.
    pub rest: &'b [u8],
}

impl<'b, const BIG: bool> Binary<'b, BIG> {
    #[inline(always)]
    fn bytes<const N: usize>(&mut self) -> Result<[u8; N], Absent<'b>> {
        let (bytes, rest) = self.rest.split_first_chunk().ok_or(Absent::End)?;
        self.rest = rest;
        Ok(ordered::<BIG, N>(*bytes))
    }
}

/// The bytes of a number, the lowest first.
#[inline(always)]
fn ordered<const BIG: bool, const N: usize>(mut bytes: [u8; N]) -> [u8; N] {
    if BIG {
        bytes.reverse();
    }
    bytes
}

/// A number at the start of these bytes in f64; 0 if they are too few.
#[inline(always)]
pub fn double_at<const BIG: bool>(bytes: &[u8], number: Number) -> f64 {
    let mut values = Binary::<BIG> { rest: bytes };
    values.double(number).unwrap_or_default()
}

/// A number at the start of these bytes as a coordinate; 0 if they are too few.
#[inline(always)]
pub fn float_at<const BIG: bool>(bytes: &[u8], number: Number) -> f32 {
    let mut values = Binary::<BIG> { rest: bytes };
    values.float(number).unwrap_or_default()
}

impl<'b, const BIG: bool> Values<'b> for Binary<'b, BIG> {
    #[inline(always)]
    fn float(&mut self, number: Number) -> Result<f32, Absent<'b>> {
        Ok(match number {
            Number::F32 => f32::from_le_bytes(self.bytes()?),
            Number::F64 => f64::from_le_bytes(self.bytes()?) as f32,
            whole => self.whole(whole)? as f32,
        })
    }

    #[inline(always)]
    fn double(&mut self, number: Number) -> Result<f64, Absent<'b>> {
        Ok(match number {
            Number::F32 => f32::from_le_bytes(self.bytes()?).into(),
            Number::F64 => f64::from_le_bytes(self.bytes()?),
            whole => self.whole(whole)? as f64,
        })
    }

    #[inline(always)]
    fn whole(&mut self, number: Number) -> Result<i64, Absent<'b>> {
        Ok(match number {
            Number::I8 => i64::from(i8::from_le_bytes(self.bytes()?)),
            Number::U8 => i64::from(u8::from_le_bytes(self.bytes()?)),
            Number::I16 => i64::from(i16::from_le_bytes(self.bytes()?)),
            Number::U16 => i64::from(u16::from_le_bytes(self.bytes()?)),
            Number::I32 => i64::from(i32::from_le_bytes(self.bytes()?)),
            Number::U32 => i64::from(u32::from_le_bytes(self.bytes()?)),
            Number::F32 => f32::from_le_bytes(self.bytes()?) as i64,
            Number::F64 => f64::from_le_bytes(self.bytes()?) as i64,
        })
    }

    fn skip(&mut self, number: Number, count: u64) -> Result<(), Absent<'b>> {
        self.rows(count, number.size()).map(|_| ()).ok_or(Absent::End)
    }

    fn rows(&mut self, count: u64, size: usize) -> Option<&'b [u8]> {
        let length = usize::try_from(count).ok()?.checked_mul(size)?;
        let (rows, rest) = self.rest.split_at_checked(length)?;
        self.rest = rest;
        Some(rows)
    }

    #[inline(always)]
    fn triangle(&mut self, count: Number, index: Number) -> Option<[u32; 3]> {
        // As nearly all files have them: a byte, and three times four.
        if count.size() != 1 || index.size() != 4 {
            return None;
        }
        let ([3, corners @ ..], rest) = self.rest.split_first_chunk::<13>()? else { return None };
        self.rest = rest;
        let corner = |corner: &[u8; 4]| u32::from_le_bytes(ordered::<BIG, 4>(*corner));
        match corners.as_chunks().0 {
            [a, b, c] => Some([corner(a), corner(b), corner(c)]),
            _ => None,
        }
    }

    fn left(&self) -> usize {
        self.rest.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn binary_numbers_are_those_of_their_type() {
        let bytes = [0x80, 0xff, 0x01, 0x40, 0x00, 0x00, 0x00, 0x00];
        let le = |number| Binary::<false> { rest: &bytes }.whole(number);
        let be = |number| Binary::<true> { rest: &bytes }.whole(number);
        assert_eq!([le(Number::I8), le(Number::U8)], [Ok(-128), Ok(128)]);
        assert_eq!([le(Number::I16), le(Number::U16)], [Ok(-128), Ok(0xff80)]);
        assert_eq!([be(Number::I16), be(Number::U16)], [Ok(-0x7f01), Ok(0x80ff)]);
        assert_eq!([le(Number::I32), le(Number::U32)], [Ok(0x4001_ff80), Ok(0x4001_ff80)]);
        assert_eq!([be(Number::I32), be(Number::U32)], [Ok(0x80ff_0140_u32.cast_signed().into()), Ok(0x80ff_0140)]);
        assert_eq!(Binary::<true> { rest: &1.5_f64.to_be_bytes() }.float(Number::F64), Ok(1.5));
        assert_eq!(Binary::<false> { rest: &1.5_f32.to_le_bytes() }.float(Number::F32), Ok(1.5));
        assert_eq!(Binary::<false> { rest: &1e300_f64.to_le_bytes() }.float(Number::F64), Ok(f32::INFINITY));
        assert_eq!(Binary::<false> { rest: &[7] }.float(Number::U8), Ok(7.0));
    }

    #[test]
    fn a_triangle_is_read_at_once_where_it_can_be() {
        let bytes = [3, 1, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, 0, 4];
        let mut values = Binary::<false> { rest: &bytes };
        assert_eq!(values.triangle(Number::U16, Number::I32), None);
        assert_eq!(values.triangle(Number::U8, Number::U16), None);
        assert_eq!((values.triangle(Number::U8, Number::I32), values.left()), (Some([1, 2, 256]), 1));
        assert_eq!(values.triangle(Number::U8, Number::I32), None);
        let mut values = Binary::<true> { rest: &bytes };
        assert_eq!(values.triangle(Number::I8, Number::U32), Some([1 << 24, 2 << 24, 1 << 16]));
        let mut values = Binary::<false> { rest: &[4; 20] };
        assert_eq!((values.triangle(Number::U8, Number::I32), values.left()), (None, 20));
    }

    #[test]
    fn a_row_ends_with_its_line_where_there_are_enough_lines() {
        for end in ["\n", "\r\n", "\r", " \n\n"] {
            let text = ["1 2", "3 4 5", "6 7"].join(end);
            let mut values = Text::of(text.as_bytes(), 3);
            let mut row = || [values.whole(Number::I8), values.whole(Number::I8), Ok(values.end_row().into())];
            assert_eq!([row(), row(), row()], [[Ok(1), Ok(2), Ok(0)], [Ok(3), Ok(4), Ok(1)], [Ok(6), Ok(7), Ok(0)]]);
        }
        let mut values = Text::of(b"1 2 3 4\n5 6", 3);
        let mut row = || [values.whole(Number::I8), values.whole(Number::I8), Ok(values.end_row().into())];
        assert_eq!([row(), row(), row()], [[Ok(1), Ok(2), Ok(0)], [Ok(3), Ok(4), Ok(0)], [Ok(5), Ok(6), Ok(0)]]);
    }

    #[test]
    fn a_file_may_end_anywhere() {
        let mut values = Binary::<false> { rest: &[1, 2, 3] };
        assert_eq!(values.float(Number::F32), Err(Absent::End));
        assert_eq!(values.skip(Number::U16, 2), Err(Absent::End));
        assert_eq!(values.rows(u64::MAX, 8), None);
        assert_eq!(values.skip(Number::U8, 3), Ok(()));
        assert_eq!(values.left(), 0);
        let mut values = Text { rest: b" 1 2.5\nx", a_line_each: false };
        assert_eq!(values.whole(Number::U8), Ok(1));
        assert_eq!(values.whole(Number::U8), Err(Absent::Word(b"2.5")));
        assert_eq!(values.float(Number::F32), Err(Absent::Word(b"x")));
        assert_eq!(values.skip(Number::U8, 1), Err(Absent::End));
    }
}
