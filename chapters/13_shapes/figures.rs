//! The figures of chapter 13, drawn from its scene.

use pinhole_lab::figure::{Figure, slabs};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![Figure {
        name: "13_slabs",
        chapter,
        about: "where a ray is inside each slab of a cuboid, and inside all three",
        draw: slabs::draw,
    }]
}
