//! The figures of chapter 21, drawn from its scene.

use pinhole_lab::figure::{Figure, jacobian};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![Figure {
        name: "21_jacobian",
        chapter,
        about: "area lights by the right pdf, without its cosine, and without its distance too",
        draw: jacobian::draw,
    }]
}
