use crate::plan::column;

column! {
    /// The path that each ray belongs to: its pixel, its throughput, and the pdf of its last direction.
    pub struct Paths("path", "light", "throughput, 1/sr", Path, begun in Start) {
        /// The row of the path's camera ray.
        first: u32,
        /// Throughput, red: the factor by which radiance along this ray contributes to the film.
        r: f64,
        /// Throughput, green.
        g: f64,
        /// Throughput, blue.
        b: f64,
        /// The pdf, per solid angle, with which BSDF sampling chose this direction; infinite for camera rays and after
        /// specular bounces (a delta distribution).
        pdf: f64,
    }
}

impl Paths {
    /// Paints the throughput.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        self.throughput(row).map(|component| component as f32)
    }

    /// The throughput of a row, as red, green and blue.
    #[inline(always)]
    pub fn throughput(&self, row: usize) -> [f64; 3] {
        [self.r[row], self.g[row], self.b[row]]
    }
}

column! {
    /// The radiance that each path has contributed to the film so far.
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
    /// Paints the radiance.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.r[row], self.g[row], self.b[row]].map(|component| component as f32)
    }
}
