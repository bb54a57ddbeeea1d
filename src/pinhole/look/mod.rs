//! Looking inside: the same columns that the stages write, printed, painted and counted.
//!
//! Reads: any column, through the registry ([`ColumnKind`](crate::plan::ColumnKind)); the camera, for [`convention`].
//! Writes: text, and for a view the picture; it changes no value of the render.

pub mod convention;

mod inside;
mod mistake;
mod pilot;
mod preflight;
mod slow;
mod stats;
mod trace;
mod unseen;
mod view;

pub use mistake::{MISTAKES, Mistake};
pub use pilot::{Pilot, pilot};
pub use preflight::{Preflight, preflight};
pub use slow::{Effort, slow};
pub use stats::{RenderStats, StageStats};
pub use trace::{Recorded, Trace, trace, trace_sample};
pub use unseen::unseen;
pub use view::{ViewTable, paths, view_stage};
