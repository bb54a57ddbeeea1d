use super::Execution;
use super::render_world::{Hook, RenderWorld, prepare};
use super::steps::Run;
use super::under_way::{film_for, shares};
use crate::Result;
use crate::extract::ImageShape;
use crate::film::{Film, FilmTile};
use crate::plan::{Plan, Stage, Table, TileSystems};
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
    pub image: ImageShape,
    /// How long the stages ran.
    pub time: Duration,
}

/// Runs the kept stages over the whole frame in one world and keeps that world.
pub fn inspect(scene: &World, offer: &[Stage], tile_side: u32) -> Result<Inspection> {
    inspect_stages(scene, offer, tile_side, &[])
}

/// The same; hooks follow each stage, and see what it wrote before a later one writes over it.
pub fn inspect_stages(scene: &World, offer: &[Stage], tile_side: u32, hooks: &[Hook]) -> Result<Inspection> {
    let image = ImageShape::extract(scene)?;
    let film = Film::new(image.width, image.height, tile_side);
    inspect_film(scene, offer, image, film, Run::FIRST, hooks)
}

/// The same stages, of which those that step on and follow do nothing: what the first leg of light's way wrote stays to be
/// looked at.
pub fn first_leg_only(offer: &[Stage]) -> Vec<Stage> {
    let mut offer = offer.to_vec();
    for stage in offer.iter_mut().filter(|stage| matches!(stage.set, TileSystems::Step | TileSystems::Follow)) {
        stage.system = Arc::new(|| (|| {}).into_configs());
    }
    offer
}

/// Runs the kept stages over the one tile that holds a pixel, for one of its samples; hooks follow each stage.
pub fn inspect_tile(
    scene: &World,
    offer: &[Stage],
    pixel: [u32; 2],
    sample: u32,
    hooks: &[Hook],
) -> Result<Inspection> {
    let image = ImageShape::extract(scene)?;
    let side = Execution::default().tile_side;
    let [x, y] = pixel.map(|along| along / side * side);
    let tile = Tile { x, y, width: side.min(image.width - x), height: side.min(image.height - y) };
    inspect_tiles(scene, offer, vec![tile], sample, hooks)
}

/// Runs the kept stages over some pieces of the frame, for one sample of each of their pixels; hooks follow each stage.
pub fn inspect_tiles(
    scene: &World,
    offer: &[Stage],
    tiles: Vec<Tile>,
    sample: u32,
    hooks: &[Hook],
) -> Result<Inspection> {
    let image = ImageShape::extract(scene)?;
    let film = Film {
        width: image.width,
        height: image.height,
        tile_side: Execution::default().tile_side,
        done: vec![0; tiles.len()],
        tiles: tiles.into_iter().map(FilmTile::new).collect(),
        ..Film::default()
    };
    inspect_film(scene, offer, image, film, Run::of_all(sample), hooks)
}

fn inspect_film(
    scene: &World,
    offer: &[Stage],
    image: ImageShape,
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
