//! Checks that a render can have produced a film that was read from a file.

use super::{BLOCK, FIRST_SAMPLE_STEPS, Film, FilmLayers, FilmMoments, FilmSplats, FilmTile, UnitFilm};
use crate::extract::MAX_SAMPLES;
use crate::intersect::NO_SHAPE;
use crate::scene::LayerKind;

/// The largest number of light paths per sample of a pixel.
const MAX_PATHS: u64 = 1024;
/// The largest number by which the last round of light paths can exceed that.
const LAST_ROUND: u64 = 1 << 20;

/// Whether that many steps of a render can have produced this film.
///
/// Sums of layers are not checked, since a degenerate scene may have any value.
pub fn is_plausible(film: &Film) -> bool {
    let max = film.done.iter().copied().max().map_or(0, samples_of);
    let tiles = (0..film.tiles.len()).all(|number| is_plausible_tile(film, number));
    tiles && max <= MAX_SAMPLES && film.splats.as_ref().is_none_or(|splats| are_plausible(splats, film, max))
}

/// The largest number of samples of a pixel after that many steps, of which the first sample takes several.
fn samples_of(steps: u32) -> u32 {
    steps.saturating_sub(FIRST_SAMPLE_STEPS - 1).max(steps.min(1))
}

fn is_plausible_tile(film: &Film, number: usize) -> bool {
    let max = samples_of(film.done[number]);
    let planned = film.planned.get(number).map(Vec::as_slice);
    is_plausible_part(&film.tiles[number], (max, planned), film.moments.get(number), film.layers.get(number))
}

/// Whether a render of so many samples can have produced this unit of a film, and has finished it.
pub(super) fn is_plausible_unit(own: &UnitFilm, samples: u32) -> bool {
    let first = own.unit.block.map_or(0, |block| block.saturating_mul(BLOCK));
    let max = own.unit.block.map_or(samples, |_| samples.saturating_sub(first).min(BLOCK));
    let due = |planned: u32| u64::from(planned.min(samples).saturating_sub(first).min(max));
    let rows = own.tile.count.len();
    let all =
        own.planned.as_ref().map_or(rows as u64 * u64::from(max), |planned| planned.iter().map(|&own| due(own)).sum());
    let taken: u64 = own.tile.count.iter().map(|&count| u64::from(count)).sum();
    let is_whole = taken.checked_add(own.tile.rejected) == Some(all);
    let planned: Option<Vec<u32>> =
        own.planned.as_ref().map(|planned| planned.iter().map(|&own| due(own) as u32).collect());
    let is_first = own.unit.block.is_none() || own.tile.earlier.is_none();
    let is_one = |layers: &FilmLayers| own.unit.block.is_none() || layers.earlier.is_empty();
    samples <= MAX_SAMPLES
        && is_whole
        && is_first
        && own.layers.as_ref().is_none_or(is_one)
        && is_plausible_part(&own.tile, (max, planned.as_deref()), own.moments.as_ref(), own.layers.as_ref())
}

fn is_plausible_part(
    tile: &FilmTile,
    (max, planned): (u32, Option<&[u32]>),
    moments: Option<&FilmMoments>,
    layers: Option<&FilmLayers>,
) -> bool {
    let most_of = |row: usize| planned.map_or(max, |planned| max.min(planned[row]));
    let counts = tile.count.iter().enumerate().all(|(row, &count)| count <= most_of(row));
    let negative = tile.negative_count.iter().zip(&tile.count).all(|(negative, count)| negative <= count);
    let rejected = tile.rejected <= tile.count.len() as u64 * u64::from(max);
    let earlier = tile.earlier.iter().flat_map(|earlier| earlier.sum.iter().chain(&earlier.negative));
    let is_sum = |component: &Vec<f64>| is_valid(component, f64::from(tile.min));
    let sums = tile.sum.iter().chain(&tile.negative).chain(earlier).all(is_sum);
    let before = tile.earlier.iter().all(|earlier| earlier.count.iter().zip(&tile.count).all(|(own, all)| own <= all));
    let valid = |own: &FilmMoments| own.sum.iter().chain(&own.earlier).all(|component| is_valid(component, 0.0));
    let layers = layers.is_none_or(|own| {
        let hits = own.hits.iter().zip(&own.taken).all(|(hits, taken)| hits <= taken);
        are_plausible_mattes(own) && hits && own.taken.iter().all(|&taken| taken <= max)
    });
    counts && negative && rejected && sums && before && moments.is_none_or(valid) && layers
}

/// Every sample that hit a surface hit one shape.
fn are_plausible_mattes(layers: &FilmLayers) -> bool {
    let mut counts = vec![0_u64; layers.hits.len()];
    for (&(row, shape), &count) in &layers.mattes {
        match counts.get_mut(row as usize) {
            Some(own) if shape != NO_SHAPE && count > 0 => *own += u64::from(count),
            _ => return false,
        }
    }
    let counted = || counts.iter().zip(&layers.hits).all(|(&count, &hits)| count == u64::from(hits));
    !layers.kinds.contains(&LayerKind::Cryptomatte) || counted()
}

fn are_plausible(splats: &FilmSplats, film: &Film, max: u32) -> bool {
    let pixels = u64::from(film.width) * u64::from(film.height);
    let paths = u64::from(max).saturating_mul(pixels).saturating_mul(MAX_PATHS).saturating_add(LAST_ROUND);
    // A filter with negative lobes may leave negative sums.
    splats.paths <= paths && splats.sums.iter().flatten().all(|sum| sum.is_finite())
}

/// Whether sums of samples that are at least 0, or may be negative, are such sums.
fn is_valid(component: &[f64], min: f64) -> bool {
    let min = if min < 0.0 { f64::MIN } else { 0.0 };
    component.iter().all(|sum| (min..f64::INFINITY).contains(sum))
}
