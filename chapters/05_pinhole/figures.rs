//! The figures of chapter 05, drawn from its scene.

use pinhole_lab::figure::{Figure, pinhole, two_classes};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "two_classes",
            chapter,
            about: "object-order and image-order rendering: from the object to the pixel, and from the pixel to the light",
            draw: two_classes::draw,
        },
        Figure {
            name: "05_pinhole",
            chapter,
            about: "a pinhole camera: rays from the eye through pixel centres",
            draw: pinhole::draw,
        },
    ]
}
