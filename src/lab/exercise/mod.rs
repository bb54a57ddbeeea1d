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
mod looks_like;
mod mine;
mod mistake;
mod panics;
mod progress;
mod question;
mod relation;
mod report;
mod shown;
mod turn;

pub use argument::{Argument, Misread};
pub use ask::{Ask, RowPlace, RowPlaces};
pub use compare::{Mismatch, Outcome, Report};
pub use mine::{Mine, Setting, StandIn};
pub use mistake::{Mistakes, Part};
pub use panics::end_at_panics;
pub use progress::{Progress, Tries};
pub use question::{Probe, Question, extremes, probes};
pub use shown::Shown;
pub use turn::{Turn, list_exercises, take_turn, turn};

use compare::compare;
use mine::Render;
use std::sync::Arc;
use std::time::Duration;

/// How long one answer may take before the reader's function counts as running for ever.
pub const PATIENCE: Duration = Duration::from_secs(3);

/// A function that a chapter asks its reader to write, as somebody has written it.
pub struct Exercise {
    /// The function's name.
    pub function: &'static str,
    /// The most samples of a pixel, where the scene is sampled, with which its picture is there at once.
    pub samples: u32,
    check: Box<dyn Fn(Duration) -> Report + Send + Sync>,
    mine: Result<Box<Render>, &'static str>,
}

/// The samples with which most pictures show what a function does.
const SAMPLES: u32 = 4;

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
        let asked = Arc::clone(&written);
        let mine: Box<Render> = Box::new(move |setting| {
            let ask = Ask::new(function, question, Arc::clone(&asked));
            let complaint = ask.complaint();
            (mine(ask, setting), complaint)
        });
        Self { mine: Ok(mine), ..Self::unseen(function, question, move |input| written(input), "") }
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
        Self { function, samples: SAMPLES, check: Box::new(check), mine: Err(why) }
    }

    /// The same, shown with one sample of a pixel: for a function that a render asks so often that it takes long.
    #[must_use]
    pub fn asked_often(self) -> Self {
        Self { samples: 1, ..self }
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
