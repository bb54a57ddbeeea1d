//! Snapshots: what a chapter's picture was made of, as text and pixels that a later run is compared with.
//!
//! Reads: a scene and the stages on offer, run by pinhole's own renderer; what an earlier run left.
//! Writes: text, the bytes of a PNG, where two runs part, a page that shows it; and, where a reader accepts or rejects
//! what waits, the files that insta would.
//!
//! Three witnesses, from the one that says *what* to the one that says *that*: [`probes`] are a few pixels' rays in
//! numbers, [`digests`] a short word for every stage and column, [`picture`] the image itself.

mod contrast;
mod difference;
mod digest;
pub mod mutation;
mod page;
mod pending;
mod picture;
mod probes;
mod snapshots;

pub use contrast::{NOT_FINITE, difference_png, full_white};
pub use difference::{Difference, Place, StageBlocks, first_difference, stage_blocks};
pub use digest::{BLOCK_SIDE, digests};
pub use page::{Compared, escape, page};
pub use pending::{Pending, pending};
pub use picture::{PictureDifference, averages_out, compare_pictures, picture, picture_contrast};
pub use probes::{ChangedRow, Probe, changed_rows, probe_pixels, probes};
pub use snapshots::{DEVELOP, Develop, SNAPSHOT_FILES, SNAPSHOT_SIZE, Snapshots, plan_text, snapshot_folder};
