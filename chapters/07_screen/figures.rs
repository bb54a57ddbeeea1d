//! The figures of chapter 07, drawn from its scene.

use pinhole_lab::figure::{Figure, screen};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "07_screen",
            chapter,
            about: "the screen of an oblong image beside that of a square one",
            draw: screen::draw,
        },
        Figure {
            name: "07_naive",
            chapter,
            about: "an aspect forgotten, a sign forgotten, a sign too many",
            draw: screen::draw_naive,
        },
    ]
}
