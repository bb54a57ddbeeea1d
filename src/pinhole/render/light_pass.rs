use super::clock::{Lap, laps_of, thread_time};
use super::render_world::{Hook, RenderWorld};
use crate::each::Each;
use crate::extract::{FilterTable, ImageFrame, LightTracingTable, SamplingTable, pixel_width};
use crate::film::{Film, FilmSplats, SplatFilter};
use crate::follow::{
    LIGHT_PATHS, LightVertexMap, LightVertices, Photon, PhotonMap, Photons, Splats, Stop, first_radius, photon_radius,
};
use crate::plan::{Census, Column, ExtractedTable, Plan, RowKind, Shared, Table, VectorRows};
use crate::rays::{SampleNumber, Tile};
use crate::render::Watch;
use crate::scene::SceneError;
use bevy_ecs::prelude::*;
use rayon::ThreadPool;
use std::any::TypeId;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

/// The number of batches whose splats are added together: a few for every worker, so that memory stays bounded.
const BATCHES_AT_ONCE: u64 = 64;

/// What a batch of light paths leaves: a column, or several.
pub(super) trait Left: Default + Send {
    /// Whether the plan has it.
    fn is_kept(plan: &Plan) -> bool;
    /// Exchanges it with that of a tile.
    fn swap(&mut self, tile: &mut EntityWorldMut<'_>);
}

impl<C: Column> Left for C {
    fn is_kept(plan: &Plan) -> bool {
        plan.keeps::<C>()
    }

    fn swap(&mut self, tile: &mut EntityWorldMut<'_>) {
        if let Some(mut own) = tile.get_mut::<C>() {
            std::mem::swap(&mut *own, self);
        }
    }
}

/// The light vertices of a batch, and what its paths add to the film by themselves.
#[derive(Default)]
pub(super) struct VerticesAndSplats {
    vertices: LightVertices,
    splats: Splats,
}

impl Left for VerticesAndSplats {
    fn is_kept(plan: &Plan) -> bool {
        plan.keeps::<LightVertices>()
    }

    fn swap(&mut self, tile: &mut EntityWorldMut<'_>) {
        self.vertices.swap(tile);
        self.splats.swap(tile);
    }
}

/// The pass whose rows are paths from the lights, and what they leave: splats, photons or vertices.
///
/// Its batches are numbered throughout the render, independently of the image's tiles, and what they leave is added in
/// that order.
pub(super) struct LightPass<C> {
    /// One world per worker.
    worlds: Vec<Mutex<Option<RenderWorld>>>,
    /// What the batches in progress have left, one list each.
    lists: Vec<Mutex<C>>,
    /// The number of light paths per pixel sample.
    paths: f64,
    /// The pixels of the image, and the batches for a sample of each, where each sample has its own.
    each_sample: Option<[u64; 2]>,
    /// The batches of each sample, where pixels are joined to its paths.
    joined: Option<u64>,
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

impl<C: Left> LightPass<C> {
    /// The pass, where the plan has one that leaves these.
    pub fn of(scene: &Census<'_>, plan: &Plan, workers: usize) -> Result<Option<Self>, SceneError> {
        if !C::is_kept(plan) {
            return Ok(None);
        }
        let (image, tracing) = (scene.table::<ImageFrame>()?, scene.table::<LightTracingTable>()?);
        let pixels = u64::from(image.width) * u64::from(image.height);
        let batches = (tracing.each_sample / f64::from(LIGHT_PATHS)) as u64;
        let is_for_samples = plan.keeps::<LightVertices>() || plan.keeps::<Photons>();
        Ok(Some(Self {
            worlds: (0..workers).map(|_| Mutex::new(None)).collect(),
            lists: (0..BATCHES_AT_ONCE).map(|_| Mutex::default()).collect(),
            paths: tracing.paths,
            each_sample: is_for_samples.then_some([pixels, batches]),
            filter: SplatFilter::new(scene.table::<FilterTable>()?.filter),
            joined: plan.keeps::<LightVertices>().then_some(batches),
            sampling: scene.table::<SamplingTable>()?.for_light_paths(plan.keeps::<LightVertices>()),
        }))
    }

    /// The number of batches that corresponds to so many pixel samples.
    pub fn batches(&self, samples: u64) -> u64 {
        match self.each_sample {
            Some([pixels, batches]) => samples.div_ceil(pixels) * batches,
            None => batches_for(samples as f64, self.paths),
        }
    }

    /// Lets the worlds go, so that the next batches are those of another scene.
    pub fn forget_scene(&mut self) {
        self.worlds.iter_mut().for_each(|world| *world = Mutex::new(None));
    }

    /// What some batches leave, of at most so many, and how many they are; none if they were abandoned.
    pub fn lists(&self, first: u64, max: u64, means: &Means<'_>, watch: &dyn Watch) -> Option<(u64, Vec<C>)> {
        let count = self.run(first, max, means, watch)?;
        let take = |list: &Mutex<C>| std::mem::take(&mut *list.lock().unwrap_or_else(PoisonError::into_inner));
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
                if watch.stopped() || !run_batch(world, (first + number, self.joined), &mut *list) {
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
            self.lists.iter().for_each(|list| *list.lock().unwrap_or_else(PoisonError::into_inner) = C::default());
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

    /// The laps of each worker so far.
    pub fn laps(&self) -> impl Iterator<Item = Vec<Lap>> {
        self.worlds.iter().filter_map(laps_of)
    }
}

impl LightPass<VerticesAndSplats> {
    /// Takes back what batches have left, once it is used: the next ones write where these did.
    fn take_back(&self, used: Vec<VerticesAndSplats>) {
        for (list, mut own) in self.lists.iter().zip(used) {
            own.vertices.clear();
            own.splats.clear();
            *list.lock().unwrap_or_else(PoisonError::into_inner) = own;
        }
    }
}

impl LightPass<Splats> {
    /// Whether the film has the light paths that correspond to so many pixel samples.
    pub fn is_done(&self, film: &Film, samples: u64) -> bool {
        film.splats.as_ref().is_none_or(|splats| splats.paths / u64::from(LIGHT_PATHS) >= self.batches(samples))
    }

    /// Advances the light pass to correspond to so many pixel samples, or as far as the observer allows; batches in
    /// progress when it is stopped do not contribute.
    pub fn advance(&self, film: &mut Film, samples: u64, means: &Means<'_>, watch: &dyn Watch) {
        let Some(splats) = &mut film.splats else { return };
        let batch = u64::from(LIGHT_PATHS);
        let all = self.batches(samples);
        while splats.paths / batch < all && !watch.stopped() {
            let first = splats.paths / batch;
            let Some(count) = self.run(first, all - first, means, watch) else { return };
            for list in &self.lists[..count as usize] {
                let mut list = list.lock().unwrap_or_else(PoisonError::into_inner);
                add_splats(splats, &self.filter, &list);
                list.clear();
            }
            splats.paths += count * batch;
        }
    }

    /// The bits of the splats of the first batch.
    pub fn first_splats(&self, means: &Means<'_>, watch: &dyn Watch) -> Vec<u64> {
        let (mut world, mut list) = (self.world(means), Splats::default());
        world.stop_at(Stop::at_flag(watch.stop_flag()));
        run_batch(&mut world, (0, self.joined), &mut list);
        (0..list.rows()).flat_map(|at| list.raster.at(at).into_iter().chain(list.rgb(at))).map(f64::to_bits).collect()
    }
}

/// Adds the splats of a batch to the film's, in their order.
fn add_splats(film: &mut FilmSplats, filter: &SplatFilter, list: &Splats) {
    let mut filter = filter.clone();
    for at in 0..list.rows() {
        film.add(&mut filter, list.raster.at(at), list.rgb(at));
    }
}

/// The pass that traces light paths for each sample before its paths from the camera.
pub(super) struct SamplePass {
    kind: SampleKind,
    /// The batches of a sample.
    batches: u64,
}

/// What the light paths of a sample become.
enum SampleKind {
    /// Photons.
    Photons {
        pass: LightPass<Photons>,
        /// How wide a pixel is, in scene units, and for each at which it is seen.
        pixel: [f64; 2],
        /// The radius for the first sample: the one that the scene gives, or that follows from its photons.
        first_radius: OnceLock<f64>,
    },
    /// Vertices that are joined, for an image of this size.
    Vertices { pass: LightPass<VerticesAndSplats>, size: [u32; 2] },
}

/// What paths from the camera find of the light paths of their sample.
#[derive(Clone)]
pub(super) enum SampleMap {
    /// Photons.
    Photons(Arc<PhotonMap>),
    /// Light vertices.
    Vertices(Arc<LightVertexMap>),
}

impl SampleMap {
    /// Puts the table into a world.
    pub fn insert(&self, world: &mut World) {
        match self {
            Self::Photons(map) => world.insert_resource(Shared::from(Arc::clone(map))),
            Self::Vertices(map) => world.insert_resource(Shared::from(Arc::clone(map))),
        }
    }

    /// Puts it in the place of the empty one among the tables of a render.
    pub fn replace(&self, tables: &mut [ExtractedTable]) {
        let (id, bytes) = match self {
            Self::Photons(map) => (TypeId::of::<PhotonMap>(), map.bytes()),
            Self::Vertices(map) => (TypeId::of::<LightVertexMap>(), map.bytes()),
        };
        for table in tables.iter_mut().filter(|table| table.id == id) {
            let map = self.clone();
            table.bytes = bytes;
            table.insert = Box::new(move |world| map.insert(world));
        }
    }
}

impl SamplePass {
    /// The pass, where the plan has one.
    pub fn of(scene: &Census<'_>, plan: &Plan, workers: usize) -> Result<Option<Self>, SceneError> {
        let image = scene.table::<ImageFrame>()?;
        let tracing = scene.table::<LightTracingTable>()?;
        let kind = if let Some(pass) = LightPass::of(scene, plan, workers)? {
            let first_radius = if tracing.radius > 0.0 { OnceLock::from(tracing.radius) } else { OnceLock::new() };
            SampleKind::Photons { pass, pixel: pixel_width(scene)?, first_radius }
        } else if let Some(pass) = LightPass::of(scene, plan, workers)? {
            SampleKind::Vertices { pass, size: [image.width, image.height] }
        } else {
            return Ok(None);
        };
        Ok(Some(Self { kind, batches: (tracing.each_sample / f64::from(LIGHT_PATHS)) as u64 }))
    }

    /// What the light paths of a sample become; none if they were abandoned.
    ///
    /// Where they add to the film by themselves, they do so here, unless the film has them already.
    pub fn map(
        &self,
        sample: u32,
        film: Option<&mut FilmSplats>,
        means: &Means<'_>,
        watch: &dyn Watch,
    ) -> Option<SampleMap> {
        match &self.kind {
            SampleKind::Photons { pass, pixel, first_radius } => {
                let map = self.photon_map(sample, (pass, *pixel, first_radius), means, watch)?;
                Some(SampleMap::Photons(Arc::new(map)))
            }
            SampleKind::Vertices { pass, size } => {
                let lists = self.lists(pass, sample, means, watch)?;
                let paths = u64::from(LIGHT_PATHS);
                if let Some(film) = film.filter(|film| film.paths == u64::from(sample) * self.batches * paths) {
                    lists.iter().for_each(|list| add_splats(film, &pass.filter, &list.splats));
                    film.paths += self.batches * paths;
                }
                let vertices: Vec<&LightVertices> = lists.iter().map(|list| &list.vertices).collect();
                let map = LightVertexMap::new(&vertices, LIGHT_PATHS, *size, means.pool);
                pass.take_back(lists);
                Some(SampleMap::Vertices(Arc::new(map)))
            }
        }
    }

    // ANCHOR: photon_map_of_a_sample
    /// The photons of a sample; none if they were abandoned.
    fn photon_map(
        &self,
        sample: u32,
        (pass, pixel, radius): (&LightPass<Photons>, [f64; 2], &OnceLock<f64>),
        means: &Means<'_>,
        watch: &dyn Watch,
    ) -> Option<PhotonMap> {
        let own = self.photons(pass, sample, means, watch)?;
        let first = match radius.get() {
            Some(&radius) => radius,
            None if sample == 0 => *radius.get_or_init(|| first_radius(&own, pixel)),
            None => {
                let of_first = self.photons(pass, 0, means, watch)?;
                *radius.get_or_init(|| first_radius(&of_first, pixel))
            }
        };
        Some(PhotonMap::new(&own, photon_radius(first, sample)))
    }
    // ANCHOR_END: photon_map_of_a_sample

    fn photons(
        &self,
        pass: &LightPass<Photons>,
        sample: u32,
        means: &Means<'_>,
        watch: &dyn Watch,
    ) -> Option<Vec<Photon>> {
        let each = 1.0 / (self.batches * u64::from(LIGHT_PATHS)) as f64;
        let mut found = Vec::new();
        for list in self.lists(pass, sample, means, watch)? {
            found.extend((0..list.rows()).map(|row| Photon {
                position: list.position(row),
                to_light: list.to_light(row),
                power: list.power(row).each(|part| (part * each) as f32),
                segments: list.segments(row),
            }));
        }
        Some(found)
    }

    /// What the batches of a sample leave; none if they were abandoned.
    fn lists<C: Left>(&self, pass: &LightPass<C>, sample: u32, means: &Means<'_>, watch: &dyn Watch) -> Option<Vec<C>> {
        let (mut found, first) = (Vec::new(), u64::from(sample) * self.batches);
        while (found.len() as u64) < self.batches {
            let done = found.len() as u64;
            found.extend(pass.lists(first + done, self.batches - done, means, watch)?.1);
        }
        Some(found)
    }

    /// The bits of the first batch.
    pub fn first_bits(&self, means: &Means<'_>, watch: &dyn Watch) -> Vec<u64> {
        fn bits(places: &[Vec<f32>; 3], powers: &[Vec<f64>; 3]) -> Vec<u64> {
            let places = places.iter().flatten().map(|part| u64::from(part.to_bits()));
            places.chain(powers.iter().flatten().map(|part| part.to_bits())).collect()
        }
        match &self.kind {
            SampleKind::Photons { pass, .. } => {
                let lists = pass.lists(0, 1, means, watch).map_or_else(Vec::new, |(_, lists)| lists);
                lists.iter().flat_map(|list| bits(&list.position, &list.power)).collect()
            }
            SampleKind::Vertices { pass, .. } => {
                let lists = pass.lists(0, 1, means, watch).map_or_else(Vec::new, |(_, lists)| lists);
                lists.iter().flat_map(|list| bits(&list.vertices.position, &list.vertices.power)).collect()
            }
        }
    }

    /// The laps of each worker so far.
    pub fn laps(&self) -> Vec<Vec<Lap>> {
        match &self.kind {
            SampleKind::Photons { pass, .. } => pass.laps().collect(),
            SampleKind::Vertices { pass, .. } => pass.laps().collect(),
        }
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
    let sampling = scene.table::<SamplingTable>()?.for_light_paths(plan.keeps::<LightVertices>());
    let mut made = RenderWorld::of_pass(RowKind::LightPath, plan, tables, 1, hooks);
    made.world.insert_resource(Shared::new(sampling));
    let before = thread_time();
    made.stop_at(Stop::at_deadline(Instant::now() + patience));
    if plan.keeps::<Photons>() {
        run_batch(&mut made, (0, None), &mut Photons::default());
    } else if plan.keeps::<LightVertices>() {
        run_batch(&mut made, (0, None), &mut VerticesAndSplats::default());
    } else {
        run_batch(&mut made, (0, None), &mut Splats::default());
    }
    look(&mut made.world, before.and_then(|before| Some(thread_time()?.saturating_sub(before))));
    Ok(true)
}

/// Runs a batch of light paths and moves what they leave to `list`, which is empty; returns whether the run was completed.
///
/// Paths that pixels are joined to are numbered by sample, as those of the pixels are: the same pixel's paths, one sample
/// after another, are points of one sequence. Otherwise all batches are, one after another.
fn run_batch<C: Left>(world: &mut RenderWorld, (batch, joined): (u64, Option<u64>), list: &mut C) -> bool {
    let (sample, place_in_sample) = joined.map_or((batch, batch >> 32), |each| (batch / each, batch % each));
    let tile = world.tiles[0];
    let mut entity = world.world.entity_mut(tile);
    if let Some(mut place) = entity.get_mut::<Tile>() {
        // The random numbers of a light path are a function of its row and its batch alone.
        *place = Tile { x: 0, y: place_in_sample as u32, width: LIGHT_PATHS, height: 1 };
    }
    if let Some(mut number) = entity.get_mut::<SampleNumber>() {
        *number = SampleNumber(sample as u32);
    }
    let whole = world.run();
    list.swap(&mut world.world.entity_mut(tile));
    whole
}
