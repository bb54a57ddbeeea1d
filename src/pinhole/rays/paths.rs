use crate::plan::column;

column! {
    /// The way of light that each ray goes on with.
    pub struct Paths("path", "light", "share, 1/sr", Path, begun in Start) {
        /// The tile's row on the first leg.
        first: u32,
        /// The share of what this ray brings back that reaches the film, red.
        r: f64,
        /// Green.
        g: f64,
        /// Blue.
        b: f64,
        /// How densely chance sends rays this way, over solid angle; infinite where no chance was in it.
        pdf: f64,
    }
}

impl Paths {
    /// The share that reaches the film.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        self.share(row).map(|part| part as f32)
    }

    /// The share of a row that reaches the film.
    #[inline(always)]
    pub fn share(&self, row: usize) -> [f64; 3] {
        [self.r[row], self.g[row], self.b[row]]
    }
}

column! {
    /// The light that each way has brought to the film so far.
    pub struct PathLight("path light", "light", "linear Rec. 709", Path, begun in Start) {
        /// Red.
        r: f64,
        /// Green.
        g: f64,
        /// Blue.
        b: f64,
    }
}

impl PathLight {
    /// The numbers themselves.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.r[row], self.g[row], self.b[row]].map(|part| part as f32)
    }
}
