use crate::plan::column;

column! {
    /// The albedo of each surface's diffuse reflection; exists where it is not the material's own colour everywhere.
    pub struct SurfaceColours("colour", "surface", "linear Rec. 709", Ray, begun in Colour) {
        /// Red, from 0 to 1.
        r: f64,
        /// Green.
        g: f64,
        /// Blue.
        b: f64,
    }
}

impl SurfaceColours {
    /// The colour itself, without the sRGB curve that the picture gets.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.r[row] as f32, self.g[row] as f32, self.b[row] as f32]
    }

    /// The colour of a row.
    #[inline(always)]
    pub fn get(&self, row: usize) -> [f64; 3] {
        [self.r[row], self.g[row], self.b[row]]
    }
}
