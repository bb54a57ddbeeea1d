//! What a reader keeps: the picture, the text, and the view in the text.

use super::super::develop::png_of;
use super::super::modes::MODES;
use super::super::order::Kind;
use super::Viewer;
use crate::answer::Answer;
use pinhole::film::exr_bytes;
use pinhole::scene::SceneFile;
use std::path::Path;

impl Viewer {
    pub(super) fn save(&self) -> Result<String, String> {
        self.choice.scene.save().map(|file| file.display().to_string())
    }

    /// Puts the camera into the scene's text as the reader has moved it.
    pub(super) fn put_view(&mut self) -> Result<(), String> {
        let Some(orbit) = self.orbit else { return Ok(()) };
        let text = self.choice.scene.text();
        let file = SceneFile::parse(Path::new("scene.ron"), text).map_err(|problem| problem.to_string())?;
        let moved = file.with_view(&orbit.look_at(), orbit.view_height())?;
        self.edit(moved.text().to_owned())
    }

    /// The picture as a file.
    pub(super) fn picture(&self, kind: Kind) -> Answer {
        // A PNG is what is seen; an EXR is what was rendered, with its layers.
        let levels = if kind == Kind::Png { MODES[self.choice.mode].denoised } else { 0 };
        let Some(picture) = self.source.picture(levels) else {
            return Answer::refused("there is no picture yet".into());
        };
        let (media, ending, bytes) = match kind {
            Kind::Png => ("image/png", "png", png_of(&self.developed(&picture))),
            Kind::Exr => ("image/x-exr", "exr", exr_bytes(picture.film, &self.source.attributes())),
        };
        let stem: String =
            self.choice.scene.stem().chars().filter(|c| c.is_ascii_alphanumeric() || "-_".contains(*c)).collect();
        let file = Some(format!("{stem}.{ending}"));
        bytes.map_or_else(
            |error| Answer::refused(error.to_string()),
            |bytes| Answer { file, ..Answer::of(media, bytes) },
        )
    }
}
