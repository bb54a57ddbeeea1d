//! The figures of chapter 27, drawn from its scene.

use pinhole_lab::figure::{Figure, caustics};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![Figure {
        name: "27_sides",
        chapter,
        about: "caustics by rays from the camera alone, and from the light too, once with a mistake",
        draw: caustics::draw_sides,
    }]
}
