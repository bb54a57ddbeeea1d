//! A picture that others are compared with.

use super::develop::{of_mean, relative_square};
use super::painted::Painted;

/// A picture that was kept or read from a file.
pub struct Reference {
    /// What it is, in words.
    pub name: String,
    /// Pixels from left to right and from top to bottom.
    pub size: [u32; 2],
    /// Linear Rec. 709, line by line.
    pub means: Vec<[f32; 3]>,
}

impl Reference {
    /// The mean of (x − r)² / (r² + 0.01) over the channels of all pixels of finite light.
    pub fn rel_mse(&self, picture: &[[f32; 3]]) -> f64 {
        let squares = picture.iter().zip(&self.means).map(|(&x, &r)| f64::from(relative_square(x, r)));
        let (sum, count) = squares.filter(|own| own.is_finite()).fold((0.0, 0_u64), |(sum, n), own| (sum + own, n + 1));
        sum / count.max(1) as f64
    }

    /// What false colour shows of it; none where it shows its colours.
    pub fn quantity(&self, painted: &Painted) -> Option<Vec<f32>> {
        let Painted::Quantity(quantity) = painted else { return None };
        Some(self.means.iter().map(|&mean| of_mean(*quantity, mean, Some(mean))).collect())
    }

    /// Its pixel at this place.
    pub fn at(&self, [x, y]: [u32; 2]) -> Option<[f32; 3]> {
        let [width, height] = self.size;
        let place = y as usize * width as usize + x as usize;
        (x < width && y < height).then(|| self.means.get(place).copied()).flatten()
    }
}
