//! The figures of chapter 17, drawn from its scene.

use pinhole_lab::figure::{Figure, filters, rings, samples};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "17_rings",
            chapter,
            about: "rings that become finer than a pixel, with three samplers",
            draw: rings::draw,
        },
        Figure {
            name: "17_points",
            chapter,
            about: "64 points of each sampler in one pixel",
            draw: samples::draw_points,
        },
        Figure {
            name: "17_filters",
            chapter,
            about: "five filters, from the pixel's centre outward",
            draw: filters::draw,
        },
        Figure {
            name: "17_variance",
            chapter,
            about: "the variance of a mean over the number of its samples",
            draw: samples::draw_variance,
        },
    ]
}
