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

#[cfg(not(feature = "unstable"))]
mod convention;
#[cfg(feature = "unstable")]
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

pub use trace::{Recorded, Trace, trace};

unstable! {
    use mistake::{MISTAKES, Mistake};
    use pilot::{Pilot, pilot};
    use preflight::{Foretold, Preflight, foretell, looks_black, preflight, unseen};
    use slow::{Effort, slow};
    use stats::{RenderStats, StageStats};
    use trace::trace_sample;
    use view::{ViewComponent, ViewTable, paths, view_stage};
}
