//! The same camera in the words of other programs and books.
//!
//! Reads: the camera of a scene.
//! Writes: what a reader types elsewhere, and scenes as they look where a word of theirs was misread.
//! Space: each program's own world and camera axes; between theirs and ours lie swaps and signs only, so nothing is
//! rounded there.

mod lines;
mod mistake;
mod placed;
mod program;
mod round_trip;

pub use lines::{back, lines};
pub use mistake::Mistake;
pub use placed::PlacedCamera;
pub use program::{Described, Opening, Program, pinhole_from_theirs, theirs_from_pinhole};
pub use round_trip::{RoundTrip, round_trip};
