//! How a plan is executed.

use super::clock::Lap;
use super::{Limits, RenderInProgress, render_in_passes};
use crate::extract::{adaptive_of, delta_light_rays, shape_entities};
use crate::film::{Curve, FileAttributes, Film, write_exr_with, write_png};
use crate::plan::{Census, ColumnKind, Plan, Stage};
use crate::rays::Tile;
use crate::shade::{LightPdfs, ShadowHits, ShadowRays};
use crate::{Error, Result};
use bevy_ecs::prelude::*;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::thread::available_parallelism;
use std::time::Duration;

/// How many worlds hold the tiles while the stages run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Worlds {
    /// One per worker, which processes one tile after another; memory does not grow with the size of the image.
    #[default]
    PerWorker,
    /// One for all tiles at once, so that every column can be read afterwards.
    One,
}

/// How to execute a plan; none of these settings changes a bit of the image.
#[derive(Clone, Debug)]
pub struct Execution {
    /// The number of workers; none for one per core.
    pub threads: Option<usize>,
    /// The greatest side of a tile, in pixels; a render uses smaller tiles where many lights or shapes would make the
    /// columns large or the stages slow.
    pub tile_side: u32,
    /// How many worlds hold the tiles.
    pub worlds: Worlds,
    /// The part of the image to render; none for all of it. Its pixels are the same as in the whole image.
    pub part: Option<Tile>,
}

impl Default for Execution {
    fn default() -> Self {
        Self { threads: None, tile_side: 32, worlds: Worlds::default(), part: None }
    }
}

/// An observer of a render: it is notified of progress, and may stop the render.
pub trait Watch: Sync {
    /// A tile is finished.
    fn tile_done(&self) {}
    /// This many pixel samples have been taken since the last call.
    fn traced(&self, _samples: u64) {}
    /// A pass begins; in total this many pixel samples are expected, and `done` of `of` samples per pixel are finished.
    fn expect(&self, _samples: u64, _done: u32, _of: u32) {}
    /// Whether to stop before the next sample of a tile.
    fn stopped(&self) -> bool {
        false
    }
    /// A flag that, once set, stops the render even between two bounces of a tile, so that a path without end stops
    /// too.
    fn stop_flag(&self) -> Option<Arc<AtomicBool>> {
        None
    }
}

/// No observer.
impl Watch for () {}

/// The number of workers to start: as many as requested, or one per core, but no more than there are tiles or batches
/// of light paths.
///
/// Starting a thousand workers for one tile would take longer than rendering it.
pub(super) fn workers(execution: &Execution, tiles: u64, batches: u64) -> usize {
    let max = usize::try_from(tiles.max(batches).max(1)).unwrap_or(usize::MAX);
    execution.threads.filter(|&threads| threads > 0).unwrap_or_else(by_default).min(max)
}

/// What `rayon` would choose by default, which must be known here so that it can be limited.
fn by_default() -> usize {
    let threads = std::env::var("RAYON_NUM_THREADS").ok().and_then(|number| number.parse().ok());
    threads.filter(|&number| number > 0).unwrap_or_else(|| available_parallelism().map_or(1, usize::from))
}

/// The greatest memory for the shadow rays of a worker's tile, in bytes, without the spare capacity of the lists.
const MAX_BYTES: f64 = (16_u32 << 20) as f64;
/// The greatest number of ray–shape tests in one stage of a tile, which take some tenths of a second; a render can be
/// stopped only between stages.
const MAX_TESTS: f64 = (1_u32 << 28) as f64;
/// With tiles of one pixel, the film would take more memory than the columns save.
const MIN: u32 = 2;

/// The side of a full tile, in pixels: at most this, and less where many lights or shapes would make its columns large
/// or its stages slow.
///
/// Every pixel sends a shadow ray to each of a few lights without an area, and those of a tile are in memory at once.
/// No bit of the image depends on the side.
pub(super) fn tile_side(scene: &Census<'_>, plan: &Plan, max: u32) -> u32 {
    let of_light =
        |column: &&ColumnKind| column.is::<ShadowRays>() || column.is::<LightPdfs>() || column.is::<ShadowHits>();
    let columns = plan.columns.iter().filter(of_light);
    let bytes: usize = columns.map(|column| column.bytes_per_row()).sum();
    let lights = if bytes > 0 { delta_light_rays(scene).max(1) } else { 1 } as f64;
    let shapes = shape_entities(scene).len().max(1) as f64;
    let mut side = max;
    while side > MIN {
        let rays = f64::from(side) * f64::from(side) * lights;
        if rays * bytes as f64 <= MAX_BYTES && rays * shapes <= MAX_TESTS {
            break;
        }
        side = (side / 2).max(MIN);
    }
    side
}

/// Renders a scene with those of the stages on offer that it needs.
///
/// Errors: an invalid scene, a plan that cannot be made, or an observer that stopped the render.
pub fn render(scene: &World, offer: &[Stage], execution: &Execution, watch: &dyn Watch) -> Result<Rendered> {
    let scene = &Census::of(scene);
    let mut in_progress = RenderInProgress::begin(scene, offer, execution)?;
    match adaptive_of(scene)? {
        None => in_progress.advance(in_progress.steps(), watch)?,
        adaptive => {
            let limits = Limits { adaptive, ..Limits::default() };
            if render_in_passes(&mut in_progress, &limits, watch, &mut |_| Ok(()))?.stopped {
                return Err(Error::Interrupted);
            }
        }
    }
    Ok(in_progress.finish())
}

/// The result of a render.
pub struct Rendered {
    /// The stages that ran, and those that did not.
    pub plan: Plan,
    /// The accumulated radiance.
    pub film: Film,
    /// What the picture's file says beside its pixels.
    pub attributes: FileAttributes,
    /// One lap per kept stage, summed over workers; empty where no statistics were requested.
    pub laps: Vec<Lap>,
    /// The number of workers.
    pub threads: usize,
    /// Elapsed time from the first tile to the last.
    pub time: Duration,
    /// Memory of the tables, in bytes.
    pub table_bytes: usize,
    pub(super) curve: Curve,
}

impl Rendered {
    /// Writes the picture: a PNG by its [curve](method@Self::curve) for a name that ends in `.png`, linear OpenEXR for every
    /// other.
    ///
    /// Errors: the path and what the system said; no part of a file is left behind.
    ///
    /// ```
    /// use pinhole::prelude::*;
    ///
    /// let mut scene = World::new();
    /// scene.spawn((PerspectiveCamera::default(), Resolution { width: 8, height: 8 }));
    /// scene.spawn(Background { colour: Rgb::grey(0.5) });
    /// let folder = tempfile::tempdir()?;
    /// let file = folder.path().join("grey.png");
    /// render_scene(&scene)?.save(&file)?;
    /// assert!(file.exists());
    /// # Ok::<(), pinhole::Error>(())
    /// ```
    pub fn save(&self, path: &Path) -> Result {
        let is_png = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"));
        match is_png {
            true => write_png(&self.film, self.curve(), path),
            false => write_exr_with(&self.film, None, &self.attributes, path),
        }
    }

    /// The curve that turns the film into a picture: sRGB for radiance, after the camera's exposure and tone mapping if
    /// it has them, and the identity for a view's values.
    pub fn curve(&self) -> Curve {
        self.curve
    }
}
