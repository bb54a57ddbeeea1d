use serde::{Deserialize, Serialize};

/// What a texture's pattern is laid along.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum TextureBy {
    /// The shape's own two coordinates u and v: the pattern bends with the surface.
    Uv,
    /// The shape's own space, before its placement: the shape is carved out of the pattern and takes it along wherever it
    /// is moved, turned and scaled.
    #[default]
    Space,
}

/// What there is beyond an image's edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Wrap {
    /// The image again.
    #[default]
    Repeat,
    /// The texel at the edge.
    Clamp,
}
