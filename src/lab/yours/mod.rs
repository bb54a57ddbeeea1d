//! The reader's own program: how the book's first page grows, chapter by chapter, and what it is compared with.
//!
//! Reads: the steps that stand in the chapters' folders, and a picture that a reader's program wrote. Writes: the
//! program after each step, pinhole's picture of the same scene, and whether the two are the same within noise.

mod comparison;
mod known;
mod located;
mod program;
mod scene;

pub use comparison::{Comparison, Expected, Mistake, Program};
pub use known::{Compiled, Picture, picture_in, picture_of_program};
pub use located::Place;
pub use program::{Step, program_after, program_of, steps};
pub use scene::{Variant, film_after, picture_of, scene_after, variants};
