//! A frame of a sweep: every pixel's ray, hit and light, and how two frames differ.

use crate::measure::film_bits::FilmBits;
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::Result;
use pinhole::extract::{ShapeTable, any_shapes};
use pinhole::film::FilmTile;
use pinhole::intersect::{Hits, NO_SHAPE};
use pinhole::plan::{Census, Stage, Table};
use pinhole::rays::{Tile, WorldRays};
use pinhole::render::{first_bounce_only, inspect};
use pinhole::shapes::{AnyShape, RayHit, ShapeKind};
use serde::Serialize;

/// The side of a tile.
const SIDE: u32 = 32;

/// What a pixel hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelHit {
    /// How far away; infinite where nothing is hit.
    pub t: f64,
    /// The shape's number.
    pub shape: u32,
    /// The cosine between ray and normal.
    pub cosine: f64,
}

/// A frame as its stages left it at the first bounce.
pub struct Frame {
    /// The film.
    pub film: FilmBits,
    /// Whether the film holds a view of a column, whose numbers have units.
    pub viewed: bool,
    /// What each pixel hit, tile by tile; empty where the scene has no shape or no stage looks for one.
    pub pixel_hits: Vec<PixelHit>,
    /// The directions of the rays along the middle line, left to right.
    pub middle: Vec<DVec3>,
}

impl Frame {
    /// Runs the stages over a scene, up to the first bounce.
    ///
    /// Errors: what a render would be refused for.
    pub fn of(scene: &World, offer: &[Stage]) -> Result<Self> {
        let frame = inspect(scene, &first_bounce_only(offer), SIDE)?;
        let tiles = || frame.tiles.iter().map(|&tile| frame.world.entity(tile));
        let (width, height) = (frame.image.width, frame.image.height);
        let shapes = Shapes { all: ShapeTable::extract(&Census::of(scene))?, body: any_shapes(&Census::of(scene))? };
        let film = FilmBits::of_tiles(width, height, tiles().filter_map(|tile| tile.get::<FilmTile>()));
        let pixel_hits = tiles().flat_map(|tile| pixel_hits(&tile, &shapes)).collect();
        let mut middle: Vec<(u32, DVec3)> = tiles().flat_map(|tile| on_line(&tile, height / 2)).collect();
        middle.sort_by_key(|&(x, _)| x);
        let middle = middle.into_iter().map(|(_, direction)| direction).collect();
        Ok(Self { film, viewed: frame.plan.view.is_some(), pixel_hits, middle })
    }
}

/// The shapes of a scene, for the normals where its stages ask for none.
struct Shapes {
    all: ShapeTable,
    body: Vec<AnyShape>,
}

fn pixel_hits(tile: &EntityRef<'_>, shapes: &Shapes) -> Vec<PixelHit> {
    let (Some(hits), Some(rays)) = (tile.get::<Hits>(), tile.get::<WorldRays>()) else { return Vec::new() };
    let cosine = |row: usize| match hits.shape[row] {
        NO_SHAPE => 1.0,
        shape => {
            let (origin, direction, t) = (rays.origin_of(row), rays.direction_of(row), hits.t[row]);
            let body = &shapes.body[shape as usize];
            let hit =
                RayHit { primitive: body.primitive_at(origin, direction, t), ..RayHit::at_rest(origin, direction, t) };
            // Where it was depends on each ray's time: no normal is compared.
            let moves = shapes.all.kind[shape as usize] == ShapeKind::Moving;
            if moves { 1.0 } else { body.surface(&hit).normal.dot(direction).abs() }
        }
    };
    (0..hits.t.len()).map(|row| PixelHit { t: hits.t[row], shape: hits.shape[row], cosine: cosine(row) }).collect()
}

fn on_line(tile: &EntityRef<'_>, line: u32) -> Vec<(u32, DVec3)> {
    let (Some(place), Some(rays)) = (tile.get::<Tile>(), tile.get::<WorldRays>()) else { return Vec::new() };
    let row = |x: u32| place.row_of(x, line).map(|row| (x, rays.direction_of(row)));
    (place.x..place.x + place.width).filter_map(row).collect()
}

/// How two frames of one scene differ.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Difference {
    /// Pixels that hit something in one of them.
    pub hits: usize,
    /// Pixels that hit another shape, or nothing any more.
    pub changed_hands: usize,
    /// Of the others: the most that the surface is farther or nearer, across itself and relative to its distance.
    ///
    /// Along a ray that grazes it, a surface's distance says little; across, cos θ |Δt|, no more than the ray's own error
    /// remains.
    #[serde(rename = "worst_relative_error")]
    pub worst: f64,
}

/// Compares what the pixels of two frames hit.
pub fn difference(one: &Frame, other: &Frame) -> Difference {
    let mut difference = Difference::default();
    for (one, other) in one.pixel_hits.iter().zip(&other.pixel_hits) {
        difference.hits += usize::from(one.shape != NO_SHAPE || other.shape != NO_SHAPE);
        if one.shape != other.shape {
            difference.changed_hands += 1;
        } else if one.shape != NO_SHAPE {
            let across = (one.t - other.t).abs() * one.cosine.max(other.cosine);
            difference.worst = difference.worst.max(across / one.t);
        }
    }
    difference
}
