/// What a random number is for; each purpose has a dimension of its own, whether or not a scene uses the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum Purpose {
    /// Where in the pixel, to the right.
    PixelX,
    /// Where in the pixel, downward.
    PixelY,
}
