//! The figures of chapter 02, drawn from its scene.

use pinhole_lab::figure::{Figure, ray};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![Figure { name: "02_ray", chapter, about: "a ray: a point, a unit vector, and t", draw: ray::draw }]
}
