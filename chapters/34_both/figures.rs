//! The figures of chapter 34, drawn from its scene and from what was measured.

use pinhole_lab::figure::{Figure, both, curves, told};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "34_alone",
            chapter,
            about: "the scene by projection alone, with rays for more and more, and by rays alone",
            draw: both::draw_alone,
        },
        Figure {
            name: "34_difference",
            chapter,
            about: "the pixels that rays change, and those in which the two classes differ",
            draw: both::draw_difference,
        },
        Figure {
            name: "34_mirrored",
            chapter,
            about: "where the image would have what the mirror shows",
            draw: both::draw_mirrored,
        },
        Figure {
            name: "34_tessellated",
            chapter,
            about: "a sphere of few triangles and of many",
            draw: told::draw_tessellated,
        },
        Figure {
            name: "34_rectangle",
            chapter,
            about: "the part of the image in which a sphere must be looked for",
            draw: told::draw_rectangle,
        },
        Figure {
            name: "34_refused",
            chapter,
            about: "cameras that projection refuses, by rays, and the sentence that refuses them",
            draw: told::draw_refused,
        },
        Figure {
            name: "34_triangles",
            chapter,
            about: "the time of a picture of the first hits over the number of triangles",
            draw: curves::draw_first_hits_by_triangles,
        },
        Figure {
            name: "34_pixels",
            chapter,
            about: "the time of a picture of the first hits over the number of pixels",
            draw: curves::draw_first_hits_by_pixels,
        },
        Figure {
            name: "34_lights",
            chapter,
            about: "the time of a lit picture over the number of lights",
            draw: curves::draw_by_lights,
        },
    ]
}
