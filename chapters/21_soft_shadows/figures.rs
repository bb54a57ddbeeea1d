//! The figures of chapter 21, drawn from its scene.

use pinhole_lab::figure::{Figure, compared, penumbra, solid_angle};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "21_penumbra",
            chapter,
            about: "a light of some width, an edge below it, and where the floor sees none, a part and all of the light",
            draw: penumbra::draw,
        },
        Figure {
            name: "21_solid_angle",
            chapter,
            about: "a patch of a light, its solid angle on the unit hemisphere, and that projected onto the disk",
            draw: solid_angle::draw,
        },
        Figure {
            name: "21_jacobian",
            chapter,
            about: "area lights by the right pdf, without its cosine, and without its distance too",
            draw: compared::draw_jacobian,
        },
    ]
}
