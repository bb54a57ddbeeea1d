//! Checks that a render can have produced a film that was read from a file.

use super::{FIRST_SAMPLE_STEPS, Film, FilmLayers, FilmSplats};
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
    let (tile, max) = (&film.tiles[number], samples_of(film.done[number]));
    let planned = film.planned.get(number);
    let most_of = |row: usize| planned.map_or(max, |planned| max.min(planned[row]));
    let counts = tile.count.iter().enumerate().all(|(row, &count)| count <= most_of(row));
    let negative = tile.negative_count.iter().zip(&tile.count).all(|(negative, count)| negative <= count);
    let rejected = tile.rejected <= tile.count.len() as u64 * u64::from(max);
    let sums = tile.sum.iter().chain(&tile.negative).all(|component| is_valid(component));
    let moments = film.moments.get(number).is_none_or(|own| own.sum.iter().all(|component| is_valid(component)));
    let layers = film.layers.get(number).is_none_or(|own| {
        let hits = own.hits.iter().zip(&own.taken).all(|(hits, taken)| hits <= taken);
        are_plausible_mattes(own) && hits && own.taken.iter().all(|&taken| taken <= max)
    });
    counts && negative && rejected && sums && moments && layers
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

fn is_valid(component: &[f64]) -> bool {
    component.iter().all(|sum| (0.0..f64::INFINITY).contains(sum))
}
