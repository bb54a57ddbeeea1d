//! The loop over tiles: one world per worker, or one world for all tiles.
//!
//! Reads: a scene, the stages on offer, and how to execute them.
//! Writes: the [`Film`](crate::film::Film), and which stages ran and how long they took.
//! Of the other modules only `bvh` uses `rayon`, to build hierarchies; no stage knows of threads.
//!
//! ```
//! use pinhole::prelude::*;
//! use pinhole::render::RenderInProgress;
//!
//! let mut scene = World::new();
//! let sampling = Sampling { samples: 16, ..Sampling::default() };
//! scene.spawn((PerspectiveCamera::default(), Resolution { width: 8, height: 8 }, sampling));
//! scene.spawn(Gradient::default());
//! let chapter = Chapter::new("sky", "a gradient", |_| ()).offer(pinhole::stages::all());
//! // A render can be looked at after any step, and brought on.
//! let census = Census::of(&scene);
//! let mut render = RenderInProgress::begin(&census, &chapter.stages(), &Execution::default())?;
//! render.advance(1, &())?;
//! let early = render.film.mean(4, 4);
//! render.advance(render.steps(), &())?;
//! assert!((render.film.mean(4, 4)[2] - early[2]).abs() < 0.2);
//! # Ok::<(), pinhole::Error>(())
//! ```

mod adaptive;
mod clock;
mod execution;
mod in_progress;
mod inspect;
mod key;
mod light_pass;
mod memory;
mod moments;
mod parts;
mod passes;
mod render_world;
mod steps;

pub use clock::Lap;
pub use execution::{Execution, Rendered, Watch, render};
pub use in_progress::RenderInProgress;
pub use inspect::{Inspection, inspect};

unstable! {
    use adaptive::{Achieved, achieved, error_of, planned_samples, samples_for};
    use clock::StageClock;
    use execution::Worlds;
    use inspect::{ProbeRun, first_bounce_only, inspect_pixel, inspect_stages, probe_tiles, usual_tile_side};
    use light_pass::probe_light_paths;
    use memory::{check_film_fits, film_bytes_per_pixel, peak_memory};
    use moments::{SceneAt, first_sample_of};
    use passes::{Limits, Outcome, render_in_passes};
    use render_world::{Hook, RenderWorld, prepare};
    use steps::{LATTICES, Run, WHOLE, runs, samples_after, steps_of};
}
