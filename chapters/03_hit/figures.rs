//! The figures of chapter 03, drawn from its scene.

use pinhole_lab::figure::{Figure, hit};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![Figure { name: "03_hit", chapter, about: "where a ray hits a sphere", draw: hit::draw }]
}
