use crate::Result;
use crate::extract::ImageFrame;
use crate::follow::LIGHT_PATHS;
use crate::intersect::{Hits, NO_SHAPE};
use crate::plan::{Census, Column, ColumnKind, ExtractedTable, Plan, Stage};
use crate::rays::{Depth, Tile};
use crate::render::{Hook, probe_light_paths, probe_tiles, usual_tile_side};
use crate::shade::{LightRays, Radiance, ShadowHits};
use bevy_ecs::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// The greatest number of small tiles along each axis of the image, and the side of each in pixels.
const TILES: [u32; 2] = [12, 8];
const SIDE: u32 = 8;
/// Half of the smallest step of an 8-bit PNG near black, as radiance.
const DARK: f32 = 1.5e-4;
/// After this many bounces few rays are left, and they say little about what is wrong with a scene.
const MAX_DEPTH: u32 = 4;

/// What a few rays, traced before a picture is rendered, hit and returned.
#[derive(Clone, Debug, Default)]
pub struct Pilot {
    /// Camera rays in tiles that were finished; all fields but the last seven refer to these.
    pub rays: usize,
    /// Camera rays that hit a shape.
    pub hits: usize,
    /// Camera rays that returned no light that a PNG would show.
    pub black: usize,
    /// Camera rays whose radiance is above white in each of red, green and blue.
    pub beyond_white: usize,
    /// Shadow rays, traced during the first bounces.
    pub to_lights: usize,
    /// How many shadow rays each shape blocks, by the shape's number.
    pub blocked: BTreeMap<u32, usize>,
    /// Average cost of a camera ray with all the rays that follow from it, in seconds of one thread; a lower bound
    /// where tiles were given up.
    pub seconds_a_ray: f64,
    /// How many rays follow a camera ray on average, shadow rays not counted.
    pub followed_by: f64,
    /// Camera rays, including those in tiles that were given up.
    pub tried: usize,
    /// The greatest number of bounces that a path had made when its tile was given up.
    pub deepest: u32,
    /// Small tiles of the image that were to be traced.
    pub tiles: usize,
    /// Average cost of a light path in seconds of one thread, a lower bound where they were given up; 0 without light
    /// tracing.
    pub seconds_a_light_path: f64,
    /// How many segments a light path has on average beyond its first.
    pub light_followed_by: f64,
}

/// What a hook has counted in one tile so far.
#[derive(Resource, Clone, Debug, Default)]
struct Counted {
    hits: usize,
    /// Shadow rays at each bounce.
    to_lights: BTreeMap<u32, usize>,
    /// At each bounce, how many shadow rays each shape blocks.
    blocked: BTreeMap<u32, BTreeMap<u32, usize>>,
    /// The current bounce, counted from 0, and its number of rays.
    bounce: (u32, usize),
    /// The number of rays of all earlier bounces.
    before: usize,
}

/// Traces one sample per pixel of some small tiles, spread evenly over the image, until all are done or the time is up;
/// then a batch of light paths, where the plan has any, in a quarter of the time.
///
/// Errors: a camera without a valid resolution.
pub fn pilot(scene: &Census<'_>, prepared: (&Plan, &[ExtractedTable]), patience: Duration) -> Result<Pilot> {
    let image = *scene.table::<ImageFrame>()?;
    let side = SIDE.min(usual_tile_side(scene, prepared.0));
    let small_tiles = small_tiles(image, side);
    let mut pilot = Pilot { tiles: small_tiles.len(), ..Pilot::default() };
    let (mut time, mut all, started) = (0.0, 0, Instant::now());
    probe_tiles(scene, prepared, &small_tiles, patience, &[counting_hook()], &mut |world, took| {
        let counted = world.remove_resource::<Counted>().unwrap_or_default();
        let mut tiles = world.query::<(&Tile, Option<&Radiance>)>();
        let Ok((tile, radiance)) = tiles.single(world) else { return };
        let rays = tile.rows();
        all += counted.before + counted.bounce.1;
        pilot.tried += rays;
        match took {
            Some(took) => time += took.as_secs_f64(),
            None => return pilot.deepest = pilot.deepest.max(counted.bounce.0),
        }
        pilot.rays += rays;
        pilot.hits += counted.hits;
        pilot.to_lights += counted.to_lights.values().sum::<usize>();
        for (shape, count) in counted.blocked.into_values().flatten() {
            *pilot.blocked.entry(shape).or_default() += count;
        }
        // Where no light is in the scene, the column is missing or has no rows.
        let Some(radiance) = radiance.filter(|radiance| radiance.rows() == rays) else {
            pilot.black += rays;
            return;
        };
        let (r, g, b) = radiance.slices();
        pilot.black += (0..radiance.rows()).filter(|&row| r[row].max(g[row]).max(b[row]) < DARK).count();
        pilot.beyond_white += (0..radiance.rows()).filter(|&row| r[row].min(g[row]).min(b[row]) > 1.0).count();
    });
    if pilot.rays < pilot.tried {
        time = started.elapsed().as_secs_f64();
    }
    pilot.seconds_a_ray = time / pilot.tried.max(1) as f64;
    pilot.followed_by = (all as f64 / pilot.tried.max(1) as f64 - 1.0).max(0.0);
    probe_light_paths(scene, prepared, patience / 4, &[counting_hook()], &mut |world, took| {
        let counted = world.remove_resource::<Counted>().unwrap_or_default();
        let segments = (counted.before + counted.bounce.1) as f64;
        pilot.seconds_a_light_path = took.as_secs_f64() / f64::from(LIGHT_PATHS);
        pilot.light_followed_by = (segments / f64::from(LIGHT_PATHS) - 1.0).max(0.0);
    })?;
    Ok(pilot)
}

/// Small tiles, each in the middle of its part of the image, or the whole of a small image; ordered such that any first
/// few are spread evenly.
fn small_tiles(image: ImageFrame, side: u32) -> Vec<Tile> {
    let along = |pixels: u32, most: u32| -> Vec<[u32; 2]> {
        let count = (pixels / SIDE).clamp(1, most);
        let side = side.min(pixels);
        (0..count).map(|tile| [((2 * tile + 1) * pixels / (2 * count)).saturating_sub(side / 2), side]).collect()
    };
    let (columns, lines) = (along(image.width, TILES[0]), along(image.height, TILES[1]));
    let mut tiles = Vec::new();
    for (line, &[y, height]) in lines.iter().enumerate() {
        for (column, &[x, width]) in columns.iter().enumerate() {
            let turn = turn([256 * column / columns.len(), 256 * line / lines.len()]);
            tiles.push((turn, Tile { x, y, width, height }));
        }
    }
    tiles.sort_by_key(|(turn, _)| *turn);
    tiles.into_iter().map(|(_, tile)| tile).collect()
}

/// The rank of a position given in 256ths along each axis, so that halves come before quarters (bits interleaved and
/// reversed).
fn turn([x, y]: [usize; 2]) -> usize {
    (0..8).map(|bit| (x >> (7 - bit) & 1 | (y >> (7 - bit) & 1) << 1) << (2 * bit)).sum()
}

/// Counts what camera rays hit and, during the first bounces, which shapes block shadow rays.
///
/// Several stages write each of the two columns, so the last count of a bounce is the final one.
fn counting_hook() -> Hook {
    Arc::new(|_, stage: &Stage, _| {
        let [writes_hits, writes_shadows] =
            [ColumnKind::of::<Hits>(), ColumnKind::of::<ShadowHits>()].map(|column| stage.writes.contains(&column));
        let count = move |world: &mut World,
                          tiles: &mut QueryState<
            (&Depth, Option<&Hits>, Option<(&LightRays, &ShadowHits)>),
            With<Tile>,
        >| {
            if !(writes_hits || writes_shadows) {
                return;
            }
            let mut counted = world.remove_resource::<Counted>().unwrap_or_default();
            let (mut hits, mut rows, mut to_lights, mut blocked) = (0, 0, 0, BTreeMap::new());
            let mut depth = 0;
            for (own, hit, light) in tiles.iter(world) {
                depth = own.0;
                if let Some(hit) = hit {
                    rows += hit.rows();
                    hits += hit.shape.iter().filter(|&&shape| shape != NO_SHAPE).count();
                }
                if let Some((rays, shadows)) = light {
                    to_lights += rays.rows();
                    for &shape in shadows.shape.iter().filter(|&&shape| shape != NO_SHAPE) {
                        *blocked.entry(shape).or_default() += 1;
                    }
                }
            }
            if writes_hits && depth == 0 {
                counted.hits = hits;
            }
            if writes_hits {
                if counted.bounce.0 != depth {
                    counted.before += counted.bounce.1;
                }
                counted.bounce = (depth, rows);
            }
            if writes_shadows && depth < MAX_DEPTH {
                counted.to_lights.insert(depth, to_lights);
                counted.blocked.insert(depth, blocked);
            }
            world.insert_resource(counted);
        };
        count.into_configs()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// Every tile is traced once, and the first few of them lie in all quarters of the image.
    #[test]
    fn tiles_are_spread_evenly_from_the_first_on() {
        let image = ImageFrame { width: 960, height: 540 };
        let tiles = small_tiles(image, SIDE);
        let all: BTreeSet<_> = tiles.iter().map(|tile| (tile.x, tile.y)).collect();
        assert_eq!((tiles.len(), all.len()), (96, 96));
        for (parts, tried) in [(2, 4), (4, 24)] {
            let part = |tile: &Tile| (tile.x * parts / 960, tile.y * parts / 540);
            let seen: BTreeSet<_> = tiles[..tried].iter().map(part).collect();
            assert_eq!(seen.len(), (parts * parts) as usize, "{:?}", &tiles[..tried]);
        }
    }
}
