//! Figures: drawings of a chapter's scene and of what the stages wrote for it.
//!
//! Reads: a chapter's scene, the tables of `extract`, and the columns of a run at a small resolution.
//! Writes: SVG text.
//! Space: render space, up to [`Sketch`] and [`Section`], which make points of the drawing of it (x to the right, y
//! down, [`WIDTH`](pen::WIDTH) wide).
//! No figure holds a coordinate of its own: change a chapter's scene, and its figures change.
//! Beside them, the [images](DRAWN_IMAGES) that chapters read from files are drawn here.

mod acne;
mod aliasing;
mod broken_paths;
mod cameras;
mod caustics;
mod drawn_image;
mod field_of_view;
mod filters;
mod fresnel;
mod gallery;
mod grid;
mod hit;
mod integrators;
mod jacobian;
mod label;
mod lobes;
mod look_at;
mod ndc;
mod normals;
mod occluders;
mod offset;
mod orthographic;
mod patch;
mod path_mistakes;
mod pen;
mod picture;
mod pinhole;
mod pixel_ray;
mod props;
mod ray;
mod rings;
mod samples;
mod scenery;
mod screen;
mod section;
mod side;
mod sketch;
mod slabs;
mod subject;
mod svg;
#[cfg(test)]
mod trial;
mod two_classes;

pub use drawn_image::{DRAWN_IMAGES, DrawnImage};
pub use grid::{Grid, drawn_distance};
pub use label::{Label, Obstacles, Placed, crosses, overlap, place};
pub use patch::Patch;
pub use pen::{Fill, Pen};
pub use picture::Picture;
pub use pinhole::chosen_rays;
pub use pixel_ray::{Onward, PixelRay};
pub use scenery::{Scenery, Strand};
pub use section::Section;
pub use side::{Side, best_scenery};
pub use sketch::{Extent, Frame, Sketch};
pub use subject::{Ball, Lens, Planar, Subject};
pub use svg::{Drawing, Svg};

use ::pinhole::Chapter;
use ::pinhole::{Error, Result};

/// A figure that pinhole can draw.
#[derive(Clone, Copy)]
pub struct Figure {
    /// The word on the command line.
    pub name: &'static str,
    /// The chapter whose scene it shows.
    pub chapter: &'static str,
    /// What it shows, in a few words.
    pub about: &'static str,
    draw: fn(&Chapter, &Figure) -> Result<Drawing>,
}

/// All figures, in the order of the book.
pub fn figures() -> Vec<Figure> {
    let two_classes = "two ways to a picture: from the object to the pixel, and from the pixel to the light";
    vec![
        Figure { name: "two_classes", chapter: "05_pinhole", about: two_classes, draw: two_classes::draw },
        Figure { name: "02_ray", chapter: "02_ray", about: "a ray: a point, a unit vector, and t", draw: ray::draw },
        Figure { name: "03_hit", chapter: "03_hit", about: "where a ray hits a sphere", draw: hit::draw },
        Figure {
            name: "04_orthographic",
            chapter: "04_orthographic",
            about: "parallel rays from a rectangle of pixels",
            draw: orthographic::draw,
        },
        Figure {
            name: "05_pinhole",
            chapter: "05_pinhole",
            about: "a pinhole camera: rays from the eye through pixel centres",
            draw: pinhole::draw,
        },
        Figure {
            name: "06_ndc",
            chapter: "06_ndc",
            about: "one point of the image, in two resolutions",
            draw: ndc::draw,
        },
        Figure {
            name: "07_screen",
            chapter: "07_screen",
            about: "the screen of an oblong image beside that of a square one",
            draw: screen::draw,
        },
        Figure {
            name: "07_naive",
            chapter: "07_screen",
            about: "an aspect forgotten, a sign forgotten, a sign too many",
            draw: screen::draw_naive,
        },
        Figure {
            name: "08_field_of_view",
            chapter: "08_field_of_view",
            about: "the image plane at distance 1, from the side",
            draw: field_of_view::draw,
        },
        Figure {
            name: "08_angles",
            chapter: "08_field_of_view",
            about: "a narrow, a usual and a wide angle from one place",
            draw: gallery::draw_angles,
        },
        Figure {
            name: "08_window",
            chapter: "08_field_of_view",
            about: "a window that widens, with either angle kept",
            draw: gallery::draw_window,
        },
        Figure {
            name: "08_zoom",
            chapter: "08_field_of_view",
            about: "the nearest sphere in view kept at one size, by the angle and by the distance",
            draw: gallery::draw_zoom,
        },
        Figure {
            name: "08_naive",
            chapter: "08_field_of_view",
            about: "what becomes of the picture when the tangent is of another angle",
            draw: gallery::draw_naive,
        },
        Figure {
            name: "09_camera_to_world",
            chapter: "09_camera_to_world",
            about: "the camera's axes, made of eye, target and up",
            draw: look_at::draw,
        },
        Figure {
            name: "09_normals",
            chapter: "09_camera_to_world",
            about: "spheres scaled unevenly, lit by wrong normals and by right ones",
            draw: normals::draw,
        },
        Figure {
            name: "10_light_and_shadow",
            chapter: "10_light_and_shadow",
            about: "a hit, its error, and where its shadow ray starts",
            draw: offset::draw,
        },
        Figure {
            name: "10_acne",
            chapter: "10_light_and_shadow",
            about: "shadow rays that start where textbooks have them, in three sizes of one scene",
            draw: acne::draw,
        },
        Figure {
            name: "13_slabs",
            chapter: "13_shapes",
            about: "where a ray is inside each slab of a cuboid, and inside all three",
            draw: slabs::draw,
        },
        Figure {
            name: "16_aliasing",
            chapter: "16_textures",
            about: "textures at one point a pixel, over what a pixel covers, and at many points a pixel",
            draw: aliasing::draw,
        },
        Figure {
            name: "15_reflection",
            chapter: "15_reflection",
            about: "how much each reflection model sends which way",
            draw: lobes::draw,
        },
        Figure {
            name: "17_rings",
            chapter: "17_sampling",
            about: "rings that become finer than a pixel, through three ways of placing samples",
            draw: rings::draw,
        },
        Figure {
            name: "17_points",
            chapter: "17_sampling",
            about: "64 points of each sampler in one pixel",
            draw: samples::draw_points,
        },
        Figure {
            name: "17_filters",
            chapter: "17_sampling",
            about: "five filters, from the pixel's centre outward",
            draw: filters::draw,
        },
        Figure {
            name: "17_variance",
            chapter: "17_sampling",
            about: "the variance of a mean over the number of its samples",
            draw: samples::draw_variance,
        },
        Figure {
            name: "20_glass",
            chapter: "20_glass",
            about: "how much of the light glass mirrors at each angle, from outside and from inside",
            draw: fresnel::draw,
        },
        Figure {
            name: "21_jacobian",
            chapter: "21_soft_shadows",
            about: "area lights by the right pdf, without its cosine, and without its squared distance too",
            draw: jacobian::draw,
        },
        Figure {
            name: "23_focus",
            chapter: "23_depth_of_field",
            about: "a lens focused near, focused far, and closed to a pinhole",
            draw: cameras::draw_focus,
        },
        Figure {
            name: "23_openings",
            chapter: "23_depth_of_field",
            about: "a round opening filled evenly and unevenly, and one of three edges",
            draw: cameras::draw_openings,
        },
        Figure {
            name: "23_cameras",
            chapter: "23_depth_of_field",
            about: "one scene through a lens, through a fisheye and in all directions",
            draw: cameras::draw_cameras,
        },
        Figure {
            name: "24_frames",
            chapter: "24_motion_blur",
            about: "one motion as the mean of few moments, of more, and of times at random",
            draw: cameras::draw_frames,
        },
        Figure {
            name: "24_shutters",
            chapter: "24_motion_blur",
            about: "one motion, seen for a moment, for a while and for longer",
            draw: cameras::draw_shutters,
        },
        Figure {
            name: "22_distance",
            chapter: "22_ambient_occlusion",
            about: "how much of the sky points see, with what is near alone in the way, and with all",
            draw: integrators::draw_distance,
        },
        Figure {
            name: "25_path_lengths",
            chapter: "25_path_tracing",
            about: "one scene by ray casting, and by paths of two, three and many segments",
            draw: integrators::draw_segments,
        },
        Figure {
            name: "26_strategies",
            chapter: "26_choosing_samples",
            about: "area lights by BSDF sampling, by light sampling, and by multiple importance sampling",
            draw: integrators::draw_strategies,
        },
        Figure {
            name: "27_sides",
            chapter: "27_caustics",
            about: "caustics by rays from the camera alone, and from the lamp too, once with a mistake",
            draw: caustics::draw_sides,
        },
    ]
    .into_iter()
    .chain(path_mistakes::figures())
    .collect()
}

/// Draws the figure of this name.
///
/// Errors: there is no such figure, its chapter is not among these, or the chapter's scene lacks what it shows.
pub fn draw(chapters: &[Chapter], name: &str) -> Result<Drawing> {
    let figures = figures();
    let Some(figure) = figures.iter().find(|figure| figure.name == name) else {
        let likeness = |figure: &&Figure| (strsim::jaro_winkler(figure.name, name) * 1e6) as u64;
        let nearest = figures.iter().max_by_key(likeness).map_or("05_pinhole", |figure| figure.name);
        return Err(Error::Usage(format!(
            "there is no figure \"{name}\"; the nearest is {nearest}, and `figure` without a name lists all"
        )));
    };
    let chapter = chapters.iter().find(|chapter| chapter.name == figure.chapter);
    let missing = || Error::Usage(format!("the figure {name} shows the chapter {}, which is not here", figure.chapter));
    (figure.draw)(chapter.ok_or_else(missing)?, figure)
}

impl Figure {
    /// The words at a figure's foot: scene, resolution, what else a reader has to know, and the command.
    pub fn foot(&self, subject: &Subject, note: &str) -> String {
        self.stamp([subject.image.width, subject.image.height], note)
    }

    /// The same by the resolution alone.
    fn stamp(&self, [width, height]: [u32; 2], note: &str) -> String {
        let note = if note.is_empty() { String::new() } else { format!(" · {note}") };
        format!("scene {}, {width} × {height} pixels{note} · cargo run --release -- figure {}", self.chapter, self.name)
    }

    /// Why a chapter's scene does not suit the figure.
    fn unsuited(&self, what: &str) -> Error {
        Error::Usage(format!("the figure {} needs {what}, and the scene of {} has none", self.name, self.chapter))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_follow_their_scene() {
        for figure in figures() {
            let drawing = draw(&trial::chapters(), figure.name).expect(figure.name);
            assert!(drawing.text.contains(&format!("scene {}", figure.chapter)));
            assert!(drawing.labels.len() >= 3, "{}", figure.name);
        }
    }

    #[test]
    fn a_camera_of_the_other_kind_is_refused_in_a_sentence() {
        let mut chapters = trial::chapters();
        chapters[2].name = "05_pinhole";
        chapters.remove(3);
        let refused = draw(&chapters, "05_pinhole").err().expect("refused");
        let sentence = "the figure 05_pinhole needs a perspective camera, and the scene of 05_pinhole has none";
        assert_eq!(refused.to_string(), sentence);
    }
}
