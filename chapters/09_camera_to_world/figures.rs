//! The figures of chapter 09, drawn from its scene.

use pinhole_lab::figure::{Figure, look_at, normals};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "09_camera_to_world",
            chapter,
            about: "the camera's axes, made of eye, target and up",
            draw: look_at::draw,
        },
        Figure {
            name: "09_normals",
            chapter,
            about: "spheres scaled unevenly, lit by wrong normals and by right ones",
            draw: normals::draw,
        },
    ]
}
