//! The figures of chapter 16, drawn from its scene.

use pinhole_lab::figure::{Figure, aliasing, compared};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "16_aliasing",
            chapter,
            about: "textures at one point a pixel, over what a pixel covers, and at many points a pixel",
            draw: aliasing::draw,
        },
        Figure {
            name: "16_relief",
            chapter,
            about: "a ball, a panel and a block with a normal map of round studs, level, shallow and steep",
            draw: compared::draw_relief,
        },
    ]
}
