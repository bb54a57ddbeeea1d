use crate::Result;
use crate::extract::ImageShape;
use crate::intersect::{Hits, NO_SHAPE};
use crate::plan::{Column, Stage, Table};
use crate::rays::{Leg, Tile};
use crate::render::{Hook, inspect_tiles};
use crate::shade::{LightRays, Radiance, ShadowHits};
use bevy_ecs::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The most pieces of the picture along each axis, and the pixels along a side of each.
const PIECES: [u32; 2] = [12, 8];
const SIDE: u32 = 8;
/// Half of the smallest step of a PNG near black.
const DARK: f32 = 1.5e-4;
/// On later legs fewer and fewer rays are left, and they say less and less of what is wrong.
const LEGS: u32 = 4;

/// What a few rays of the picture to come have met and brought back.
#[derive(Clone, Debug, Default)]
pub struct Pilot {
    /// Rays from the camera.
    pub rays: usize,
    /// Those that met a shape.
    pub met: usize,
    /// Those that brought back no light that a PNG would show.
    pub black: usize,
    /// Those that brought back more than white in all of red, green and blue.
    pub beyond_white: usize,
    /// Rays to lights, on the first legs.
    pub to_lights: usize,
    /// How many of them each shape is in the way of, by its number.
    pub blocked: BTreeMap<u32, usize>,
    /// What a ray took on average with all that followed from it, in seconds of one thread.
    pub seconds_a_ray: f64,
}

/// What a hook has counted so far.
#[derive(Resource, Clone, Debug, Default)]
struct Counted {
    met: usize,
    /// Rays to lights on each leg.
    to_lights: BTreeMap<u32, usize>,
    /// What is in their way.
    blocked: BTreeMap<u32, BTreeMap<u32, usize>>,
}

/// Traces one sample of each pixel of some small pieces of the picture, evenly spread over it.
///
/// Errors: what the render would be refused for.
pub fn pilot(scene: &World, offer: &[Stage]) -> Result<Pilot> {
    let image = ImageShape::extract(scene)?;
    let inspection = &mut inspect_tiles(scene, offer, pieces(image), 0, &[counting_hook()])?;
    let counted = inspection.world.remove_resource::<Counted>().unwrap_or_default();
    let mut pilot = Pilot { met: counted.met, to_lights: counted.to_lights.values().sum(), ..Pilot::default() };
    for (shape, count) in counted.blocked.into_values().flatten() {
        *pilot.blocked.entry(shape).or_default() += count;
    }
    for &tile in &inspection.tiles {
        let rays = inspection.world.get::<Tile>(tile).map_or(0, Tile::rows);
        pilot.rays += rays;
        // Where nothing in the scene brings light, there is no such column, or it has no rows.
        let Some(radiance) = inspection.world.get::<Radiance>(tile).filter(|radiance| radiance.rows() == rays) else {
            pilot.black += rays;
            continue;
        };
        let (r, g, b) = radiance.slices();
        pilot.black += (0..radiance.rows()).filter(|&row| r[row].max(g[row]).max(b[row]) < DARK).count();
        pilot.beyond_white += (0..radiance.rows()).filter(|&row| r[row].min(g[row]).min(b[row]) > 1.0).count();
    }
    pilot.seconds_a_ray = inspection.time.as_secs_f64() / pilot.rays.max(1) as f64;
    Ok(pilot)
}

/// The pieces: each in the middle of its share of the picture, and all of a small one.
fn pieces(image: ImageShape) -> Vec<Tile> {
    let along = |pixels: u32, most: u32| -> Vec<[u32; 2]> {
        let count = (pixels / SIDE).clamp(1, most);
        let side = SIDE.min(pixels);
        (0..count).map(|piece| [((2 * piece + 1) * pixels / (2 * count)).saturating_sub(side / 2), side]).collect()
    };
    let columns = along(image.width, PIECES[0]);
    let piece = |[y, height]: [u32; 2]| columns.iter().map(move |&[x, width]| Tile { x, y, width, height });
    along(image.height, PIECES[1]).into_iter().flat_map(piece).collect()
}

/// Counts what the camera's rays have met, and on the first legs which rays to lights are blocked.
///
/// Several stages write each of the two columns, so the last count of a leg is the one that counts.
fn counting_hook() -> Hook {
    Arc::new(|_, stage: &Stage, _| {
        let [hits, shadows] =
            [Hits::NAME, ShadowHits::NAME].map(|name| stage.writes.iter().any(|column| column.name == name));
        let count = move |world: &mut World,
                          tiles: &mut QueryState<
            (&Leg, Option<&Hits>, Option<(&LightRays, &ShadowHits)>),
            With<Tile>,
        >| {
            if !(hits || shadows) {
                return;
            }
            let mut counted = world.remove_resource::<Counted>().unwrap_or_default();
            let (mut met, mut to_lights, mut blocked) = (0, 0, BTreeMap::new());
            let mut leg = 0;
            for (own, hit, light) in tiles.iter(world) {
                leg = own.0;
                if let Some(hit) = hit {
                    met += hit.shape.iter().filter(|&&shape| shape != NO_SHAPE).count();
                }
                if let Some((rays, shadows)) = light {
                    to_lights += rays.rows();
                    for &shape in shadows.shape.iter().filter(|&&shape| shape != NO_SHAPE) {
                        *blocked.entry(shape).or_default() += 1;
                    }
                }
            }
            if hits && leg == 0 {
                counted.met = met;
            }
            if shadows && leg < LEGS {
                counted.to_lights.insert(leg, to_lights);
                counted.blocked.insert(leg, blocked);
            }
            world.insert_resource(counted);
        };
        count.into_configs()
    })
}
