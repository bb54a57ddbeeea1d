use glam::DVec2;

/// The image's resolution and aspect ratio.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImageFrame {
    /// Pixels from left to right.
    pub width: u32,
    /// Pixels from top to bottom.
    pub height: u32,
}

impl ImageFrame {
    /// Width and height in pixels.
    pub fn size(&self) -> DVec2 {
        DVec2::new(f64::from(self.width), f64::from(self.height))
    }

    /// Width over height.
    pub fn aspect(&self) -> f64 {
        f64::from(self.width) / f64::from(self.height)
    }
}
