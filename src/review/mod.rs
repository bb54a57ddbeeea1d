//! Snapshots: what a chapter's picture was made of, as text and pixels that a later run is compared with.
//!
//! Reads: a scene and the stages on offer, run by the kit's own renderer; what an earlier run left.
//! Writes: text, the bytes of a PNG, and where two runs part; nothing to disk.
//!
//! Three witnesses, from the one that says *what* to the one that says *that*: [`probes`] are a few pixels' rays in
//! numbers, [`digests`] a short word for every stage and block of pixels, [`picture`] the image itself.

mod difference;
mod digest;
mod picture;
mod probes;

pub use difference::{Difference, Place, first_difference};
pub use digest::{BLOCK_SIDE, digests};
pub use picture::{PictureDifference, compare_pictures, picture};
pub use probes::{ChangedRow, Probe, changed_rows, probe_pixels, probes};
