//! The figures of chapter 35, drawn from its scene.

use pinhole_lab::figure::{Figure, budget, denoising, real_time};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "35_ingredients",
            chapter,
            about: "what projection finds alone, and what each kind of ray adds to it",
            draw: real_time::draw_ingredients,
        },
        Figure {
            name: "35_budget",
            chapter,
            about: "the milliseconds of one frame, by what its stages do",
            draw: budget::draw_budget,
        },
        Figure {
            name: "35_accumulated",
            chapter,
            about: "the picture while the camera rests, after more and more samples",
            draw: real_time::draw_accumulated,
        },
        Figure {
            name: "35_reprojected",
            chapter,
            about: "one sample a pixel, the same with earlier frames of a moving camera, and where they know nothing",
            draw: real_time::draw_reprojected,
        },
        Figure {
            name: "35_ghosts",
            chapter,
            about: "what the frames of a moving camera tend to, and how far that is from the truth",
            draw: real_time::draw_ghosts,
        },
        Figure {
            name: "35_denoised",
            chapter,
            about: "one sample a pixel through more and more levels of the filter",
            draw: real_time::draw_denoised,
        },
        Figure {
            name: "35_albedo",
            chapter,
            about: "the filter on radiance, and on radiance over albedo",
            draw: real_time::draw_albedo,
        },
        Figure {
            name: "35_bias_and_variance",
            chapter,
            about: "the filter's variance and bias apart, over the number of its levels",
            draw: denoising::draw_bias_and_variance,
        },
    ]
}
