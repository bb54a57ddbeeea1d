//! The figures of chapter 26, drawn from its scene.

use pinhole_lab::figure::{Figure, integrators, path_mistakes};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "26_strategies",
            chapter,
            about: "area lights found by BSDF sampling, by light sampling, and by both with multiple importance sampling",
            draw: integrators::draw_ways,
        },
        Figure {
            name: "26_broken",
            chapter,
            about: "a light sampled by two techniques, with weights, and both counted in full",
            draw: path_mistakes::draw_weights,
        },
    ]
}
