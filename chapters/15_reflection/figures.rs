//! The figures of chapter 15, drawn from its scene.

use pinhole_lab::figure::{Figure, lobes};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![Figure {
        name: "15_reflection",
        chapter,
        about: "how much each reflection model sends in which direction",
        draw: lobes::draw,
    }]
}
