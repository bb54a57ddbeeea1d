use crate::Result;
use crate::extract::ImageFrame;
use crate::intersect::{Hits, NO_SHAPE};
use crate::plan::{Column, ColumnKind, ExtractedTable, Plan, Stage, Table};
use crate::rays::{Depth, Tile};
use crate::render::{Hook, look_at_pieces, usual_tile_side};
use crate::shade::{LightRays, Radiance, ShadowHits};
use bevy_ecs::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// The most pieces of the picture along each axis, and the pixels along a side of each.
const PIECES: [u32; 2] = [12, 8];
const SIDE: u32 = 8;
/// Half of the smallest step of a PNG near black.
const DARK: f32 = 1.5e-4;
/// On later legs fewer and fewer rays are left, and they say less and less of what is wrong.
const MAX_DEPTH: u32 = 4;

/// What a few rays of the picture to come have met and brought back.
#[derive(Clone, Debug, Default)]
pub struct Pilot {
    /// Rays from the camera, in pieces that were finished; all but the last five numbers speak of these.
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
    /// What a ray took on average with all that followed from it, in seconds of one thread; where pieces were given up, at
    /// least that.
    pub seconds_a_ray: f64,
    /// How many rays follow one of the camera's on average, those to lights not counted.
    pub followed_by: f64,
    /// Rays from the camera, those in pieces that were given up counted too.
    pub tried: usize,
    /// The most bounces that a ray in a piece had behind it when the piece was given up.
    pub deepest: u32,
    /// Pieces of the picture that were to be tried.
    pub pieces: usize,
}

/// What a hook has counted in one piece so far.
#[derive(Resource, Clone, Debug, Default)]
struct Counted {
    met: usize,
    /// Rays to lights on each leg.
    to_lights: BTreeMap<u32, usize>,
    /// What is in their way.
    blocked: BTreeMap<u32, BTreeMap<u32, usize>>,
    /// The bounce at hand, counted from 0, and its rays.
    bounce: (u32, usize),
    /// The rays of all bounces before it.
    before: usize,
}

/// Traces one sample of each pixel of some small pieces of the picture, spread evenly over it, until all are done or the
/// time is up.
///
/// Errors: an image without a shape.
pub fn pilot(scene: &World, prepared: (&Plan, &[ExtractedTable]), patience: Duration) -> Result<Pilot> {
    let image = ImageFrame::extract(scene)?;
    let side = SIDE.min(usual_tile_side(scene, prepared.0));
    let pieces = pieces(image, side);
    let mut pilot = Pilot { pieces: pieces.len(), ..Pilot::default() };
    let (mut time, mut all, started) = (0.0, 0, Instant::now());
    look_at_pieces(scene, prepared, &pieces, patience, &[counting_hook()], &mut |world, took| {
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
        pilot.met += counted.met;
        pilot.to_lights += counted.to_lights.values().sum::<usize>();
        for (shape, count) in counted.blocked.into_values().flatten() {
            *pilot.blocked.entry(shape).or_default() += count;
        }
        // Where nothing in the scene brings light, there is no such column, or it has no rows.
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
    Ok(pilot)
}

/// The pieces: each in the middle of its part of the picture, and all of a small one; in an order in which the first few
/// are spread evenly already.
fn pieces(image: ImageFrame, side: u32) -> Vec<Tile> {
    let along = |pixels: u32, most: u32| -> Vec<[u32; 2]> {
        let count = (pixels / SIDE).clamp(1, most);
        let side = side.min(pixels);
        (0..count).map(|piece| [((2 * piece + 1) * pixels / (2 * count)).saturating_sub(side / 2), side]).collect()
    };
    let (columns, lines) = (along(image.width, PIECES[0]), along(image.height, PIECES[1]));
    let mut pieces = Vec::new();
    for (line, &[y, height]) in lines.iter().enumerate() {
        for (column, &[x, width]) in columns.iter().enumerate() {
            let turn = turn([256 * column / columns.len(), 256 * line / lines.len()]);
            pieces.push((turn, Tile { x, y, width, height }));
        }
    }
    pieces.sort_by_key(|(turn, _)| *turn);
    pieces.into_iter().map(|(_, piece)| piece).collect()
}

/// When the turn of a place is that lies so many 256ths along each axis: the halves of a place come before its quarters.
fn turn([x, y]: [usize; 2]) -> usize {
    (0..8).map(|bit| (x >> (7 - bit) & 1 | (y >> (7 - bit) & 1) << 1) << (2 * bit)).sum()
}

/// Counts what the camera's rays have met, and on the first legs which rays to lights are blocked.
///
/// Several stages write each of the two columns, so the last count of a leg is the one that counts.
fn counting_hook() -> Hook {
    Arc::new(|_, stage: &Stage, _| {
        let [hits, shadows] =
            [ColumnKind::of::<Hits>(), ColumnKind::of::<ShadowHits>()].map(|column| stage.writes.contains(&column));
        let count = move |world: &mut World,
                          tiles: &mut QueryState<
            (&Depth, Option<&Hits>, Option<(&LightRays, &ShadowHits)>),
            With<Tile>,
        >| {
            if !(hits || shadows) {
                return;
            }
            let mut counted = world.remove_resource::<Counted>().unwrap_or_default();
            let (mut met, mut rows, mut to_lights, mut blocked) = (0, 0, 0, BTreeMap::new());
            let mut depth = 0;
            for (own, hit, light) in tiles.iter(world) {
                depth = own.0;
                if let Some(hit) = hit {
                    rows += hit.rows();
                    met += hit.shape.iter().filter(|&&shape| shape != NO_SHAPE).count();
                }
                if let Some((rays, shadows)) = light {
                    to_lights += rays.rows();
                    for &shape in shadows.shape.iter().filter(|&&shape| shape != NO_SHAPE) {
                        *blocked.entry(shape).or_default() += 1;
                    }
                }
            }
            if hits && depth == 0 {
                counted.met = met;
            }
            if hits {
                if counted.bounce.0 != depth {
                    counted.before += counted.bounce.1;
                }
                counted.bounce = (depth, rows);
            }
            if shadows && depth < MAX_DEPTH {
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

    /// Every piece is tried once, and the first few of them lie in all quarters of the picture.
    #[test]
    fn pieces_are_spread_evenly_from_the_first_on() {
        let image = ImageFrame { width: 960, height: 540 };
        let pieces = pieces(image, SIDE);
        let all: BTreeSet<_> = pieces.iter().map(|tile| (tile.x, tile.y)).collect();
        assert_eq!((pieces.len(), all.len()), (96, 96));
        for (parts, tried) in [(2, 4), (4, 24)] {
            let part = |tile: &Tile| (tile.x * parts / 960, tile.y * parts / 540);
            let seen: BTreeSet<_> = pieces[..tried].iter().map(part).collect();
            assert_eq!(seen.len(), (parts * parts) as usize, "{:?}", &pieces[..tried]);
        }
    }
}
