//! Looking inside: the same columns that the stages write, printed, painted and counted.
//!
//! Reads: any column, through the registry ([`ColumnKind`](crate::plan::ColumnKind)); the camera, for [`convention`].
//! Writes: text, and for a view the picture; it changes no value of the render.
//!
//! ```
//! use pinhole::prelude::*;
//!
//! let mut scene = World::new();
//! scene.spawn((PerspectiveCamera::default(), Resolution { width: 9, height: 9 }));
//! scene.spawn((Name::new("moon"), Sphere::default(), Placement::at(0.0, 0.0, -5.0), Matte::default()));
//! let chapter = Chapter::new("moon", "a sphere", |_| ()).offer(pinhole::stages::all());
//! scene.spawn(PointLight::default());
//! // What every stage wrote for the pixel in the middle.
//! let trace = pinhole::look::trace(&Census::of(&scene), &chapter.stages(), TracePixel { x: 4, y: 4 })?;
//! assert!(trace.to_string().contains("along the ray"));
//! # Ok::<(), pinhole::Error>(())
//! ```

#[doc(hidden)]
pub mod convention;

mod emitters;
mod inside;
mod media;
mod mistake;
mod pilot;
mod preflight;
mod radians;
mod slow;
mod stats;
mod trace;
mod view;

#[doc(hidden)]
pub use mistake::{MISTAKES, Mistake};
#[doc(hidden)]
pub use pilot::{Pilot, pilot};
#[doc(hidden)]
pub use preflight::{Foretold, Preflight, foretell, looks_black, preflight, unseen};
#[doc(hidden)]
pub use slow::{Effort, slow};
#[doc(hidden)]
pub use stats::{RenderStats, StageStats};
#[doc(hidden)]
pub use trace::{Recorded, trace_sample};
pub use trace::{Trace, trace};
#[doc(hidden)]
pub use view::{ViewComponent, ViewTable, paths, view_stage};
