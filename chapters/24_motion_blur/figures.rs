//! The figures of chapter 24, drawn from its scene.

use pinhole_lab::figure::{Figure, cameras};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "24_frames",
            chapter,
            about: "one motion as the mean of few moments, of more, and of times at random",
            draw: cameras::draw_frames,
        },
        Figure {
            name: "24_shutters",
            chapter,
            about: "one motion, seen for a moment, for a while and for longer",
            draw: cameras::draw_shutters,
        },
    ]
}
