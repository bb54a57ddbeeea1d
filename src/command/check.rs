use super::find;
use crate::Result;
use crate::chapter::Chapter;
use crate::exercise::{list_exercises, take_turn};
use std::io::Write;
use std::path::Path;

/// Where it is remembered which exercises were tried and which are done.
const PROGRESS: &str = "out/check.json";

/// Checks the reader's function of one chapter, or lists those of all.
///
/// Errors: a wrong answer, in one sentence after the report; no such chapter, or none with an exercise.
pub fn check(chapters: &[Chapter], asked: Option<&str>, out: &mut dyn Write) -> Result {
    match asked {
        None => list_exercises(chapters, Path::new(PROGRESS), out),
        Some(asked) => take_turn(find::chapter(chapters, asked)?, Path::new(PROGRESS), out),
    }
}
