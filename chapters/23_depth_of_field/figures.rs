//! The figures of chapter 23, drawn from its scene.

use pinhole_lab::figure::{Figure, cameras};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "23_focus",
            chapter,
            about: "a lens focused near, focused far, and closed to a pinhole",
            draw: cameras::draw_focus,
        },
        Figure {
            name: "23_openings",
            chapter,
            about: "a round opening filled evenly and unevenly, and one of three edges",
            draw: cameras::draw_openings,
        },
        Figure {
            name: "23_cameras",
            chapter,
            about: "one scene through a lens, through a fisheye and in all directions",
            draw: cameras::draw_cameras,
        },
    ]
}
