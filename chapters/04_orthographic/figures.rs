//! The figures of chapter 04, drawn from its scene.

use pinhole_lab::figure::{Figure, orthographic};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![Figure {
        name: "04_orthographic",
        chapter,
        about: "parallel rays from a rectangle of pixels",
        draw: orthographic::draw,
    }]
}
