//! The figures of chapter 33, drawn from its scene.

use pinhole_lab::figure::{Figure, coverage};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "33_edges",
            chapter,
            about: "how many triangles of the screen draw each pixel, by three inside tests",
            draw: coverage::draw_edges,
        },
        Figure {
            name: "33_affine",
            chapter,
            about: "the floor's texture, interpolated on the image and as the renderer has it",
            draw: coverage::draw_affine,
        },
        Figure {
            name: "33_fighting",
            chapter,
            about: "floor and rug in depth buffers of few bits",
            draw: coverage::draw_fighting,
        },
        Figure {
            name: "33_agreement",
            chapter,
            about: "the chapter's picture by rasterisation, by rays, and where the two differ",
            draw: coverage::draw_agreement,
        },
    ]
}
