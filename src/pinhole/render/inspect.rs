use super::Execution;
use super::in_progress::{film_for, shares};
use super::render_world::{Hook, RenderWorld, prepare};
use super::steps::Run;
use super::tile_side::tile_side;
use crate::Result;
use crate::extract::ImageFrame;
use crate::film::{Film, FilmTile};
use crate::follow::Stop;
use crate::plan::{Census, ExtractedTable, Plan, Stage, TileSystems};
use crate::rays::Tile;
use bevy_ecs::prelude::*;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// A frame whose every column is still there to be read.
pub struct Inspection {
    /// What ran and what did not.
    pub plan: Plan,
    /// The world that holds all tiles.
    pub world: World,
    /// The entities that hold columns, left to right, then down.
    pub tiles: Vec<Entity>,
    /// The image's shape.
    pub image: ImageFrame,
    /// How long the stages ran.
    pub time: Duration,
}

/// Runs the kept stages over the whole frame in one world and keeps that world.
pub fn inspect(scene: &World, offer: &[Stage], tile_side: u32) -> Result<Inspection> {
    inspect_stages(scene, offer, tile_side, &[])
}

/// The same; hooks follow each stage, and see what it wrote before a later one writes over it.
pub fn inspect_stages(scene: &World, offer: &[Stage], tile_side: u32, hooks: &[Hook]) -> Result<Inspection> {
    let scene = &Census::of(scene);
    let image = *scene.table::<ImageFrame>()?;
    let film = Film::new(image.width, image.height, tile_side);
    inspect_film(scene, offer, image, film, Run::FIRST, hooks)
}

/// The same stages, of which those that step on and follow do nothing: what the first leg of light's way wrote stays to be
/// looked at.
pub fn first_bounce_only(offer: &[Stage]) -> Vec<Stage> {
    let mut offer = offer.to_vec();
    for stage in offer.iter_mut().filter(|stage| matches!(stage.set, TileSystems::Step | TileSystems::RemainingBounces))
    {
        stage.system = Arc::new(|| (|| {}).into_configs());
    }
    offer
}

/// Runs the kept stages over one pixel, for one of its samples; hooks follow each stage.
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

/// A film of nothing but one tile.
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

/// Runs the kept stages over pieces of the frame, one after another in one small world, for the first sample of each of
/// their pixels; hooks follow each stage.
///
/// After each piece `look` is shown the world and told how long it took; none where it was given up.
/// All of them together take no longer than `patience`, and one of them no longer than a part of what is left of that: so
/// a piece whose paths do not end leaves time for others.
pub fn look_at_pieces(
    scene: &Census<'_>,
    (plan, tables): (&Plan, &[ExtractedTable]),
    pieces: &[Tile],
    patience: Duration,
    hooks: &[Hook],
    look: &mut dyn FnMut(&mut World, Option<Duration>),
) {
    const PART: u32 = 4;
    const TOO_SHORT: Duration = Duration::from_millis(2);
    let end = Instant::now() + patience;
    let mut frame = RenderWorld::new(plan, tables, 1, &Execution::default(), hooks);
    for &piece in pieces {
        let started = Instant::now();
        let left = end.saturating_duration_since(started);
        if left < TOO_SHORT {
            return;
        }
        let mut film = film_for(scene, plan, film_of(piece));
        let tile = frame.tiles[0];
        shares(&mut film).for_each(|mut share| frame.swap_share(tile, &mut share));
        frame.activate(tile, &Run::FIRST, None);
        frame.stop_at(Stop::at_deadline(started + left / PART));
        let whole = frame.run();
        look(&mut frame.world, whole.then(|| started.elapsed()));
    }
}

/// The side of a full tile of a render that is executed as usual.
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
    let mut frame = RenderWorld::new(&plan, &tables, film.tiles.len(), &Execution::default(), hooks);
    for (tile, mut share) in frame.tiles.clone().into_iter().zip(shares(&mut film)) {
        frame.swap_share(tile, &mut share);
    }
    for tile in frame.tiles.clone() {
        frame.activate(tile, &run, None);
    }
    let started = Instant::now();
    frame.run();
    Ok(Inspection { plan, time: started.elapsed(), world: frame.world, tiles: frame.tiles, image })
}
