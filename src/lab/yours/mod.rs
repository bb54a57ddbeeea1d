//! The reader's own program: how the book's first page grows, chapter by chapter, and what it is compared with.
//!
//! Reads: the steps that stand in the chapters' folders, and a picture that a reader's program wrote. Writes: the
//! program after each step, pinhole's picture of the same scene, and whether the two are the same within noise.

mod comparison;
mod program;
mod scene;

pub use comparison::{Comparison, compare_picture};
pub use program::{Step, program_after, steps};
pub use scene::{Variant, picture_of, scene_after, variants};
