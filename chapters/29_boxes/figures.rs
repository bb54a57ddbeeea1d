//! The figures of chapter 29, drawn from its scene.

use pinhole_lab::figure::{Figure, boxes};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "29_faces",
            chapter,
            about: "blocks seen along an axis, their boxes tested by two slab tests",
            draw: boxes::draw_faces,
        },
        Figure {
            name: "29_areas",
            chapter,
            about: "how often a ray that hits a box hits another box in it, over the ratio of their areas",
            draw: boxes::draw_areas,
        },
    ]
}
