//! The figures of chapter 22, drawn from its scene.

use pinhole_lab::figure::{Figure, compared, directions};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "22_directions",
            chapter,
            about: "uniform and cosine-weighted directions from the side, above their points of the disk",
            draw: directions::draw,
        },
        Figure {
            name: "22_distance",
            chapter,
            about: "how much of the sky points see, with near occluders alone, and with all",
            draw: compared::draw_distance,
        },
        Figure {
            name: "22_broken",
            chapter,
            about: "how much of the sky points see, with the cosine and without",
            draw: compared::draw_sky,
        },
    ]
}
