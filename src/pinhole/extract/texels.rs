/// An image in linear light, its rows from top to bottom.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Texels {
    /// Texels from left to right.
    pub width: usize,
    /// Texels from top to bottom.
    pub height: usize,
    /// Red, green, blue, row by row.
    pub rgb: Vec<[f32; 3]>,
}

impl Texels {
    /// A single texel.
    pub fn single(rgb: [f32; 3]) -> Self {
        Self { width: 1, height: 1, rgb: vec![rgb] }
    }

    /// Their memory, in bytes.
    pub fn bytes(&self) -> usize {
        self.rgb.len() * size_of::<[f32; 3]>()
    }
}
