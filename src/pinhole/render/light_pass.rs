use super::clock::{Lap, laps_of, thread_time};
use super::render_world::{Hook, RenderWorld};
use crate::extract::{FilterTable, ImageFrame, LightTracingTable, SamplingTable};
use crate::film::{Film, SplatFilter};
use crate::follow::{LIGHT_PATHS, Splats, Stop};
use crate::plan::{Census, Column, ExtractedTable, Plan, RowKind, Shared, VectorRows};
use crate::rays::{SampleNumber, Tile};
use crate::render::Watch;
use crate::scene::SceneError;
use bevy_ecs::prelude::*;
use rayon::ThreadPool;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The number of batches whose splats are added together: a few for every worker, so that memory stays bounded.
const BATCHES_AT_ONCE: u64 = 64;

/// The pass whose rows are paths from the lights.
///
/// Its batches are numbered throughout the render, independently of the image's tiles, and their splats are added in
/// that order.
pub(super) struct LightPass {
    /// One world per worker.
    worlds: Vec<Mutex<Option<RenderWorld>>>,
    /// The splats of the batches in progress, one list each.
    lists: Vec<Mutex<Splats>>,
    /// The number of light paths per pixel sample.
    paths: f64,
    filter: SplatFilter,
    sampling: SamplingTable,
}

/// The greatest number of batches that a render's light pass runs at once; 0 without such a pass.
pub(super) fn batches(
    scene: &Census<'_>,
    plan: &Plan,
    sampling: SamplingTable,
    image: ImageFrame,
) -> Result<u64, SceneError> {
    if !has_light_pass(plan) {
        return Ok(0);
    }
    let samples = f64::from(image.width) * f64::from(image.height) * f64::from(sampling.samples);
    Ok(batches_for(samples, scene.table::<LightTracingTable>()?.paths).min(BATCHES_AT_ONCE))
}

/// The number of batches that corresponds to so many pixel samples.
fn batches_for(samples: f64, paths: f64) -> u64 {
    (samples * paths / f64::from(LIGHT_PATHS)).ceil() as u64
}

fn has_light_pass(plan: &Plan) -> bool {
    plan.passes.iter().any(|pass| pass.row == RowKind::LightPath)
}

/// What the light pass uses of the render.
pub(super) struct Means<'a> {
    pub plan: &'a Plan,
    pub tables: &'a [ExtractedTable],
    pub pool: Option<&'a ThreadPool>,
}

impl LightPass {
    /// The pass, where the plan has one.
    pub fn of(scene: &Census<'_>, plan: &Plan, workers: usize) -> Result<Option<Self>, SceneError> {
        if !has_light_pass(plan) {
            return Ok(None);
        }
        Ok(Some(Self {
            worlds: (0..workers).map(|_| Mutex::new(None)).collect(),
            lists: (0..BATCHES_AT_ONCE).map(|_| Mutex::default()).collect(),
            paths: scene.table::<LightTracingTable>()?.paths,
            filter: SplatFilter::new(scene.table::<FilterTable>()?.filter),
            sampling: scene.table::<SamplingTable>()?.for_light_paths(),
        }))
    }

    /// The number of batches that corresponds to so many pixel samples.
    pub fn batches(&self, samples: u64) -> u64 {
        batches_for(samples as f64, self.paths)
    }

    /// Whether the film has the light paths that correspond to so many pixel samples.
    pub fn is_done(&self, film: &Film, samples: u64) -> bool {
        film.splats.as_ref().is_none_or(|splats| splats.paths / u64::from(LIGHT_PATHS) >= self.batches(samples))
    }

    /// Lets the worlds go, so that the next batches are those of another scene.
    pub fn forget_scene(&mut self) {
        self.worlds.iter_mut().for_each(|world| *world = Mutex::new(None));
    }

    /// Advances the light pass to correspond to so many pixel samples, or as far as the observer allows; batches in
    /// progress when it is stopped do not contribute.
    pub fn advance(&self, film: &mut Film, samples: u64, means: &Means<'_>, watch: &dyn Watch) {
        let Some(splats) = &mut film.splats else { return };
        let mut filter = self.filter.clone();
        let batch = u64::from(LIGHT_PATHS);
        let all = self.batches(samples);
        while splats.paths / batch < all && !watch.stopped() {
            let first = splats.paths / batch;
            let Some(count) = self.run(first, all - first, means, watch) else { return };
            for list in &self.lists[..count as usize] {
                let mut list = list.lock().unwrap_or_else(PoisonError::into_inner);
                for at in 0..list.rows() {
                    splats.add(&mut filter, list.raster.at(at), list.rgb(at));
                }
                list.clear();
            }
            splats.paths += count * batch;
        }
    }

    /// The splats of some batches, of at most so many, and how many they are; none if they were abandoned.
    pub fn lists(&self, first: u64, max: u64, means: &Means<'_>, watch: &dyn Watch) -> Option<(u64, Vec<Splats>)> {
        let count = self.run(first, max, means, watch)?;
        let take = |list: &Mutex<Splats>| std::mem::take(&mut *list.lock().unwrap_or_else(PoisonError::into_inner));
        Some((count, self.lists[..count as usize].iter().map(take).collect()))
    }

    /// Runs some batches, of at most so many, each into its list, and says how many; none if they were abandoned.
    fn run(&self, first: u64, max: u64, means: &Means<'_>, watch: &dyn Watch) -> Option<u64> {
        let stop = Stop::at_flag(watch.stop_flag());
        let count = max.min(BATCHES_AT_ONCE);
        let (next, given_up) = (AtomicU64::new(0), AtomicBool::new(false));
        let work = |worker: usize| {
            let mut world = self.worlds[worker].lock().unwrap_or_else(PoisonError::into_inner);
            let world = world.get_or_insert_with(|| self.world(means));
            world.stop_at(stop.clone());
            loop {
                let number = next.fetch_add(1, Ordering::Relaxed);
                if number >= count {
                    return;
                }
                let mut list = self.lists[number as usize].lock().unwrap_or_else(PoisonError::into_inner);
                if watch.stopped() || !run_batch(world, first + number, &mut list) {
                    given_up.store(true, Ordering::Relaxed);
                    return;
                }
            }
        };
        match means.pool {
            Some(pool) => _ = pool.broadcast(|context| work(context.index())),
            None => work(0),
        }
        if given_up.into_inner() {
            self.lists.iter().for_each(|list| list.lock().unwrap_or_else(PoisonError::into_inner).clear());
            return None;
        }
        Some(count)
    }

    fn world(&self, means: &Means<'_>) -> RenderWorld {
        let (plan, tables) = (means.plan, means.tables);
        let mut made = RenderWorld::of_pass(RowKind::LightPath, plan, tables, 1, &[]);
        made.world.insert_resource(Shared::new(self.sampling));
        made
    }

    /// The bits of the splats of the first batch.
    pub fn first_splats(&self, means: &Means<'_>, watch: &dyn Watch) -> Vec<u64> {
        let (mut world, mut list) = (self.world(means), Splats::default());
        world.stop_at(Stop::at_flag(watch.stop_flag()));
        run_batch(&mut world, 0, &mut list);
        (0..list.rows()).flat_map(|at| list.raster.at(at).into_iter().chain(list.rgb(at))).map(f64::to_bits).collect()
    }

    /// The laps of each worker so far.
    pub fn laps(&self) -> impl Iterator<Item = Vec<Lap>> {
        self.worlds.iter().filter_map(laps_of)
    }
}

/// Runs the first batch of light paths for no longer than `patience`, with hooks after each stage; `look` gets the world
/// and the processor time that the batch took, or ran until it was abandoned; none where it is not known.
///
/// Returns whether the plan has such a pass.
pub fn probe_light_paths(
    scene: &Census<'_>,
    (plan, tables): (&Plan, &[ExtractedTable]),
    patience: Duration,
    hooks: &[Hook],
    look: &mut dyn FnMut(&mut World, Option<Duration>),
) -> Result<bool, SceneError> {
    if !has_light_pass(plan) {
        return Ok(false);
    }
    let sampling = scene.table::<SamplingTable>()?.for_light_paths();
    let mut made = RenderWorld::of_pass(RowKind::LightPath, plan, tables, 1, hooks);
    made.world.insert_resource(Shared::new(sampling));
    let before = thread_time();
    made.stop_at(Stop::at_deadline(Instant::now() + patience));
    run_batch(&mut made, 0, &mut Splats::default());
    look(&mut made.world, before.and_then(|before| Some(thread_time()?.saturating_sub(before))));
    Ok(true)
}

/// Runs a batch of light paths and moves their splats to `list`, which is empty; returns whether the run was completed.
fn run_batch(world: &mut RenderWorld, batch: u64, list: &mut Splats) -> bool {
    let tile = world.tiles[0];
    let mut entity = world.world.entity_mut(tile);
    if let Some(mut place) = entity.get_mut::<Tile>() {
        // The random numbers of a light path are a function of its row and its batch alone.
        *place = Tile { x: 0, y: (batch >> 32) as u32, width: LIGHT_PATHS, height: 1 };
    }
    if let Some(mut number) = entity.get_mut::<SampleNumber>() {
        *number = SampleNumber(batch as u32);
    }
    let whole = world.run();
    if let Some(mut own) = world.world.get_mut::<Splats>(tile) {
        std::mem::swap(&mut *own, list);
    }
    whole
}
