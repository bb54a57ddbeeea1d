//! Figures: drawings of a chapter's scene and of what the stages wrote for it.
//!
//! Reads: a chapter's scene, the tables of `extract`, and the columns of a run at a small resolution.
//! Writes: SVG text.
//! Space: render space, up to [`Sketch`] and [`Section`], which make points of the drawing of it (x to the right, y
//! down, [`WIDTH`](pen::WIDTH) wide).
//! No figure holds a coordinate of its own: change a chapter's scene, and its figures change.
//! Beside them, the [images](DRAWN_IMAGES) that chapters read from files are drawn here.

pub mod acne;
pub mod aliasing;
mod angle;
pub mod both;
pub mod boxes;
pub mod budget;
pub mod cameras;
pub mod cloud;
pub mod compared;
pub mod connection;
pub mod coverage;
pub mod curves;
pub mod denoising;
pub mod directions;
mod drawn_image;
pub mod field_of_view;
pub mod films;
pub mod filters;
pub mod fresnel;
pub mod gallery;
mod grid;
pub mod hit;
mod label;
pub mod lobes;
pub mod look_at;
pub mod ndc;
pub mod normals;
pub mod offset;
pub mod orthographic;
mod patch;
mod pen;
pub mod penumbra;
mod picture;
pub mod pinhole;
mod pixel_ray;
pub mod projection;
mod props;
pub mod ray;
pub mod real_time;
pub mod refraction;
pub mod rings;
pub mod samples;
mod scenery;
pub mod screen;
mod section;
pub mod series;
mod side;
mod sketch;
pub mod slabs;
pub mod solid_angle;
mod subject;
mod svg;
pub mod told;
pub mod tree;
#[cfg(test)]
mod trial;
pub mod two_classes;
pub mod two_strategies;
pub mod vertices;
pub mod wavelengths;
pub mod wide_tree;

pub use drawn_image::{DRAWN_IMAGES, DrawnImage};
pub use grid::{Grid, drawn_distance};
pub use label::{Label, Obstacles, Placed, crosses, overlap, place};
pub use patch::Patch;
pub use pen::{Fill, Pen};
pub use picture::{Picture, with_few_samples};
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

/// A figure of a chapter; each chapter lists its own in its folder.
#[derive(Clone, Copy)]
pub struct Figure {
    /// The word on the command line.
    pub name: &'static str,
    /// The chapter whose scene it shows.
    pub chapter: &'static str,
    /// What it shows, in a few words.
    pub about: &'static str,
    /// Draws it from the chapter.
    pub draw: fn(&Chapter, &Figure) -> Result<Drawing>,
}

/// Draws the figure of this name.
///
/// Errors: there is no such figure, its chapter is not among these, or the chapter's scene lacks what it shows.
pub fn draw(figures: &[Figure], chapters: &[Chapter], name: &str) -> Result<Drawing> {
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

    /// The same for a figure of what was measured and kept, with the machine that measured it.
    fn kept_stamp(&self, machine: &str) -> String {
        format!("scene {}, its curves.txt · {machine} · cargo run --release -- figure {}", self.chapter, self.name)
    }

    /// Why a chapter's scene does not suit the figure.
    fn unsuited(&self, what: &str) -> Error {
        Error::Usage(format!("the figure {} needs {what}, and the scene of {} has none", self.name, self.chapter))
    }
}
