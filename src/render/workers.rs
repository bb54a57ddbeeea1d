use super::clock::{Lap, StageClock};
use super::inspect::run_in_one_world;
use super::render_world::{RenderWorld, prepare};
use super::{Execution, Watch, Worlds};
use crate::film::{Curve, Film, FilmTile};
use crate::plan::{ExtractedTable, Plan, Table};
use crate::{Error, Result};
use bevy_ecs::prelude::*;
use std::slice::IterMut;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// What a render leaves.
pub struct Rendered {
    /// What ran and what did not.
    pub plan: Plan,
    /// The light that arrived.
    pub film: Film,
    /// A lap a kept stage, summed over workers; empty where no statistics were asked for.
    pub laps: Vec<Lap>,
    /// Workers.
    pub threads: usize,
    /// From the first tile to the last.
    pub time: Duration,
    /// Bytes that the tables take.
    pub table_bytes: usize,
}

impl Rendered {
    /// How the film becomes a picture: light by the sRGB curve, a view's numbers as they are.
    pub fn curve(&self) -> Curve {
        if self.plan.view.is_some() { Curve::Straight } else { Curve::Srgb }
    }
}

/// Renders a scene by the stages on offer that it needs.
///
/// Errors: a refused scene, no plan, or a stop by the one who watches.
pub fn render(
    scene: &World,
    offer: &[crate::plan::Stage],
    execution: &Execution,
    watch: &dyn Watch,
) -> Result<Rendered> {
    let (plan, tables) = prepare(scene, offer)?;
    let image = crate::extract::ImageShape::extract(scene)?;
    let mut film = Film::new(image.width, image.height, execution.tile_side);
    let table_bytes = tables.iter().map(|table| table.bytes).sum();
    let samples = crate::extract::SamplingTable::extract(scene)?.samples;
    let started = Instant::now();
    let (laps, threads) = match execution.worlds {
        Worlds::PerWorker => run_workers(&plan, &tables, execution, &mut film, samples, watch)?,
        Worlds::One => (run_in_one_world(&plan, &tables, execution, &mut film, samples), 1),
    };
    Ok(Rendered { plan, film, laps, threads, time: started.elapsed(), table_bytes })
}

/// Every worker takes the next tile of the film until none is left.
///
/// The lock is taken once a tile, for as long as it takes to advance an iterator; the tile it yields belongs to the
/// worker alone, which lends it to its world and takes it back.
fn run_workers(
    plan: &Plan,
    tables: &[ExtractedTable],
    execution: &Execution,
    film: &mut Film,
    samples: u32,
    watch: &dyn Watch,
) -> Result<(Vec<Lap>, usize)> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(execution.threads.unwrap_or(0))
        .build()
        .map_err(|refused| Error::Usage(format!("cannot start the workers: {refused}")))?;
    let tiles = Mutex::new(film.tiles.iter_mut());
    let laps = pool.broadcast(|_| {
        let mut worker = RenderWorld::new(plan, tables, 1, execution, &[]);
        while let Some(film_tile) = next_tile(&tiles).filter(|_| !watch.stopped()) {
            worker.swap_film(worker.tiles[0], film_tile);
            worker.run_samples(samples);
            worker.swap_film(worker.tiles[0], film_tile);
            watch.tile_done();
        }
        worker.world.remove_resource::<StageClock>().map_or_else(Vec::new, |clock| clock.laps)
    });
    if watch.stopped() { Err(Error::Interrupted) } else { Ok((sum_laps(laps), pool.current_num_threads())) }
}

fn next_tile<'film>(tiles: &Mutex<IterMut<'film, FilmTile>>) -> Option<&'film mut FilmTile> {
    tiles.lock().unwrap_or_else(PoisonError::into_inner).next()
}

fn sum_laps(workers: Vec<Vec<Lap>>) -> Vec<Lap> {
    let mut sums: Vec<Lap> = Vec::new();
    for laps in workers {
        sums.resize(laps.len().max(sums.len()), Lap::default());
        for (sum, lap) in sums.iter_mut().zip(laps) {
            sum.time += lap.time;
            sum.rows += lap.rows;
        }
    }
    sums
}
