//! The figures of chapter 27, drawn from its scene.

use pinhole_lab::figure::{Figure, compared, connection};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "27_sides",
            chapter,
            about: "caustics by rays from the camera alone, and from the light too, once with a mistake",
            draw: compared::draw_sides,
        },
        Figure {
            name: "27_connection",
            chapter,
            about: "a path from the lamp, connected to the camera, and a path from the camera through the same pixel",
            draw: connection::draw,
        },
        Figure {
            name: "27_photons",
            chapter,
            about: "the ground of a pool by paths from the camera, by light paths that are connected to it, and by photons",
            draw: compared::draw_photons,
        },
    ]
}
