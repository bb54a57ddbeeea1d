//! What there is to an exercise beside its check: the solution, and wrong answers that were recorded.

use pinhole_lab::exercise::Exercise;

/// Answers to a chapter's exercise.
pub struct Answers {
    /// Right for every input.
    pub solution: Exercise,
    /// The formula straight from the page, right for ordinary inputs, where there are extreme ones.
    pub textbook: Option<Exercise>,
    /// Wrong answers of as many kinds, with words of what must be said of each.
    pub wrong: [(Exercise, &'static str); 6],
}

include!(concat!(env!("OUT_DIR"), "/answers.rs"));
