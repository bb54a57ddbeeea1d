//! Whether the picture that `render N --mine` writes shows a mistake.

use super::answers::Answers;
use pinhole::render::{Execution, Watch};
use pinhole::{Chapter, Overrides};
use pinhole_lab::exercise::{Exercise, Outcome, PicturePair, Seen};
use std::sync::OnceLock;
use std::time::Duration;

/// What comes of a mistake in a picture.
#[allow(dead_code, reason = "the bench keeps the pictures")]
pub enum Shown {
    /// Pictures, and what is seen in each.
    Pictures(Vec<(&'static str, PicturePair)>, Vec<Seen>),
    /// A sentence in place of the picture.
    Sentence(String),
}

/// How many of an exercise's scenes are rendered.
#[derive(Clone, Copy, PartialEq)]
pub enum Scenes {
    /// All, as a reader gets them.
    All,
    /// None after one that shows a difference.
    UntilShown,
}

/// Pinhole's pictures of an exercise's scenes, of which the same is asked each time.
#[derive(Default)]
pub struct Pinholes([OnceLock<Vec<Vec<[f32; 3]>>>; 4]);

impl Shown {
    /// What a reader gets who renders a chapter with this function.
    pub fn of(chapter: &Chapter, exercise: &Exercise, asked: &Overrides) -> Self {
        Self::beside(&Pinholes::default(), chapter, exercise, asked, Scenes::All)
    }

    /// The same beside pictures that are kept.
    fn beside(
        Pinholes(kept): &Pinholes,
        chapter: &Chapter,
        exercise: &Exercise,
        asked: &Overrides,
        scenes: Scenes,
    ) -> Self {
        let late = exercise.check(Duration::from_secs(3));
        if let Outcome::Late(..) = late.outcome {
            return Self::Sentence(late.sentence().unwrap_or_default());
        }
        let (mut pairs, mut seen) = (Vec::new(), Vec::new());
        assert!(exercise.scenes().count() <= kept.len(), "{}: there are more scenes", chapter.name);
        for ((number, what), kept) in exercise.scenes().enumerate().zip(kept) {
            let by = (&Execution::default(), &() as &dyn Watch);
            match PicturePair::render_beside(kept, exercise, (chapter, number), asked, by) {
                Ok(pair) => {
                    seen.push(pair.seen());
                    pairs.push((what, pair));
                    if scenes == Scenes::UntilShown && seen.iter().any(Seen::is_shown) {
                        break;
                    }
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

/// The mistakes of a chapter with their names, and what each one's picture shows: the first of these that shows it, or the
/// last.
pub fn mistakes_of(
    chapter: &Chapter,
    answers: fn() -> Answers,
    asked: &[Overrides],
    scenes: Scenes,
) -> Vec<(&'static str, Shown)> {
    let pinholes: Vec<Pinholes> = asked.iter().map(|_| Pinholes::default()).collect();
    let of = |wrong: &Exercise| {
        let mut shown = Shown::Pictures(Vec::new(), Vec::new());
        for (asked, pinholes) in asked.iter().zip(&pinholes) {
            shown = Shown::beside(pinholes, chapter, wrong, asked, scenes);
            if shown.is_shown() {
                break;
            }
        }
        shown
    };
    answers().wrong.iter().map(|(wrong, name)| (*name, of(wrong))).collect()
}
