use serde::{Deserialize, Serialize};

/// The coordinates at which a texture is evaluated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum TextureBy {
    /// The surface's own parameters u and v: the pattern follows the surface.
    Uv,
    /// Object space (a solid texture): the shape is carved out of the pattern, which moves, rotates and scales with it.
    #[default]
    Space,
}

/// How an image texture continues beyond its edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Wrap {
    /// The image is repeated.
    #[default]
    Repeat,
    /// The texels at the edge are extended.
    Clamp,
}
