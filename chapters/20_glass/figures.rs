//! The figures of chapter 20, drawn from its scene.

use pinhole_lab::figure::{Figure, compared, fresnel, refraction};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "20_refraction",
            chapter,
            about: "a ray at a surface of glass: reflected, refracted, and the parts that Snell's law is about",
            draw: refraction::draw,
        },
        Figure {
            name: "20_glass",
            chapter,
            about: "how much of the light glass mirrors at each angle, from outside and from inside",
            draw: fresnel::draw,
        },
        Figure {
            name: "20_broken",
            chapter,
            about: "glass, glass that bends with the inverted index, and glass that keeps radiance as it is",
            draw: compared::draw_glass,
        },
        Figure {
            name: "20_frosted",
            chapter,
            about: "the glass ball nearly smooth, frosted and rough",
            draw: compared::draw_rough_glass,
        },
    ]
}
