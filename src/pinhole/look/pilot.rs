//! A few samples before a render, and what they foretell.

use super::preflight::{NEARLY_ALL, exposure_factor};
use crate::Result;
use crate::each::Each;
use crate::extract::{ImageFrame, MaterialTable, NO_ROW, SamplingTable, ShapeTable, exposure_of, specular_evidence};
use crate::follow::LIGHT_PATHS;
use crate::intersect::{Hits, NO_SHAPE};
use crate::plan::{Census, Column, ColumnKind, ExtractedTable, Plan, Stage};
use crate::rays::{Depth, Tile};
use crate::render::{Hook, ProbeRun, probe_light_paths, probe_tiles, usual_tile_side};
use crate::scene::ToneMapping;
use crate::shade::{Radiance, ShadowHits, ShadowRays};
use bevy_ecs::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::time::Duration;

/// The greatest number of small tiles along each axis of the image, and the side of each in pixels.
const TILES: [u32; 2] = [12, 8];
const SIDE: u32 = 8;
/// Half of the smallest step of an 8-bit PNG near black, as radiance.
pub(super) const DARK: f32 = 1.5e-4;
/// Every small tile is traced at most so many times.
const MAX_ROUNDS: usize = 16;

/// What a few rays, traced before a picture is rendered, hit and returned.
#[derive(Clone, Debug, Default)]
pub struct Pilot {
    /// Camera rays in tiles that were finished; all fields but the last eight refer to these.
    pub rays: usize,
    /// Camera rays that were intersected with shapes; where no light is in the scene, the plan may leave that out.
    pub intersected: usize,
    /// Camera rays that hit a shape.
    pub hits: usize,
    /// Camera rays whose first hit is on a mirror or on glass.
    pub specular_first: usize,
    /// Camera rays that returned no light that a PNG would show.
    pub black: usize,
    /// By how much the exposure multiplies light, here and in the picture.
    pub exposure: f64,
    /// Camera rays whose exposed light is clipped in each of red, green and blue.
    pub beyond_white: usize,
    /// Shadow rays, traced during the first bounces.
    pub to_lights: usize,
    /// How many shadow rays each shape blocks, by the shape's number.
    pub blocked: BTreeMap<u32, usize>,
    /// Rays beyond the first surface, and how many of them hit nothing.
    pub beyond: usize,
    /// How many of these hit nothing.
    pub escaped: usize,
    /// How many small tiles were finished at least once.
    pub seen_tiles: usize,
    /// The light of each small tile, in the order in which they are traced.
    pub light: Vec<TileLight>,
    /// The shapes that the rays of the last tile hit first.
    last_first: Vec<u32>,
    /// The numbers of shapes that camera rays hit first.
    pub shapes: BTreeSet<u32>,
    /// A pixel near the middle of the picture whose camera ray hits a shape and returns more light than most that do.
    pub lit_pixel: Option<[u32; 2]>,
    /// Average cost of a camera ray with all the rays that follow from it, in processor seconds of one thread; none where
    /// that is not known.
    pub seconds_a_ray: Option<f64>,
    /// Whether the cost is a lower bound, since tiles were given up.
    pub is_least: bool,
    /// How many rays follow a camera ray on average, shadow rays not counted.
    pub followed_by: f64,
    /// Camera rays, including those in tiles that were given up.
    pub tried: usize,
    /// The greatest number of bounces that a path had made when its tile was given up.
    pub deepest: u32,
    /// Small tiles of the image that were to be traced.
    pub tiles: usize,
    /// Average cost of a light path in processor seconds of one thread, a lower bound where they were given up; 0 without
    /// light tracing, none where it is not known.
    pub seconds_a_light_path: Option<f64>,
    /// How many segments a light path has on average beyond its first.
    pub light_followed_by: f64,
}

/// The light that came back along the rays of a small tile.
#[derive(Clone, Copy, Debug, Default)]
pub struct TileLight {
    /// Its rays.
    pub rays: usize,
    /// Those that returned light that a PNG would show.
    pub lit: usize,
    /// The sum of the greatest component of the exposed light of each.
    pub sum: f64,
}

/// Traces a sample per pixel of some small tiles, spread evenly over the image, and further samples where these do not
/// say enough, until that is done or the time is up; then a batch of light paths, where the plan has any, in a quarter of
/// the time.
///
/// Errors: a camera without a valid resolution, or whatever else the scene's tables are refused for.
pub fn pilot(scene: &Census<'_>, prepared: (&Plan, &[ExtractedTable]), patience: Duration) -> Result<Pilot> {
    let image = *scene.table::<ImageFrame>()?;
    let samples = scene.table::<SamplingTable>()?.samples;
    let side = SIDE.min(usual_tile_side(scene, prepared.0));
    let small_tiles = small_tiles(image, side);
    let tiles = small_tiles.len();
    let (exposure, tone_mapping) = exposure_of(scene)?;
    let clips = !exposure.automatic && tone_mapping == ToneMapping::None;
    let exposure = exposure_factor(exposure);
    let mut pilot = Pilot { tiles, exposure, light: vec![TileLight::default(); tiles], ..Pilot::default() };
    let is_specular = specular_shapes(scene)?;
    let (mut cost, mut all, mut runs) = (Cost::default(), 0, 0);
    let mut candidates = Vec::new();
    probe_tiles(scene, prepared, (&small_tiles, samples), patience, &[counting_hook()], &mut |world, run| {
        let counted = world.remove_resource::<Counted>().unwrap_or_default();
        let mut in_world = world.query::<(&Tile, Option<&Radiance>)>();
        let Ok((tile, radiance)) = in_world.single(world) else { return false };
        let (rays, number) = (tile.rows(), runs % tiles);
        runs += 1;
        all += counted.rays();
        pilot.tried += rays;
        cost.add(rays, run, runs == 1);
        if !run.whole {
            pilot.deepest = pilot.deepest.max(counted.bounces.keys().next_back().copied().unwrap_or(0));
            return runs < tiles;
        }
        pilot.seen_tiles += usize::from(pilot.light[number].rays == 0);
        pilot.count(counted, &is_specular, rays);
        let light = |row: usize| match radiance.filter(|radiance| radiance.rows() == rays) {
            // Where no light is in the scene, the column is missing or has no rows.
            None => [0.0; 3],
            Some(radiance) => {
                radiance.rgb(row).each(|part| (f64::from(part) * exposure).min(f64::from(f32::MAX)) as f32)
            }
        };
        for row in 0..rays {
            let [r, g, b] = light(row);
            let max = r.max(g).max(b);
            pilot.light[number].add(max);
            pilot.black += usize::from(!(max >= DARK));
            pilot.beyond_white += usize::from(clips && r.min(g).min(b) > 1.0);
            if runs <= tiles && pilot.last_first.get(row).is_some_and(|&shape| shape != NO_SHAPE) {
                candidates.push((tile.pixel_of(row), max));
            }
        }
        runs < tiles || !(pilot.is_settled(f64::from(samples)) && cost.is_known()) && runs < MAX_ROUNDS * tiles
    });
    pilot.lit_pixel = lit_pixel(candidates, image);
    pilot.is_least = pilot.rays < pilot.tried;
    pilot.seconds_a_ray = cost.of_a_ray(pilot.is_least);
    pilot.followed_by = (all as f64 / pilot.tried.max(1) as f64 - 1.0).max(0.0);
    pilot.seconds_a_light_path = Some(0.0);
    probe_light_paths(scene, prepared, patience / 4, &[counting_hook()], &mut |world, took| {
        let segments = world.remove_resource::<Counted>().unwrap_or_default().rays() as f64;
        pilot.seconds_a_light_path = took.map(|took| took.as_secs_f64() / f64::from(LIGHT_PATHS));
        pilot.light_followed_by = (segments / f64::from(LIGHT_PATHS) - 1.0).max(0.0);
    })?;
    Ok(pilot)
}

impl Pilot {
    fn count(&mut self, counted: Counted, is_specular: &[bool], rays: usize) {
        self.rays += rays;
        self.intersected += counted.first.len();
        let hits = || counted.first.iter().copied().filter(|&shape| shape != NO_SHAPE);
        self.hits += hits().count();
        self.specular_first += hits().filter(|&shape| is_specular.get(shape as usize) == Some(&true)).count();
        self.shapes.extend(hits());
        self.to_lights += counted.to_lights.values().sum::<usize>();
        for (_, [rays, missed]) in counted.bounces.range(1..) {
            self.beyond += rays;
            self.escaped += missed;
        }
        for (shape, count) in counted.blocked.into_values().flatten() {
            *self.blocked.entry(shape).or_default() += count;
        }
        self.last_first = counted.first;
    }

    /// The fraction of pixels that will not be black with so many samples each, as far as these rays can tell.
    ///
    /// Of a pixel's samples one that returns light is enough, and where none of n rays did, one of the next n may.
    pub fn lit_fraction(&self, samples: f64) -> f64 {
        let some = |fraction: f64| 1.0 - libm::pow(1.0 - fraction, samples);
        let seen = || self.light.iter().filter(|tile| tile.rays > 0);
        let lit: f64 = seen().map(|tile| some(tile.lit as f64 / tile.rays as f64)).sum();
        let unseen = if samples > 1.0 { some(1.0 / self.rays.max(1) as f64) } else { 0.0 };
        lit / seen().count().max(1) as f64 + unseen
    }

    /// The mean radiance of the brightest small tile.
    pub fn brightest(&self) -> f64 {
        let means = self.light.iter().filter(|tile| tile.rays > 0).map(|tile| tile.sum / tile.rays as f64);
        means.fold(0.0, f64::max) / self.exposure
    }

    /// Whether no camera ray hits a shape, as far as that was asked.
    pub fn hits_nothing(&self) -> bool {
        self.hits == 0 && self.intersected == self.rays
    }

    /// Whether rays were traced in all small tiles.
    pub fn is_everywhere(&self) -> bool {
        self.seen_tiles == self.tiles
    }

    /// Whether further samples would not change what is said of how many pixels are black.
    fn is_settled(&self, samples: f64) -> bool {
        let few = 1.0 - NEARLY_ALL;
        let lit_tiles = self.light.iter().filter(|tile| tile.lit > 0).count() as f64;
        samples <= 1.0 || self.lit_fraction(samples) <= few || lit_tiles > 2.0 * few * self.tiles as f64
    }
}

impl TileLight {
    fn add(&mut self, max: f32) {
        self.rays += 1;
        self.lit += usize::from(max >= DARK);
        self.sum += f64::from(if max.is_finite() { max } else { 0.0 });
    }
}

/// Which shapes are mirrors or glass, by their numbers.
fn specular_shapes(scene: &Census<'_>) -> Result<Vec<bool>> {
    if !specular_evidence(scene).needed {
        return Ok(Vec::new());
    }
    let (shapes, materials) = (scene.table::<ShapeTable>()?, scene.table::<MaterialTable>()?);
    let is_specular = |&row: &u32| row != NO_ROW && materials.kind[row as usize].is_specular();
    Ok(shapes.material.iter().map(is_specular).collect())
}

/// Of the pixels whose rays hit a shape and return at least as much light as the median of those that return any, the one
/// nearest to the middle.
fn lit_pixel(mut found: Vec<([u32; 2], f32)>, image: ImageFrame) -> Option<[u32; 2]> {
    found.retain(|(_, light)| *light >= DARK);
    found.sort_by(|one, other| one.1.total_cmp(&other.1));
    let off = |[x, y]: [u32; 2]| {
        let [x, y] = [2 * i64::from(x) - i64::from(image.width), 2 * i64::from(y) - i64::from(image.height)];
        x * x + y * y
    };
    let brighter = found.iter().skip(found.len() / 2).map(|(pixel, _)| *pixel);
    brighter.min_by_key(|&pixel| (off(pixel), pixel))
}

/// Small tiles, each in the middle of its part of the image, or the whole of a small image; ordered such that any first
/// few are spread evenly.
fn small_tiles(image: ImageFrame, side: u32) -> Vec<Tile> {
    let along = |pixels: u32, max: u32| -> Vec<[u32; 2]> {
        let count = (pixels / SIDE).clamp(1, max);
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

/// So many runs are averaged over for the cost of a ray; in a picture of one small tile, it is traced again for that.
const ENOUGH_RUNS: usize = 8;
/// From so many runs that were given up a lower bound is taken.
const ENOUGH_FOR_A_BOUND: usize = 3;

/// What runs over small tiles cost.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cost {
    /// Completed runs but the first, which finds everything cold: how many, their rays, and their seconds.
    whole: (usize, usize, f64),
    /// All runs.
    tried: (usize, usize, f64),
    is_unknown: bool,
}

impl Cost {
    /// Adds a run.
    pub(super) fn add(&mut self, rays: usize, run: ProbeRun, is_first: bool) {
        let Some(time) = run.time.map(|time| time.as_secs_f64()) else {
            self.is_unknown = true;
            return;
        };
        let take = |(runs, all, seconds): (usize, usize, f64)| (runs + 1, all + rays, seconds + time);
        self.tried = take(self.tried);
        if run.whole && !is_first {
            self.whole = take(self.whole);
        }
    }

    /// Whether the runs are enough to be averaged over.
    pub(super) fn is_known(&self) -> bool {
        self.is_unknown || self.whole.0 >= ENOUGH_RUNS
    }

    /// Seconds a ray; the least that it can be where runs were given up. None from one run or two.
    pub(super) fn of_a_ray(&self, is_least: bool) -> Option<f64> {
        let ((runs, rays, seconds), enough) =
            if is_least { (self.tried, ENOUGH_FOR_A_BOUND) } else { (self.whole, ENOUGH_RUNS) };
        (!self.is_unknown && runs >= enough && rays > 0).then(|| seconds / rays as f64)
    }
}

// What is counted while these test rays are traced.

/// After this many bounces few rays are left, and they say little about what is wrong with a scene.
const MAX_DEPTH: u32 = 4;

/// What a hook has counted in one tile so far.
#[derive(Resource, Clone, Debug, Default)]
pub(super) struct Counted {
    /// The shapes that camera rays hit.
    pub(super) first: Vec<u32>,
    /// Shadow rays at each bounce.
    pub(super) to_lights: BTreeMap<u32, usize>,
    /// At each bounce, how many shadow rays each shape blocks.
    pub(super) blocked: BTreeMap<u32, BTreeMap<u32, usize>>,
    /// At each bounce, counted from 0, the number of rays and of those that hit nothing.
    pub(super) bounces: BTreeMap<u32, [usize; 2]>,
}

impl Counted {
    /// All rays that were counted.
    pub(super) fn rays(&self) -> usize {
        self.bounces.values().map(|[rays, _]| rays).sum()
    }
}

/// Counts what camera rays hit and, during the first bounces, which shapes block shadow rays.
///
/// Several stages write each of the two columns, so the last count of a bounce is the final one.
pub(super) fn counting_hook() -> Hook {
    Arc::new(|_, stage: &Stage, _| {
        let [writes_hits, writes_shadows] =
            [ColumnKind::of::<Hits>(), ColumnKind::of::<ShadowHits>()].each(|column| stage.writes.contains(&column));
        let count = move |world: &mut World,
                          tiles: &mut QueryState<
            (&Depth, Option<&Hits>, Option<(&ShadowRays, &ShadowHits)>),
            With<Tile>,
        >| {
            if !(writes_hits || writes_shadows) {
                return;
            }
            let mut counted = world.remove_resource::<Counted>().unwrap_or_default();
            let (mut missed, mut rows, mut to_lights, mut blocked) = (0, 0, 0, BTreeMap::new());
            let (mut depth, mut shapes) = (0, Vec::new());
            for (own, hit, light) in tiles.iter(world) {
                depth = own.0;
                if let Some(hit) = hit {
                    rows += hit.rows();
                    missed += hit.shape.iter().filter(|&&shape| shape == NO_SHAPE).count();
                    shapes.extend_from_slice(&hit.shape);
                }
                if let Some((rays, shadows)) = light {
                    to_lights += rays.rows();
                    for &shape in shadows.shape.iter().filter(|&&shape| shape != NO_SHAPE) {
                        *blocked.entry(shape).or_default() += 1;
                    }
                }
            }
            if writes_hits && depth == 0 {
                counted.first = shapes;
            }
            if writes_hits {
                counted.bounces.insert(depth, [rows, missed]);
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
mod pilot_tests {
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
