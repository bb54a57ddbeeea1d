//! The figures of chapter 30, drawn from its scene.

use pinhole_lab::figure::{Figure, tree};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "30_boxes",
            chapter,
            about: "the first boxes of a tree divided at medians, and of one divided where it costs least",
            draw: tree::draw_boxes,
        },
        Figure {
            name: "30_divisions",
            chapter,
            about: "how much rays are tested against in both trees, pixel by pixel",
            draw: tree::draw_divisions,
        },
        Figure {
            name: "30_growth",
            chapter,
            about: "what a ray is tested against, over the number of spheres",
            draw: tree::draw_growth,
        },
        Figure {
            name: "30_first_found",
            chapter,
            about: "the closest hit, and the first one that is found",
            draw: tree::draw_first_found,
        },
        Figure {
            name: "30_views",
            chapter,
            about: "the picture, and what its rays are tested against",
            draw: tree::draw_views,
        },
    ]
}
