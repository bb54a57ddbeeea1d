//! What of a film is shown, and how.

use super::super::develop::{Developed, Picture};
use super::super::look::{Compared, Look, PageSize};
use super::super::modes::MODES;
use super::super::reading::Reading;
use super::super::reference::Reference;
use super::super::shown::{FrameHead, Shown};
use super::super::traced;
use super::{Choice, Viewer};
use serde::Serialize;
use std::time::Instant;

/// The most pixels that are pinned.
const PINS: usize = 8;

/// A pixel that is pinned.
#[derive(Serialize)]
pub(super) struct Pinned {
    /// The name of the shape that its first sample hits.
    entity: Option<String>,
    reading: Option<Reading>,
}

impl Viewer {
    /// Whether the last frame that was shown is of all changes so far.
    pub(super) fn is_shown(&self) -> bool {
        self.begun.is_some() && self.told.size == self.begun && self.told.change == self.change
    }

    fn shown_picture(&self) -> Option<Picture<'_>> {
        self.source.picture(MODES[self.choice.mode].denoised)
    }

    /// The picture as the reader wants to see it.
    pub(super) fn developed(&self, picture: &Picture<'_>) -> Developed {
        picture.develop(&self.choice.painted, &self.look, self.reference.as_ref())
    }

    /// Sends the film to the page; with the time at which its frame began, where it is a new one.
    pub(super) fn present(&mut self, began: Option<Instant>) {
        let begun = Instant::now();
        let Some(picture) = self.shown_picture() else { return };
        let Developed { pixels, size, scale, rel_mse } = self.developed(&picture);
        let read = |at: &[f64; 2]| Some(self.read(&picture, *at));
        let readings = self.pins.iter().map(read);
        let readings = std::iter::once(self.pointer.as_ref().and_then(read)).chain(readings).collect();
        let milliseconds = began.map_or(self.told.milliseconds, |began| began.elapsed().as_secs_f64() * 1e3);
        let head = FrameHead {
            frame: self.shown.borrow().frame + 1,
            change: self.told.change,
            size,
            samples: self.told.samples,
            milliseconds,
            stages: self.told.stages.clone(),
            scale,
            rel_mse,
            pixels: readings,
            error: None,
        };
        let shown = Shown::new(&head, &pixels);
        (self.told.milliseconds, self.presenting) = (milliseconds, begun.elapsed());
        self.shown.send_replace(shown);
    }

    /// Shows the same film otherwise.
    fn present_again(&mut self) {
        let shown = self.is_shown();
        self.change += 1;
        if shown {
            self.told.change = self.change;
            self.present(None);
        }
    }

    pub(super) fn take_look(&mut self, look: Look) -> Result<(), String> {
        if look.compare != Compared::Render && self.reference.is_none() {
            return Err("there is no reference yet: keep the picture as one, or start with --reference FILE".into());
        }
        if look != self.look {
            self.look = look;
            self.present_again();
        }
        Ok(())
    }

    /// Compares with this picture from now on.
    ///
    /// Errors: it has another size.
    pub(super) fn take_reference(&mut self, reference: Reference) -> Result<(), String> {
        let [width, height] = reference.size;
        let full = [self.full.width, self.full.height];
        if reference.size != full {
            return Err(format!(
                "{} has {width} × {height} pixels and the picture {} × {}: only pictures of one size can be compared",
                reference.name, full[0], full[1]
            ));
        }
        self.reference = Some(reference);
        Ok(())
    }

    pub(super) fn keep_reference(&mut self, kept: bool) -> Result<(), String> {
        if kept {
            if self.choice.painted.column().is_some() {
                return Err("a column is painted: show the picture before it is kept as the reference".into());
            }
            if !self.is_shown() || self.begun != Some(self.full) {
                return Err("there is no whole picture yet that could be kept".into());
            }
            let Some(picture) = self.shown_picture() else { return Ok(()) };
            let mode = MODES[self.choice.mode].name;
            let samples = self.told.samples[0];
            let name = format!("{mode}, {samples} sample{}", if samples == 1 { "" } else { "s" });
            let (size, means) = ([self.full.width, self.full.height], picture.means());
            self.reference = Some(Reference { name, size, means });
        } else {
            (self.reference, self.look.compare) = (None, Compared::Render);
        }
        self.present_again();
        Ok(())
    }

    /// Renders as many pixels as the page has room for, or as many as before.
    pub(super) fn fill(&mut self, fills: Option<PageSize>, choice: Choice) -> Result<(), String> {
        let before = std::mem::replace(&mut self.fills, fills);
        let chosen = self.choose(choice);
        if chosen.is_err() {
            self.fills = before;
        }
        chosen
    }

    fn read(&self, picture: &Picture<'_>, at: [f64; 2]) -> Reading {
        Reading::of(picture, &self.choice.painted, self.reference.as_ref(), at)
    }

    /// What the film has of a pixel; none before it has anything of this picture.
    pub(super) fn reading(&self, at: [f64; 2]) -> Option<Reading> {
        let picture = self.source.picture(0).filter(|_| self.is_shown())?;
        Some(self.read(&picture, at))
    }

    pub(super) fn pin(&mut self, pins: Vec<[f64; 2]>) -> Result<Vec<Pinned>, String> {
        if pins.len() > PINS {
            return Err(format!("at most {PINS} pixels are pinned, not {}", pins.len()));
        }
        let mut pinned = Vec::new();
        for &at in &pins {
            let entity = self.trace(at).ok().and_then(|trace| traced::entity(&trace));
            pinned.push(Pinned { entity, reading: self.reading(at) });
        }
        self.pins = pins;
        Ok(pinned)
    }
}
