//! The figures of chapter 19, drawn from its scene.

use pinhole_lab::figure::{Figure, compared};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "19_broken",
            chapter,
            about: "rough metal, and rough metal by the pdf of something else",
            draw: compared::draw_metal,
        },
        Figure {
            name: "19_principled",
            chapter,
            about: "three balls of the principled material as dielectric, as a mixture, and as metal",
            draw: compared::draw_principled,
        },
    ]
}
