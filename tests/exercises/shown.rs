//! Whether the picture that `render N --mine` writes shows a mistake.

use super::answers::Answers;
use pinhole::render::Execution;
use pinhole::{Chapter, Overrides};
use pinhole_lab::exercise::{Exercise, Outcome, PicturePair, Seen};
use std::time::Duration;

/// What comes of a mistake in a picture.
#[allow(dead_code, reason = "the bench keeps the pictures")]
pub enum Shown {
    /// Pictures, and what is seen in each.
    Pictures(Vec<(&'static str, PicturePair)>, Vec<Seen>),
    /// A sentence in place of the picture.
    Sentence(String),
}

impl Shown {
    /// What a reader gets who renders a chapter with this function.
    pub fn of(chapter: &Chapter, exercise: &Exercise, asked: &Overrides) -> Self {
        let late = exercise.check(Duration::from_secs(3));
        if let Outcome::Late(..) = late.outcome {
            return Self::Sentence(late.sentence().unwrap_or_default());
        }
        let (mut pairs, mut seen) = (Vec::new(), Vec::new());
        for (number, what) in exercise.scenes().enumerate() {
            match PicturePair::render(exercise, (chapter, number), asked, (&Execution::default(), &())) {
                Ok(pair) => {
                    seen.push(pair.seen());
                    pairs.push((what, pair));
                }
                Err(told) => return Self::Sentence(told.to_string()),
            }
        }
        Self::Pictures(pairs, seen)
    }

    /// Whether a person sees it.
    pub fn is_shown(&self) -> bool {
        match self {
            Self::Pictures(_, seen) => seen.iter().any(Seen::is_shown),
            Self::Sentence(_) => true,
        }
    }
}

/// The mistakes of a chapter with their names, and what each one's picture shows.
pub fn mistakes_of(chapter: &Chapter, answers: fn() -> Answers, asked: &Overrides) -> Vec<(&'static str, Shown)> {
    answers().wrong.iter().map(|(wrong, name)| (*name, Shown::of(chapter, wrong, asked))).collect()
}
