//! The figures of chapter 38, from the curves that the renderer computes with.

use pinhole_lab::figure::{Figure, wavelengths};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "38_indices",
            chapter,
            about: "the index of refraction of SF11, of BK7 and of water from violet to red",
            draw: wavelengths::draw_indices,
        },
        Figure {
            name: "38_weights",
            chapter,
            about: "what each nanometre of white light adds to red, green and blue, and how often it is sampled",
            draw: wavelengths::draw_weights,
        },
    ]
}
