use super::clock::{Lap, StageClock, laps_of};
use super::execution::{tile_side, workers};
use super::light_pass::{LightPass, Means, SamplePass, batches};
use super::memory::check_film_fits;
use super::moments::Moments;
use super::render_world::{RenderWorld, prepare};
use super::steps::{Run, WHOLE, next_sample, runs, steps_of};
use super::{Execution, Rendered, Watch, Worlds};
use crate::extract::{ImageFrame, LayerTable, SamplingTable, adaptive_of};
use crate::film::{BLOCK, Curve, FileAttributes, Film, FilmLayers, FilmMoments, FilmSplats, FilmTile};
use crate::follow::{Splats, Stop};
use crate::plan::{Census, ExtractedTable, Plan, Shared, Stage};
use crate::rays::{PixelSamples, Tile, Wavelengths};
use crate::scene::check_workers;
use crate::{Error, Result};
use bevy_ecs::prelude::*;
use rayon::ThreadPool;
use std::any::TypeId;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// A render that advances step by step; between two calls its film may be displayed, saved, or replaced.
///
/// A step is one lattice of the first sample, or one further sample of every pixel.
/// How the steps are divided into calls changes no bit of the film.
pub struct RenderInProgress {
    /// The stages that run, and those that do not.
    pub plan: Plan,
    /// The radiance accumulated so far.
    pub film: Film,
    /// How the camera samples its pixels.
    pub sampling: SamplingTable,
    /// The curve that turns the film into a picture.
    pub curve: Curve,
    /// What the picture's file says beside its pixels.
    pub attributes: FileAttributes,
    pub(super) tables: Vec<ExtractedTable>,
    pub(super) execution: Execution,
    pub(super) pool: Option<ThreadPool>,
    /// One world per worker, or one for all tiles; each is made when and where it is first used.
    pub(super) worlds: Vec<Mutex<Option<RenderWorld>>>,
    /// The pass that traces paths from the lights, where the plan has one.
    pub(super) light: Option<LightPass<Splats>>,
    /// The pass that traces light paths for each sample, where the plan has one.
    pub(super) of_sample: Option<SamplePass>,
    /// The moments of a scene that changes while the shutter is open.
    pub(super) moments: Option<Moments>,
    pub(super) time: Duration,
}

/// The part of the film that belongs to one tile.
pub(super) struct FilmPart<'f> {
    pub film: &'f mut FilmTile,
    pub moments: Option<&'f mut FilmMoments>,
    pub layers: Option<&'f mut FilmLayers>,
    pub done: &'f mut u32,
    pub planned: Option<&'f [u32]>,
}

impl RenderInProgress {
    /// Plans a scene, extracts its tables, and makes an empty film.
    ///
    /// Errors: an invalid scene, or a plan that cannot be made.
    pub fn begin(scene: &Census<'_>, offer: &[Stage], execution: &Execution) -> Result<Self> {
        let (plan, tables) = prepare(scene, offer)?;
        let image = *scene.table::<ImageFrame>()?;
        check_film_fits(scene, &plan)?;
        let execution = Execution { tile_side: tile_side(scene, &plan, execution.tile_side), ..execution.clone() };
        let part = part_of(image, &plan, adaptive_of(scene)?.is_some(), execution.part)?;
        let film = film_for(scene, &plan, Film::of_part(part, execution.tile_side));
        let sampling = *scene.table::<SamplingTable>()?;
        let pool = match execution.worlds {
            Worlds::One => None,
            Worlds::PerWorker => {
                let count = workers(&execution, film.tiles.len() as u64, batches(scene, &plan, sampling, image)?);
                let refused = |why: String| Error::Usage(format!("cannot start {count} workers: {why}"));
                check_workers(count).map_err(|too_little| {
                    refused(format!("their part of the address space {too_little}; --threads starts fewer"))
                })?;
                let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build();
                Some(pool.map_err(|why| refused(why.to_string()))?)
            }
        };
        let worlds = pool.as_ref().map_or(1, ThreadPool::current_num_threads);
        let light = LightPass::of(scene, &plan, worlds)?;
        let of_sample = SamplePass::of(scene, &plan, worlds)?;
        Ok(Self {
            light,
            of_sample,
            moments: None,
            curve: Curve::of(scene, &plan)?,
            attributes: FileAttributes::of(scene)?,
            plan,
            film,
            sampling,
            tables,
            execution,
            pool,
            worlds: (0..worlds).map(|_| Mutex::new(None)).collect(),
            time: Duration::ZERO,
        })
    }

    /// Begins another picture, of a scene that may have changed.
    ///
    /// Where the plan stays the same, as it does when the camera moves, workers keep their worlds, with the schedules and
    /// the memory of the columns.
    ///
    /// Errors: an invalid scene, or a plan that cannot be made; the render then stays as it was.
    pub fn begin_frame(&mut self, scene: &Census<'_>, offer: &[Stage]) -> Result {
        let (plan, tables) = prepare(scene, offer)?;
        if self.light.is_some()
            || self.of_sample.is_some()
            || plan.rows != self.plan.rows
            || plan.columns != self.plan.columns
        {
            *self = Self::begin(scene, offer, &self.execution)?;
            return Ok(());
        }
        let image = *scene.table::<ImageFrame>()?;
        check_film_fits(scene, &plan)?;
        let kinds = LayerTable::kinds_of(scene);
        let is_alike = self.film.layers.first().is_none_or(|layers| layers.kinds == kinds);
        if is_alike && [self.film.width, self.film.height] == [image.width, image.height] {
            self.film.empty();
        } else {
            self.film = film_for(scene, &plan, Film::new(image.width, image.height, self.execution.tile_side));
        }
        (self.sampling, self.curve) = (*scene.table::<SamplingTable>()?, Curve::of(scene, &plan)?);
        self.attributes = FileAttributes::of(scene)?;
        for world in &mut self.worlds {
            let Some(world) = world.get_mut().unwrap_or_else(PoisonError::into_inner) else { continue };
            tables.iter().for_each(|table| (table.insert)(&mut world.world));
            if plan.statistics {
                world.world.insert_resource(StageClock::new(&plan));
            }
        }
        (self.plan, self.tables, self.time) = (plan, tables, Duration::ZERO);
        Ok(())
    }

    /// The number of workers.
    pub fn threads(&self) -> usize {
        self.worlds.len()
    }

    /// The tables that the stages read, for checks of the scene before it is rendered.
    pub fn tables(&self) -> &[ExtractedTable] {
        &self.tables
    }

    /// Whether the camera takes random samples; if not, the render is a single step.
    pub fn is_sampled(&self) -> bool {
        self.plan.keeps::<PixelSamples>()
    }

    /// The number of steps for the samples per pixel that the camera asks for.
    pub fn steps(&self) -> u32 {
        steps_of(self.sampling.samples)
    }

    /// Time spent in steps so far.
    pub fn time(&self) -> Duration {
        self.time
    }

    /// Advances every tile to `to` steps; a tile that is further already stays as it is.
    ///
    /// Errors: the observer stopped the render; each tile then has finished some number of steps, and can be advanced
    /// again.
    /// A sample in progress is discarded.
    pub fn advance(&mut self, to: u32, watch: &dyn Watch) -> Result {
        let to = if self.is_sampled() { to } else { WHOLE };
        if self.moments.is_some() { self.advance_at_moments(to, watch) } else { self.advance_scene(to, watch) }
    }

    /// The same with the scene whose tables the worlds have.
    pub(super) fn advance_scene(&mut self, to: u32, watch: &dyn Watch) -> Result {
        let started = Instant::now();
        if self.of_sample.is_none() {
            self.advance_tiles(to, watch);
        } else {
            // Each sample has light paths of its own, so that all tiles take it before any takes the next.
            while self.film.least_done() < to && !watch.stopped() {
                let (next, sample) = next_sample(self.film.least_done(), to);
                if !self.trace_light_paths(sample, watch) {
                    break;
                }
                self.advance_tiles(next, watch);
            }
        }
        if let Some(light) = &self.light {
            let samples = self.film.samples_between(0, to);
            let pool = self.pool.as_ref();
            let means = Means { plan: &self.plan, tables: &self.tables, pool };
            light.advance(&mut self.film, samples, &means, watch);
        }
        self.time += started.elapsed();
        if watch.stopped() { Err(Error::Interrupted) } else { Ok(()) }
    }

    /// Gives the worlds what the light paths of a sample become; returns whether they were traced.
    pub(super) fn trace_light_paths(&mut self, sample: u32, watch: &dyn Watch) -> bool {
        let Some(pass) = &self.of_sample else { return true };
        let means = Means { plan: &self.plan, tables: &self.tables, pool: self.pool.as_ref() };
        let Some(map) = pass.map(sample, self.film.splats.as_mut(), &means, watch) else { return false };
        map.replace(&mut self.tables);
        for world in &mut self.worlds {
            if let Some(world) = world.get_mut().unwrap_or_else(PoisonError::into_inner) {
                map.insert(&mut world.world);
            }
        }
        true
    }

    fn advance_tiles(&mut self, to: u32, watch: &dyn Watch) {
        let stop = Stop::at_flag(watch.stop_flag());
        match &self.pool {
            Some(pool) => {
                let tiles = Mutex::new(film_parts(&mut self.film));
                let (plan, tables, worlds) = (&self.plan, &self.tables, &self.worlds);
                let next = || tiles.lock().unwrap_or_else(PoisonError::into_inner).next();
                pool.broadcast(|context| {
                    let mut world = worlds[context.index()].lock().unwrap_or_else(PoisonError::into_inner);
                    let world = world.get_or_insert_with(|| RenderWorld::new(plan, tables, 1, &[]));
                    world.stop_at(stop.clone());
                    while let Some(mut part) = next().filter(|_| !watch.stopped()) {
                        if *part.done < to {
                            world.run_part(&mut part, to, watch);
                        }
                    }
                });
            }
            None => {
                let tiles = self.film.tiles.len();
                let made = || RenderWorld::new(&self.plan, &self.tables, tiles, &[]);
                let mut world = self.worlds[0].lock().unwrap_or_else(PoisonError::into_inner);
                world.get_or_insert_with(made).run_all(&mut self.film, to);
            }
        }
    }

    /// Replaces the film by one for pilot samples, which use other random numbers.
    pub fn begin_pilot(&mut self) {
        let film = Film { pilot: true, ..self.film.emptied() };
        self.take(film);
    }

    /// Discards the pilot samples and starts again, with the given number of samples for each pixel.
    pub fn begin_planned(&mut self, planned: Vec<Vec<u32>>) {
        let film = Film { planned, ..self.film.emptied() };
        self.take(film);
    }

    /// Continues from another film of the same plan and scene, such as that of a checkpoint.
    pub fn take(&mut self, film: Film) {
        self.execution.tile_side = film.tile_side;
        let numbers = if film.pilot { self.sampling.for_pilot() } else { self.sampling };
        self.film = film;
        for world in &self.worlds {
            let mut world = world.lock().unwrap_or_else(PoisonError::into_inner);
            *world = None;
        }
        self.renumber(numbers);
    }

    /// Uses these sample numbers from now on.
    pub(super) fn renumber(&mut self, numbers: SamplingTable) {
        for table in self.tables.iter_mut().filter(|table| table.id == TypeId::of::<SamplingTable>()) {
            table.insert = Box::new(move |world: &mut World| world.insert_resource(Shared::new(numbers)));
        }
    }

    /// The laps so far: one per kept stage, summed over workers; empty where no statistics were requested.
    pub fn laps(&self) -> Vec<Lap> {
        let of_lights = self.light.iter().flat_map(LightPass::laps);
        let of_samples = self.of_sample.iter().flat_map(SamplePass::laps);
        sum_laps(self.worlds.iter().filter_map(laps_of).chain(of_lights).chain(of_samples).collect())
    }

    /// Ends the render and returns its result.
    pub fn finish(self) -> Rendered {
        let threads = self.threads();
        let laps = self.laps();
        let table_bytes = self.tables.iter().map(|table| table.bytes).sum();
        let (plan, film, curve, attributes) = (self.plan, self.film, self.curve, self.attributes);
        Rendered { plan, film, curve, attributes, laps, threads, time: self.time, table_bytes }
    }
}

/// The part of an image that is rendered.
///
/// Errors: one that is empty or goes beyond the image, or whose pixels would depend on the rest of the image.
fn part_of(image: ImageFrame, plan: &Plan, is_adaptive: bool, part: Option<Tile>) -> Result<Tile> {
    let ImageFrame { width, height } = image;
    let Some(part) = part else { return Ok(Tile { x: 0, y: 0, width, height }) };
    let Tile { x, y, width: across, height: down } = part;
    let refused = |what: String| Err(Error::Usage(format!("cannot render a part of {across} × {down} pixels: {what}")));
    let fits =
        |start: u32, length: u32, all: u32| length > 0 && start.checked_add(length).is_some_and(|end| end <= all);
    if !fits(x, across, width) || !fits(y, down, height) {
        return refused(format!("from pixel {x},{y} on, it must lie within the image, which has {width} × {height}"));
    }
    if plan.keeps::<Splats>() {
        return refused("paths from the lights may land on any pixel, so render the whole image".into());
    }
    if is_adaptive {
        return refused(
            "the samples that an error asks for depend on the whole image, so say how many with --samples".into(),
        );
    }
    Ok(part)
}

/// A film with the columns that the plan requires beside sums and counts.
pub(super) fn film_for(scene: &Census<'_>, plan: &Plan, mut film: Film) -> Film {
    let rows = film.tiles.iter().map(|tile| tile.tile.rows());
    if plan.keeps::<FilmMoments>() {
        film.moments = rows.clone().map(FilmMoments::new).collect();
    }
    if plan.keeps::<Splats>() {
        film.splats = Some(FilmSplats::new(film.width, film.height));
    }
    if plan.keeps::<FilmLayers>() {
        let kinds = LayerTable::kinds_of(scene);
        film.layers = rows.map(|rows| FilmLayers::new(rows, &kinds)).collect();
    }
    if plan.keeps::<Wavelengths>() {
        film.tiles.iter_mut().for_each(|tile| tile.min = f32::MIN);
        film.splats.iter_mut().for_each(|splats| splats.min = f64::MIN);
    }
    film
}

pub(super) fn film_parts(film: &mut Film) -> impl Iterator<Item = FilmPart<'_>> + Send {
    let mut moments = film.moments.iter_mut();
    let mut layers = film.layers.iter_mut();
    let mut planned = film.planned.iter();
    film.tiles.iter_mut().zip(&mut film.done).map(move |(tile, done)| FilmPart {
        film: tile,
        moments: moments.next(),
        layers: layers.next(),
        done,
        planned: planned.next().map(Vec::as_slice),
    })
}

impl RenderWorld {
    /// Advances one tile to `to` steps.
    pub(super) fn run_part(&mut self, part: &mut FilmPart<'_>, to: u32, watch: &dyn Watch) {
        let tile = self.tiles[0];
        self.swap_part(tile, part);
        for run in runs(*part.done, to) {
            if watch.stopped() {
                break;
            }
            let active = self.activate(tile, &run, part.planned);
            if active > 0 {
                self.begin_block(tile, &run);
                // Layers accumulate before the path is traced, so an abandoned run has to restore them.
                let before = self.world.get::<FilmLayers>(tile).filter(|own| !own.are_empty()).cloned();
                if !self.run() {
                    if let Some(mut own) = self.world.get_mut::<FilmLayers>(tile) {
                        match before {
                            Some(before) => *own = before,
                            None => own.empty(),
                        }
                    }
                    break;
                }
                watch.traced(active as u64);
            }
            *part.done = run.ends();
        }
        self.swap_part(tile, part);
        if *part.done >= to {
            watch.tile_done();
        }
    }

    /// Advances all tiles to `to` steps; those with the fewest steps catch up with the others first.
    fn run_all(&mut self, film: &mut Film, to: u32) {
        let tiles = self.tiles.clone();
        loop {
            let min = film.done.iter().copied().min().unwrap_or(to);
            if min >= to {
                return;
            }
            let next = film.done.iter().copied().filter(|&done| done > min).min().unwrap_or(to).min(to);
            let behind: Vec<bool> = film.done.iter().map(|&done| done == min).collect();
            tiles.iter().zip(film_parts(film)).for_each(|(&tile, mut part)| self.swap_part(tile, &mut part));
            for run in runs(min, next) {
                let mut active = 0;
                for (number, &tile) in tiles.iter().enumerate() {
                    let planned = film.planned.get(number).map(Vec::as_slice);
                    let own = if behind[number] { self.activate(tile, &run, planned) } else { self.rest(tile) };
                    if own > 0 {
                        self.begin_block(tile, &run);
                    }
                    active += own;
                }
                if active > 0 {
                    self.run();
                }
            }
            tiles.iter().zip(film_parts(film)).for_each(|(&tile, mut part)| self.swap_part(tile, &mut part));
            film.done.iter_mut().filter(|done| **done == min).for_each(|done| *done = next);
        }
    }

    /// Ends the block of samples before the one that a run begins, if it begins one.
    fn begin_block(&mut self, tile: Entity, run: &Run) {
        if run.sample == 0 || !run.sample.is_multiple_of(BLOCK) {
            return;
        }
        let mut entity = self.world.entity_mut(tile);
        let Some(mut film) = entity.get_mut::<FilmTile>().map(|mut own| std::mem::take(&mut *own)) else { return };
        if let Some(mut moments) = entity.get_mut::<FilmMoments>() {
            moments.end_block(&film);
        }
        if let Some(mut layers) = entity.get_mut::<FilmLayers>() {
            layers.end_block();
        }
        film.end_block();
        if let Some(mut own) = entity.get_mut::<FilmTile>() {
            *own = film;
        }
    }

    /// Exchanges a tile's part of the film with that in its entity: once to lend it, once to take it back.
    pub(super) fn swap_part(&mut self, tile: Entity, part: &mut FilmPart<'_>) {
        self.swap_film(tile, part.film);
        let mut entity = self.world.entity_mut(tile);
        if let (Some(moments), Some(mut own)) = (&mut part.moments, entity.get_mut::<FilmMoments>()) {
            std::mem::swap(&mut *own, *moments);
        }
        if let (Some(layers), Some(mut own)) = (&mut part.layers, entity.get_mut::<FilmLayers>()) {
            std::mem::swap(&mut *own, *layers);
        }
    }
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
