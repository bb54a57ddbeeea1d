use super::Execution;
use super::clock::thread_time;
use super::execution::tile_side;
use super::in_progress::{film_for, film_parts};
use super::light_pass::{Means, SamplePass};
use super::render_world::{Hook, RenderWorld, prepare};
use super::steps::Run;
use crate::Result;
use crate::extract::ImageFrame;
use crate::film::{Film, FilmTile};
use crate::follow::Stop;
use crate::plan::{Census, ExtractedTable, Plan, Stage, TileSystems};
use crate::rays::Tile;
use bevy_ecs::prelude::*;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// A rendered image with every column kept for reading.
pub struct Inspection {
    /// The stages that ran, and those that did not.
    pub plan: Plan,
    /// The world that holds all tiles.
    pub world: World,
    /// The entities of the tiles, which hold the columns, from left to right and top to bottom.
    pub tiles: Vec<Entity>,
    /// The image's resolution and aspect ratio.
    pub image: ImageFrame,
    /// How long the stages ran.
    pub time: Duration,
}

/// Runs the kept stages over the whole image in one world and returns that world.
pub fn inspect(scene: &World, offer: &[Stage], tile_side: u32) -> Result<Inspection> {
    inspect_stages(scene, offer, tile_side, &[])
}

/// The same with hooks, which follow each stage and see what it wrote before a later stage overwrites it.
pub fn inspect_stages(scene: &World, offer: &[Stage], tile_side: u32, hooks: &[Hook]) -> Result<Inspection> {
    let scene = &Census::of(scene);
    let image = *scene.table::<ImageFrame>()?;
    let film = Film::new(image.width, image.height, tile_side);
    inspect_film(scene, offer, image, film, Run::FIRST, hooks)
}

/// The same stages, except that those which advance to the next bounce and trace the remaining ones do nothing, so that
/// the columns of the first bounce remain to be read.
pub fn first_bounce_only(offer: &[Stage]) -> Vec<Stage> {
    let mut offer = offer.to_vec();
    for stage in offer.iter_mut().filter(|stage| matches!(stage.set, TileSystems::Step | TileSystems::RemainingBounces))
    {
        stage.system = Arc::new(|| (|| {}).into_configs());
    }
    offer
}

/// Runs the kept stages on one pixel, for one of its samples; hooks follow each stage.
///
/// The pixel is a tile by itself, since nothing that a stage writes for it depends on its neighbours.
pub fn inspect_pixel(
    scene: &Census<'_>,
    offer: &[Stage],
    [x, y]: [u32; 2],
    sample: u32,
    hooks: &[Hook],
) -> Result<Inspection> {
    let image = *scene.table::<ImageFrame>()?;
    let film = film_of(Tile { x, y, width: 1, height: 1 });
    inspect_film(scene, offer, image, film, Run::of_all(sample), hooks)
}

/// A film of a single tile.
fn film_of(tile: Tile) -> Film {
    Film {
        width: tile.width,
        height: tile.height,
        tile_side: tile.width.max(tile.height),
        done: vec![0],
        tiles: vec![FilmTile::new(tile)],
        ..Film::default()
    }
}

/// Runs the kept stages on small tiles of the image, one after another in one small world, for the first sample of each
/// of their pixels; hooks follow each stage.
///
/// After each tile `look` gets the world and how the run went, and says whether to go on: with the next tile, after the
/// last one with the next sample of the first, and again with the first sample where the camera takes no more.
/// All tiles together take no longer than `patience`, and each at most a fraction of the time that is left, so that a
/// tile whose paths do not end leaves time for others.
pub fn probe_tiles(
    scene: &Census<'_>,
    (plan, tables): (&Plan, &[ExtractedTable]),
    (tiles, samples): (&[Tile], u32),
    patience: Duration,
    hooks: &[Hook],
    look: &mut dyn FnMut(&mut World, ProbeRun) -> bool,
) {
    const FRACTION: u32 = 4;
    const TOO_SHORT: Duration = Duration::from_millis(2);
    let end = Instant::now() + patience;
    let mut frame = RenderWorld::new(plan, tables, 1, hooks);
    let all = (0..samples.max(1)).cycle().flat_map(|sample| tiles.iter().map(move |&tile| (tile, sample)));
    for (place, sample) in all {
        let (started, before) = (Instant::now(), thread_time());
        let left = end.saturating_duration_since(started);
        if left < TOO_SHORT {
            return;
        }
        let mut film = film_for(scene, plan, film_of(place));
        let tile = frame.tiles[0];
        film_parts(&mut film).for_each(|mut part| frame.swap_part(tile, &mut part));
        frame.activate(tile, &Run::of_all(sample), None);
        frame.stop_at(Stop::at_deadline(started + left / FRACTION));
        let whole = frame.run();
        let time = before.and_then(|before| Some(thread_time()?.saturating_sub(before)));
        if !look(&mut frame.world, ProbeRun { whole, time }) {
            return;
        }
    }
}

/// How a run over a small tile went.
#[derive(Clone, Copy, Debug)]
pub struct ProbeRun {
    /// Whether it was completed; if not, it was given up.
    pub whole: bool,
    /// The processor time that it took, which does not depend on what else the machine does; none where it is not known.
    pub time: Option<Duration>,
}

/// The side of a full tile, in pixels, with the default execution.
pub fn usual_tile_side(scene: &Census<'_>, plan: &Plan) -> u32 {
    tile_side(scene, plan, Execution::default().tile_side)
}

fn inspect_film(
    scene: &Census<'_>,
    offer: &[Stage],
    image: ImageFrame,
    film: Film,
    run: Run,
    hooks: &[Hook],
) -> Result<Inspection> {
    let (plan, tables) = prepare(scene, offer)?;
    let mut film = film_for(scene, &plan, film);
    let mut frame = RenderWorld::new(&plan, &tables, film.tiles.len(), hooks);
    for (tile, mut part) in frame.tiles.clone().into_iter().zip(film_parts(&mut film)) {
        frame.swap_part(tile, &mut part);
    }
    for tile in frame.tiles.clone() {
        frame.activate(tile, &run, None);
    }
    let started = Instant::now();
    if let Some(pass) = SamplePass::of(scene, &plan, 1)?
        && let Some(map) = pass.map(run.sample, None, &Means { plan: &plan, tables: &tables, pool: None }, &())
    {
        map.insert(&mut frame.world);
    }
    frame.run();
    Ok(Inspection { plan, time: started.elapsed(), world: frame.world, tiles: frame.tiles, image })
}
