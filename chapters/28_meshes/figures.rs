//! The figures of chapter 28, drawn from its scene.

use pinhole_lab::figure::{Figure, compared};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![Figure {
        name: "28_mistakes",
        chapter,
        about: "shells, and what two mistakes make of them: directions of length 1, and normals taken for directions",
        draw: compared::draw_meshes,
    }]
}
