//! The loop over tiles: one world per worker, or one world for all tiles.
//!
//! Reads: a scene, the stages on offer, and how to execute them.
//! Writes: the [`Film`](crate::film::Film), and which stages ran and how long they took.
//! No other module of the renderer uses `rayon`; no stage knows of threads.

mod adaptive;
mod clock;
mod execution;
mod in_progress;
mod inspect;
mod key;
mod light_pass;
mod memory;
mod passes;
mod render_world;
mod rendered;
mod steps;
mod tile_side;
mod whole;
mod workers;

pub use adaptive::{Achieved, achieved, planned_samples, samples_for};
pub use clock::{Lap, StageClock};
pub use execution::{Execution, Watch, Worlds};
pub use in_progress::RenderInProgress;
pub use inspect::{
    Inspection, first_bounce_only, inspect, inspect_pixel, inspect_stages, probe_tiles, usual_tile_side,
};
pub use key::film_key;
pub use memory::{check_film_fits, film_bytes_a_pixel, peak_memory};
pub use passes::{Limits, Outcome, render_in_passes};
pub use render_world::{Hook, RenderWorld, prepare};
pub use rendered::Rendered;
pub use steps::{LATTICES, Run, WHOLE, runs, samples_after, steps_of};
pub use whole::render;
