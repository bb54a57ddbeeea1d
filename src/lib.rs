//! A ray tracing book you can run.
//!
//! The scene is a `bevy_ecs` world of plain components; a plan decides from them which stages exist; the stages are
//! systems that fill the columns of small tiles, one space after another, until light lands on the film.
//! The modules stand in that order, and each names only those above it:
//!
//! 1. [`scene`]: what an author writes.
//! 2. [`plan`]: which stages the scene needs, and why.
//! 3. [`extract`]: entities → tables.
//! 4. [`sample`]: random numbers.
//! 5. [`rays`]: raster → NDC → screen → camera → world.
//! 6. [`intersect`]: rays → nearest surface.
//! 7. [`shade`]: surface → light.
//! 8. [`follow`]: light goes on, leg after leg.
//! 9. [`film`]: light → pixels → files.
//! 10. [`render`]: the loop over tiles.
//! 11. [`look`]: trace, view, statistics.
//! 12. [`naive`]: the methods that break, for the book, its figures and the extremes.
//! 13. [`figure`]: drawings of a scene and of what the stages wrote for it.
//! 14. [`review`]: what a picture was made of, as text to compare with.
//! 15. [`measure`]: exact arithmetic, oracles, extremes.
//! 16. [`report`]: error against run time.
//! 17. [`exercise`]: what a reader writes, beside the kit's own.
//! 18. [`command`]: the command line.

pub mod scene;

pub mod plan;

pub mod extract;

pub mod sample;

pub mod rays;

pub mod intersect;

pub mod shade;

pub mod follow;

pub mod film;

pub mod render;

pub mod look;

pub mod naive;

pub mod figure;

pub mod review;

pub mod measure;

pub mod report;

pub mod exercise;

pub mod command;

mod attempt;
mod chapter;
mod error;

pub use attempt::{Attempt, StageWords};
pub use chapter::{Asked, AskedSampling, Chapter, Size};
pub use error::{Error, Result};

/// What a chapter's `main` calls: reads the command line, renders the chapter or looks inside it.
///
/// A failure is printed in one sentence and ends the program: with status 2 where the command line makes no sense, with
/// 130 after Ctrl-C, and else with 1.
///
/// Errors: none that comes back.
pub fn run(chapter: Chapter) -> Result {
    command::stop_on_interrupt();
    match command::run_example(&chapter) {
        0 => Ok(()),
        status => std::process::exit(i32::from(status)),
    }
}
