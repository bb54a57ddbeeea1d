//! The figures of chapter 08, drawn from its scene.

use pinhole_lab::figure::{Figure, field_of_view, gallery};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "08_field_of_view",
            chapter,
            about: "the image plane at distance 1, from the side",
            draw: field_of_view::draw,
        },
        Figure {
            name: "08_angles",
            chapter,
            about: "a narrow, a usual and a wide angle from one place",
            draw: gallery::draw_angles,
        },
        Figure {
            name: "08_window",
            chapter,
            about: "a window that widens, with either angle kept",
            draw: gallery::draw_window,
        },
        Figure {
            name: "08_zoom",
            chapter,
            about: "the nearest sphere in view kept at one size, by the angle and by the distance",
            draw: gallery::draw_zoom,
        },
        Figure {
            name: "08_naive",
            chapter,
            about: "what becomes of the picture when the tangent is of another angle",
            draw: gallery::draw_naive,
        },
    ]
}
