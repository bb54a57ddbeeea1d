use super::sketch::Frame;
use super::svg::Svg;
use crate::Result;
use crate::film::{Curve, Film, png_bytes};

/// A small picture within a drawing: linear Rec. 709, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels from left to right.
    pub width: u32,
    /// Pixels from top to bottom.
    pub height: u32,
    /// Their radiance.
    pub pixels: Vec<[f32; 3]>,
}

impl Picture {
    /// Draws it into a frame, its pixels as squares.
    ///
    /// Errors: the picture could not be encoded.
    pub fn paint(&self, svg: &mut Svg, frame: Frame) -> Result {
        let side = self.width.max(self.height).max(1);
        let mut film = Film::new(self.width, self.height, side);
        for (row, &radiance) in self.pixels.iter().enumerate() {
            film.tiles.iter_mut().for_each(|tile| tile.add(row, radiance));
        }
        let png = base64(&png_bytes(&film, Curve::Srgb)?);
        svg.image(frame.low, frame.high - frame.low, &format!("data:image/png;base64,{png}"));
        Ok(())
    }
}

/// Bytes as letters (RFC 4648, section 4): three bytes are four letters of six bits.
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let byte = |at: usize| u32::from(group.get(at).copied().unwrap_or(0));
        let bits = (byte(0) << 16) | (byte(1) << 8) | byte(2);
        for letter in 0..4 {
            let six = (bits >> (18 - 6 * letter)) & 63;
            text.push(if letter <= group.len() { char::from(LETTERS[six as usize]) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The test vectors of RFC 4648, section 10.
    #[test]
    fn letters_are_as_the_standard_has_them() {
        let pairs = [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")];
        for (bytes, letters) in pairs {
            assert_eq!(base64(bytes.as_bytes()), letters);
        }
    }
}
