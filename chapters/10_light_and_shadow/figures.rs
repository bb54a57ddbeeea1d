//! The figures of chapter 10, drawn from its scene.

use pinhole_lab::figure::{Figure, acne, offset};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "10_light_and_shadow",
            chapter,
            about: "a hit, its error, and where its shadow ray starts",
            draw: offset::draw,
        },
        Figure {
            name: "10_acne",
            chapter,
            about: "shadow rays that start where textbooks have them, in three sizes of one scene",
            draw: acne::draw,
        },
    ]
}
