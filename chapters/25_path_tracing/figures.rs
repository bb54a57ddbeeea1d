//! The figures of chapter 25, drawn from its scene.

use pinhole_lab::figure::{Figure, cloud, compared, vertices};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "25_path_lengths",
            chapter,
            about: "one scene by ray casting, and by paths of two, three and many segments",
            draw: compared::draw_segments,
        },
        Figure {
            name: "25_vertices",
            chapter,
            about: "a path through the room in section, with its cosines, its throughput, and its shadow rays",
            draw: vertices::draw,
        },
        Figure {
            name: "25_broken",
            chapter,
            about: "one scene by paths with a factor too few or too many, and encoded twice",
            draw: compared::draw_paths,
        },
        Figure {
            name: "25_fog",
            chapter,
            about: "a spotlight and a ball without fog, in fog, and of glass in fog",
            draw: compared::draw_fog,
        },
        Figure {
            name: "25_cloud",
            chapter,
            about: "a box of fog in sunlight, and the same with the density of a cloud",
            draw: cloud::draw,
        },
    ]
}
