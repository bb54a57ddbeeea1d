use super::Rgb;
use bevy_ecs::prelude::*;

/// On a material that a model file gives: factors of its colour, beside which a texture has no colour of its own to
/// multiply.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct Tint {
    /// By which the colour of the material's texture is multiplied, each part from 0 to 1.
    pub factor: Rgb,
    /// Whether the colours of a mesh's vertices are a factor, too.
    pub by_vertex: bool,
}
