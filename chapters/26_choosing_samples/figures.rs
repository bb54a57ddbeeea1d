//! The figures of chapter 26, drawn from its scene.

use pinhole_lab::figure::{Figure, compared, two_strategies};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "26_strategies",
            chapter,
            about: "area lights found by BSDF sampling, by light sampling, and by both with multiple importance sampling",
            draw: compared::draw_strategies,
        },
        Figure {
            name: "26_samples",
            chapter,
            about: "which samples contribute, by BSDF sampling and by light sampling, for two lobes and two lights",
            draw: two_strategies::draw,
        },
        Figure {
            name: "26_broken",
            chapter,
            about: "a light sampled by two techniques, with weights, and both counted in full",
            draw: compared::draw_weights,
        },
    ]
}
