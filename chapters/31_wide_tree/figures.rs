//! The figures of chapter 31, drawn from its scene and from what was measured.

use pinhole_lab::figure::{Figure, curves, wide_tree};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "31_children",
            chapter,
            about: "the boxes of the root's eight children, and of the children of one of them",
            draw: wide_tree::draw_children,
        },
        Figure {
            name: "31_layout",
            chapter,
            about: "where the numbers of a node lie in memory",
            draw: wide_tree::draw_layout,
        },
        Figure {
            name: "31_signs",
            chapter,
            about: "packets whose rays have one sign, and packets that only take it for granted",
            draw: wide_tree::draw_signs,
        },
        Figure {
            name: "31_triangles",
            chapter,
            about: "the time of a ray over the number of triangles",
            draw: curves::draw_triangles,
        },
        Figure {
            name: "31_spheres",
            chapter,
            about: "the time of a ray over the number of spheres",
            draw: curves::draw_spheres,
        },
    ]
}
