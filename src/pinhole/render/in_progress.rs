use super::clock::{Lap, StageClock};
use super::light_pass::{LightPass, Means, batches};
use super::memory::check_film_fits;
use super::render_world::{RenderWorld, prepare};
use super::steps::{WHOLE, runs, steps_of};
use super::tile_side::tile_side;
use super::workers::workers;
use super::{Execution, Rendered, Watch, Worlds};
use crate::extract::{ImageFrame, LayerTable, SamplingTable};
use crate::film::{Film, FilmLayers, FilmMoments, FilmSplats, FilmTile};
use crate::follow::{Splats, Stop};
use crate::plan::{ExtractedTable, Plan, Shared, Stage, Table};
use crate::rays::PixelSamples;
use crate::{Error, Result};
use bevy_ecs::prelude::*;
use rayon::ThreadPool;
use std::any::TypeId;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// A render that is brought forward step by step: between two calls its film may be looked at, kept, or given back.
///
/// A step is a lattice of the first sample, or a further sample of every pixel.
/// How the steps are divided into calls can change no bit of the film.
pub struct RenderInProgress {
    /// What runs and what does not.
    pub plan: Plan,
    /// The light that has arrived so far.
    pub film: Film,
    /// How the camera samples its pixels.
    pub sampling: SamplingTable,
    tables: Vec<ExtractedTable>,
    execution: Execution,
    pool: Option<ThreadPool>,
    /// A world a worker, or one for all tiles; each is made where and when it is first used.
    worlds: Vec<Mutex<Option<RenderWorld>>>,
    /// The ways from lights, where there are any.
    light: Option<LightPass>,
    time: Duration,
}

/// One tile's share of the film.
pub(super) struct Share<'f> {
    film: &'f mut FilmTile,
    moments: Option<&'f mut FilmMoments>,
    layers: Option<&'f mut FilmLayers>,
    done: &'f mut u32,
    planned: Option<&'f [u32]>,
}

impl RenderInProgress {
    /// Plans a scene, reads its tables, and makes an empty film.
    ///
    /// Errors: a refused scene, or no plan.
    pub fn begin(scene: &World, offer: &[Stage], execution: &Execution) -> Result<Self> {
        let (plan, tables) = prepare(scene, offer)?;
        let image = ImageFrame::extract(scene)?;
        check_film_fits(scene, &plan)?;
        let execution = Execution { tile_side: tile_side(scene, &plan, execution.tile_side), ..execution.clone() };
        let film = film_for(scene, &plan, Film::new(image.width, image.height, execution.tile_side));
        let sampling = SamplingTable::extract(scene)?;
        let pool = match execution.worlds {
            Worlds::One => None,
            Worlds::PerWorker => Some(
                rayon::ThreadPoolBuilder::new()
                    .num_threads(workers(&execution, film.tiles.len() as u64, batches(scene, &plan, sampling, image)?))
                    .build()
                    .map_err(|refused| Error::Usage(format!("cannot start the workers: {refused}")))?,
            ),
        };
        let worlds = pool.as_ref().map_or(1, ThreadPool::current_num_threads);
        let light = LightPass::of(scene, &plan, worlds)?;
        Ok(Self {
            light,
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

    /// Workers.
    pub fn threads(&self) -> usize {
        self.worlds.len()
    }

    /// The tables that its stages read, for whoever looks at the scene before it is rendered.
    pub fn tables(&self) -> &[ExtractedTable] {
        &self.tables
    }

    /// Whether the camera takes samples; where it does not, all is one step.
    pub fn is_sampled(&self) -> bool {
        self.plan.keeps::<PixelSamples>()
    }

    /// The steps that the camera asks for.
    pub fn steps(&self) -> u32 {
        steps_of(self.sampling.samples)
    }

    /// Time spent in steps.
    pub fn time(&self) -> Duration {
        self.time
    }

    /// Brings every tile to `to` steps; one that is further already stays as it is.
    ///
    /// Errors: a stop by the one who watches; each tile then has all of some number of steps, and can be brought on.
    /// A sample that was under way is thrown away.
    pub fn advance(&mut self, to: u32, watch: &dyn Watch) -> Result {
        let started = Instant::now();
        let to = if self.is_sampled() { to } else { WHOLE };
        let stop = Stop::at_flag(watch.stop_flag());
        match &self.pool {
            Some(pool) => {
                let tiles = Mutex::new(shares(&mut self.film));
                let (plan, tables, execution, worlds) = (&self.plan, &self.tables, &self.execution, &self.worlds);
                let next = || tiles.lock().unwrap_or_else(PoisonError::into_inner).next();
                pool.broadcast(|context| {
                    let mut world = worlds[context.index()].lock().unwrap_or_else(PoisonError::into_inner);
                    let world = world.get_or_insert_with(|| RenderWorld::new(plan, tables, 1, execution, &[]));
                    world.stop_at(stop.clone());
                    while let Some(mut share) = next().filter(|_| !watch.stopped()) {
                        if *share.done < to {
                            world.run_share(&mut share, to, watch);
                        }
                    }
                });
            }
            None => {
                let tiles = self.film.tiles.len();
                let made = || RenderWorld::new(&self.plan, &self.tables, tiles, &self.execution, &[]);
                let mut world = self.worlds[0].lock().unwrap_or_else(PoisonError::into_inner);
                world.get_or_insert_with(made).run_all(&mut self.film, to);
            }
        }
        if let Some(light) = &self.light {
            let samples = self.film.samples_between(0, to);
            let pool = self.pool.as_ref();
            let means = Means { plan: &self.plan, tables: &self.tables, execution: &self.execution, pool };
            light.advance(&mut self.film, samples, &means, watch);
        }
        self.time += started.elapsed();
        if watch.stopped() { Err(Error::Interrupted) } else { Ok(()) }
    }

    /// Lays the film aside for one of pilot samples, whose random numbers are others.
    pub fn begin_pilot(&mut self) {
        let film = Film { pilot: true, ..self.film.emptied() };
        self.take(film);
    }

    /// Throws the pilot's samples away and begins anew, with as many samples for each pixel as have been decided.
    pub fn begin_planned(&mut self, planned: Vec<Vec<u32>>) {
        let film = Film { planned, ..self.film.emptied() };
        self.take(film);
    }

    /// Continues from another film of the same plan and scene, such as a checkpoint's.
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

    /// From now on samples are placed by these numbers.
    fn renumber(&mut self, numbers: SamplingTable) {
        for table in self.tables.iter_mut().filter(|table| table.id == TypeId::of::<SamplingTable>()) {
            table.insert = Box::new(move |world: &mut World| world.insert_resource(Shared::new(numbers)));
        }
    }

    /// Ends it: what it leaves.
    pub fn finish(self) -> Rendered {
        let threads = self.threads();
        let clock_of = |world: Mutex<Option<RenderWorld>>| {
            let world = world.into_inner().unwrap_or_else(PoisonError::into_inner);
            world.and_then(|mut world| world.world.remove_resource::<StageClock>())
        };
        let of_lights = self.light.into_iter().flat_map(LightPass::clocks);
        let clocks = self.worlds.into_iter().filter_map(clock_of).chain(of_lights);
        let laps = clocks.map(|clock| clock.laps).collect();
        let table_bytes = self.tables.iter().map(|table| table.bytes).sum();
        Rendered { plan: self.plan, film: self.film, laps: sum_laps(laps), threads, time: self.time, table_bytes }
    }
}

/// A film with the columns that the plan keeps beside sums and counts.
pub(super) fn film_for(scene: &World, plan: &Plan, mut film: Film) -> Film {
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
    film
}

pub(super) fn shares(film: &mut Film) -> impl Iterator<Item = Share<'_>> + Send {
    let mut moments = film.moments.iter_mut();
    let mut layers = film.layers.iter_mut();
    let mut planned = film.planned.iter();
    film.tiles.iter_mut().zip(&mut film.done).map(move |(tile, done)| Share {
        film: tile,
        moments: moments.next(),
        layers: layers.next(),
        done,
        planned: planned.next().map(Vec::as_slice),
    })
}

impl RenderWorld {
    /// Brings one tile to `to` steps.
    fn run_share(&mut self, share: &mut Share<'_>, to: u32, watch: &dyn Watch) {
        let tile = self.tiles[0];
        self.swap_share(tile, share);
        // Layers are added to before light goes on its way, so a run that is given up has to take them back.
        let mut layers = FilmLayers::default();
        for run in runs(*share.done, to) {
            if watch.stopped() {
                break;
            }
            let active = self.activate(tile, &run, share.planned);
            if active > 0 {
                if let Some(own) = self.world.get::<FilmLayers>(tile) {
                    layers.clone_from(own);
                }
                if !self.run() {
                    if let Some(mut own) = self.world.get_mut::<FilmLayers>(tile) {
                        std::mem::swap(&mut *own, &mut layers);
                    }
                    break;
                }
                watch.traced(active as u64);
            }
            *share.done = run.ends();
        }
        self.swap_share(tile, share);
        if *share.done >= to {
            watch.tile_done();
        }
    }

    /// Brings all tiles to `to` steps; those that have the fewest behind them first catch up with the others.
    fn run_all(&mut self, film: &mut Film, to: u32) {
        let tiles = self.tiles.clone();
        loop {
            let least = film.done.iter().copied().min().unwrap_or(to);
            if least >= to {
                return;
            }
            let next = film.done.iter().copied().filter(|&done| done > least).min().unwrap_or(to).min(to);
            let behind: Vec<bool> = film.done.iter().map(|&done| done == least).collect();
            tiles.iter().zip(shares(film)).for_each(|(&tile, mut share)| self.swap_share(tile, &mut share));
            for run in runs(least, next) {
                let mut active = 0;
                for (number, &tile) in tiles.iter().enumerate() {
                    let planned = film.planned.get(number).map(Vec::as_slice);
                    active += if behind[number] { self.activate(tile, &run, planned) } else { self.rest(tile) };
                }
                if active > 0 {
                    self.run();
                }
            }
            tiles.iter().zip(shares(film)).for_each(|(&tile, mut share)| self.swap_share(tile, &mut share));
            film.done.iter_mut().filter(|done| **done == least).for_each(|done| *done = next);
        }
    }

    /// Lends a tile's share of the film to its entity, or takes it back: the two change places.
    pub(super) fn swap_share(&mut self, tile: Entity, share: &mut Share<'_>) {
        self.swap_film(tile, share.film);
        let mut entity = self.world.entity_mut(tile);
        if let (Some(moments), Some(mut own)) = (&mut share.moments, entity.get_mut::<FilmMoments>()) {
            std::mem::swap(&mut *own, *moments);
        }
        if let (Some(layers), Some(mut own)) = (&mut share.layers, entity.get_mut::<FilmLayers>()) {
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
