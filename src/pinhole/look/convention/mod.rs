//! The same camera in the conventions of other programs and books.
//!
//! Reads: the camera of a scene.
//! Writes: what to type in another program, and scenes as they look when one of its conventions is misread.
//! Space: each program's own world and camera axes; they differ from pinhole's by permutations and signs only, so
//! nothing is rounded.

mod lens_lines;
mod lines;
mod mistake;
mod placed;
mod program;
mod round_trip;

pub use lens_lines::lines_with_lens;
pub use lines::{back, lines};
pub use mistake::Mistake;
pub use placed::PlacedCamera;
pub use program::{Described, Opening, Program, pinhole_from_theirs, theirs_from_pinhole};
pub use round_trip::{RoundTrip, round_trip};
