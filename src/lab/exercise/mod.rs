//! What a chapter asks its reader to write, checked against what pinhole computes, and rendered in its place.
//!
//! Reads: a chapter's question and a function; the reader's own is compiled from the chapter's `exercise.rs`.
//! Writes: how it did, the first input at which the two differ, and how often it was tried, to a file of progress; or
//! the chapter with the function in one of its stages.
//! The reader's code is checked on a thread of its own: it may panic or run for ever without taking the program along.
//! Nothing here knows a chapter: each one's question lies in its own folder.

mod answers;
pub mod apart;
mod argument;
mod ask;
mod compare;
mod condition;
mod letters;
mod looks_like;
mod mine;
mod mistake;
mod panels;
mod panics;
mod picture_pair;
mod progress;
mod question;
mod relation;
mod report;
mod seen;
mod shown;
mod turn;
mod unused;

pub use argument::{Argument, Misread};
pub use ask::{Ask, RowPlace, RowPlaces};
pub use compare::{Mismatch, Outcome, Report};
pub use mine::{Mine, Setting, StandIn, Whose, at_most, on_camera};
pub use mistake::{Mistakes, Part};
pub use panels::sheet;
pub use panics::end_at_panics;
pub use picture_pair::PicturePair;
pub use progress::{Progress, Tries};
pub use question::{Probe, Question, extremes, probes};
pub use seen::Seen;
pub use shown::Shown;
pub use turn::{Turn, list_exercises, take_turn, turn, what_is_left};

use bevy_ecs::prelude::*;
use compare::compare;
use mine::{Render, edited};
use pinhole::Chapter;
use std::sync::Arc;
use std::time::Duration;

/// How long one answer may take before the reader's function counts as running for ever.
pub const PATIENCE: Duration = Duration::from_secs(3);

/// A function that a chapter asks its reader to write, as somebody has written it.
pub struct Exercise {
    /// The function's name.
    pub function: &'static str,
    check: Box<dyn Fn(Duration) -> Report + Send + Sync>,
    /// How pinhole's function and the reader's take their place; or why no picture shows them.
    mine: Result<[Box<Render>; 2], &'static str>,
    scenes: Vec<(&'static str, fn(&mut World))>,
}

/// The most pixels across in a picture of a sampled scene, and samples of each, that is there soon after an edit.
const SOON: (u32, u32) = (320, 16);

impl Exercise {
    /// An exercise whose function renders in the place that `mine` gives it.
    pub fn rendered<I, A>(
        function: &'static str,
        question: fn() -> Question<I, A>,
        written: impl Fn(&I) -> A + Send + Sync + 'static,
        mine: fn(Ask<I, A>, &Setting<'_>) -> StandIn,
    ) -> Self
    where
        I: Clone + Send + Sync + 'static,
        A: Shown + Send + 'static,
    {
        let written: Arc<dyn Fn(&I) -> A + Send + Sync> = Arc::new(written);
        let right: Arc<dyn Fn(&I) -> A + Send + Sync> = Arc::new(question().right);
        let renders = [right, Arc::clone(&written)].map(|function_of| -> Box<Render> {
            Box::new(move |setting| {
                let ask = Ask::new(function, question, Arc::clone(&function_of));
                let complaint = ask.complaint();
                (mine(ask, setting), complaint)
            })
        });
        Self { mine: Ok(renders), ..Self::unseen(function, question, move |input| written(input), "") }
    }

    /// An exercise whose function no picture shows, and the sentence that says why.
    pub fn unseen<I, A>(
        function: &'static str,
        question: fn() -> Question<I, A>,
        written: impl Fn(&I) -> A + Send + Sync + 'static,
        why: &'static str,
    ) -> Self
    where
        I: Clone + Send + Sync + 'static,
        A: Shown + Send + 'static,
    {
        let written = Arc::new(written);
        let check = move |patience| {
            let written = Arc::clone(&written);
            compare(function, question(), move |input: &I| written(input), patience)
        };
        Self { function, check: Box::new(check), mine: Err(why), scenes: vec![("", |_| ())] }
    }

    /// The same, shown in the chapter's scene as this changes it, so that mistakes can be seen.
    #[must_use]
    pub fn shown_in(mut self, scene: fn(&mut World)) -> Self {
        self.scenes[0].1 = scene;
        self
    }

    /// The same, shown in a further scene as well, in which those mistakes are seen that the chapter's own leaves in the
    /// dark.
    #[must_use]
    pub fn and_in(mut self, what: &'static str, scene: fn(&mut World)) -> Self {
        self.scenes.push((what, scene));
        self
    }

    /// What is special about the scenes in which the function is shown, the chapter's own first.
    pub fn scenes(&self) -> impl Iterator<Item = &'static str> {
        self.scenes.iter().map(|(what, _)| *what)
    }

    /// The chapter with one of these scenes.
    pub fn pictured(&self, chapter: &Chapter, number: usize) -> Chapter {
        let scene = self.scenes.get(number).map_or((|_: &mut World| ()) as fn(&mut World), |(_, scene)| *scene);
        edited(chapter, move |world| {
            at_most(world, SOON);
            scene(world);
        })
    }

    /// Asks the function all inputs of its exercise and says how it did.
    pub fn check(&self, patience: Duration) -> Report {
        (self.check)(patience)
    }

    /// Whether a picture shows the function.
    pub fn renders(&self) -> bool {
        self.mine.is_ok()
    }
}
