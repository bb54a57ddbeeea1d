//! The figures of chapter 06, drawn from its scene.

use pinhole_lab::figure::{Figure, ndc};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![Figure { name: "06_ndc", chapter, about: "one point of the image, in two resolutions", draw: ndc::draw }]
}
