use crate::png_url;
use pinhole::film::{Curve, Film, FilmTile, png_bytes};
use pinhole::rays::Tile;
use std::io;

/// A small picture, line by line from the top, its parts from 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels from left to right.
    pub width: u32,
    /// Its pixels.
    pub pixels: Vec<[f32; 3]>,
    /// Whether its numbers are light, and go through the sRGB curve.
    pub curve: Curve,
}

/// Pictures side by side, with what is to be seen in them.
#[derive(Clone, Debug, PartialEq)]
pub struct Strip {
    /// What is compared.
    pub title: String,
    /// What is to be seen, in a sentence or two.
    pub says: String,
    /// Each with its name.
    pub pictures: Vec<(String, Picture)>,
}

impl Picture {
    /// How many pixels differ by more than half a byte.
    pub fn differing(&self, other: &Self) -> usize {
        let pairs = self.pixels.iter().zip(&other.pixels);
        pairs.filter(|(one, other)| off(**one, **other) > 0.5 / 255.0).count()
    }

    /// Where the two differ: black where not, the brighter the more, white from a quarter of the range on.
    pub fn difference(&self, other: &Self) -> Self {
        let pairs = self.pixels.iter().zip(&other.pixels);
        let pixels = pairs.map(|(one, other)| [(4.0 * off(*one, *other)).min(1.0); 3]).collect();
        Self { width: self.width, pixels, curve: Curve::Straight }
    }

    /// The picture as a PNG in the text of a page.
    pub fn url(&self) -> io::Result<String> {
        let (width, height) = (self.width, self.pixels.len() as u32 / self.width);
        let mut tile = FilmTile::new(Tile { x: 0, y: 0, width, height });
        for (row, pixel) in self.pixels.iter().enumerate() {
            tile.add(row, pixel.map(|part| if part > 0.0 { part } else { 0.0 }));
        }
        let film = Film { width, height, tile_side: width.max(height), tiles: vec![tile], ..Film::default() };
        Ok(png_url(&png_bytes(&film, self.curve)?))
    }
}

/// The most that one part differs; all there is where a part is NaN.
fn off(one: [f32; 3], other: [f32; 3]) -> f32 {
    let parts = one.iter().zip(other).map(|(one, other)| (one.min(1.0) - other.min(1.0)).abs());
    parts.fold(0.0, |max, part| if part <= max { max } else { part })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_differs_from_another_where_it_does() {
        let grey = |value: f32| Picture { width: 2, pixels: vec![[0.5; 3], [value; 3]], curve: Curve::Straight };
        assert_eq!(grey(0.5).differing(&grey(0.5)), 0);
        assert_eq!(grey(0.5).differing(&grey(f32::NAN)), 1);
        assert_eq!(grey(0.5).difference(&grey(1.0)).pixels, [[0.0; 3], [1.0; 3]]);
        assert!(grey(f32::NAN).url().is_ok_and(|url| url.starts_with("data:image/png;base64,iVBOR")));
    }
}
