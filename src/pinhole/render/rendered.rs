use super::clock::Lap;
use crate::Result;
use crate::film::{Curve, Film, write_exr, write_png};
use crate::plan::Plan;
use std::path::Path;
use std::time::Duration;

/// The result of a render.
pub struct Rendered {
    /// The stages that ran, and those that did not.
    pub plan: Plan,
    /// The accumulated radiance.
    pub film: Film,
    /// One lap per kept stage, summed over workers; empty where no statistics were requested.
    pub laps: Vec<Lap>,
    /// The number of workers.
    pub threads: usize,
    /// Elapsed time from the first tile to the last.
    pub time: Duration,
    /// Memory of the tables, in bytes.
    pub table_bytes: usize,
}

impl Rendered {
    /// Writes the picture: a PNG by the sRGB curve for a name that ends in `.png`, linear OpenEXR for every other.
    ///
    /// Errors: the path and what the system said; no part of a file is left behind.
    ///
    /// ```
    /// use pinhole::prelude::*;
    ///
    /// let mut scene = World::new();
    /// scene.spawn((PerspectiveCamera::default(), Resolution { width: 8, height: 8 }));
    /// scene.spawn(Background { colour: Rgb::grey(0.5) });
    /// let folder = tempfile::tempdir()?;
    /// let file = folder.path().join("grey.png");
    /// render_scene(&scene)?.save(&file)?;
    /// assert!(file.exists());
    /// # Ok::<(), pinhole::Error>(())
    /// ```
    pub fn save(&self, path: &Path) -> Result {
        let is_png = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"));
        if is_png { write_png(&self.film, self.curve(), path) } else { write_exr(&self.film, path) }
    }

    /// The curve that turns the film into a picture: sRGB for radiance, the identity for a view's values.
    pub fn curve(&self) -> Curve {
        if self.plan.view.is_some() { Curve::Straight } else { Curve::Srgb }
    }
}
