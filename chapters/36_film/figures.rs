//! The figures of chapter 36, drawn from its scene.

use pinhole_lab::figure::{Figure, films};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "36_curves",
            chapter,
            about: "one path through five keys along straight lines, along a curve for even keys and along the smooth one",
            draw: films::draw_curves,
        },
        Figure {
            name: "36_wagon_wheel",
            chapter,
            about: "a wheel at four frames after one another, whose spokes seem to turn backwards",
            draw: films::draw_wagon_wheel,
        },
        Figure {
            name: "36_angles",
            chapter,
            about: "a turning wheel, the shutter open for no time, for half of a frame and for all of it",
            draw: films::draw_angles,
        },
        Figure {
            name: "36_moments",
            chapter,
            about: "a turning wheel as the mean of few moments and of more",
            draw: films::draw_moments,
        },
    ]
}
