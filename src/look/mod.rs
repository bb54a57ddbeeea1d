//! Looking inside: the same columns that the stages write, printed, painted and counted.
//!
//! Reads: any column, through the registry ([`ColumnKind`](crate::plan::ColumnKind)); the camera, for [`convention`].
//! Writes: text, and for a view the picture; no number of the render changes.

pub mod convention;

mod preflight;
mod stats;
mod trace;
mod view;

pub use preflight::preflight;
pub use stats::{RenderStats, StageStats};
pub use trace::{Recorded, Trace, trace, trace_sample};
pub use view::{ViewTable, paths, view_stage};
