//! The figures of chapter 39.

use pinhole_lab::figure::{Figure, compared, curves};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "39_ways",
            chapter,
            about: "the room by paths from the camera, by light paths that are connected to it, and by both joined",
            draw: compared::draw_ends,
        },
        Figure {
            name: "39_each",
            chapter,
            about: "the light that each number of vertices from the lamp brings, weighted",
            draw: compared::draw_ways,
        },
        Figure {
            name: "39_methods",
            chapter,
            about: "the error of four methods against processor time, on four scenes",
            draw: curves::draw_methods,
        },
    ]
}
