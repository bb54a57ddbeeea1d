use super::source::{FrameSource, Shot, was_stopped};
use bevy_ecs::prelude::World;
use pinhole::film::png_bytes;
use pinhole::plan::Stage;
use pinhole::render::Watch;
use std::time::Duration;

/// A figure whose values are moved: one render at a time, whose workers stay from frame to frame.
#[derive(Default)]
pub struct LiveFigure {
    source: FrameSource,
    shown: Option<(World, Vec<Stage>)>,
    changed: bool,
}

impl LiveFigure {
    /// Shows another scene from the next frame on; its samples begin anew.
    pub fn show(&mut self, scene: World, offer: Vec<Stage>) {
        (self.shown, self.changed) = (Some((scene, offer)), true);
    }

    /// The picture as PNG once every pixel has this many samples or all that the camera asks for; none where the observer
    /// stopped it.
    ///
    /// Errors: an invalid scene, or no plan.
    pub fn png(&mut self, samples: u32, watch: &dyn Watch) -> pinhole::Result<Option<Vec<u8>>> {
        let Some((scene, offer)) = &self.shown else { return Ok(None) };
        loop {
            let shot =
                Shot { scene, offer, changed: self.changed, patience: Duration::ZERO, gathers: false, region: None };
            match self.source.film(&shot, watch) {
                Ok(progress) if progress.is_done() || progress.samples[0] >= samples => break,
                Ok(_) => self.changed = false,
                // A frame that was begun is gone on with, unless the scene changes again.
                Err(error) if was_stopped(&error) => {
                    self.changed = false;
                    return Ok(None);
                }
                Err(error) => return Err(error),
            }
        }
        self.changed = false;
        Ok(self.source.picture(0).map(|picture| png_bytes(picture.film, picture.curve)).transpose()?)
    }
}
