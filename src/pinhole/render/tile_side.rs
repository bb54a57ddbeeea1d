use crate::extract::shape_entities;
use crate::plan::{ColumnKind, Plan};
use crate::shade::{LightPdfs, LightRays, ShadowHits, point_evidence};
use bevy_ecs::prelude::*;

/// The most bytes that the rays to lights take in a worker's tile, before the lists' own spare room.
const MOST_BYTES: f64 = (16_u32 << 20) as f64;
/// The most pairs of a ray and a shape that a stage of a tile tests: some tenths of a second, since between two stages
/// nobody looks whether to stop.
const MOST_TESTS: f64 = (1_u32 << 28) as f64;
/// A tile of one pixel would take more memory for the film around it than it saves in its columns.
const LEAST: u32 = 2;

/// The side of a full tile: at most this, and less where many lights or shapes would make its columns large or its stages
/// slow.
///
/// From every pixel a ray goes to each light without an area, and all of a tile's are held at once.
/// No bit of a picture depends on the side.
pub(super) fn tile_side(scene: &World, plan: &Plan, most: u32) -> u32 {
    let of_light =
        |column: &&ColumnKind| column.is::<LightRays>() || column.is::<LightPdfs>() || column.is::<ShadowHits>();
    let columns = plan.columns.iter().filter(of_light);
    let bytes: usize = columns.map(|column| column.bytes_a_row()).sum();
    let lights = if bytes > 0 { point_evidence(scene).count.max(1) } else { 1 } as f64;
    let shapes = shape_entities(scene).len().max(1) as f64;
    let mut side = most;
    while side > LEAST {
        let rays = f64::from(side) * f64::from(side) * lights;
        if rays * bytes as f64 <= MOST_BYTES && rays * shapes <= MOST_TESTS {
            break;
        }
        side = (side / 2).max(LEAST);
    }
    side
}
