//! The figures of chapter 32, drawn from its scene.

use pinhole_lab::figure::{Figure, projection};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "32_wireframe",
            chapter,
            about: "the edges of the shell, projected point by point, over the picture that rays make of it",
            draw: projection::draw_wireframe,
        },
        Figure {
            name: "32_clipping",
            chapter,
            about: "the pier's two triangles with and without clipping",
            draw: projection::draw_clipping,
        },
        Figure {
            name: "32_depth",
            chapter,
            about: "depth and its reciprocal along a line of the image",
            draw: projection::draw_depth,
        },
    ]
}
