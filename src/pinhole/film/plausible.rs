//! What no render can have left behind, however a film came to be.

use super::{FIRST_SAMPLE_STEPS, Film, FilmSplats};
use crate::extract::MOST_SAMPLES;

/// The most paths from lights for every sample of a pixel, and the most by which a last round of them can exceed that.
const MOST_PATHS: u64 = 1024;
const LAST_ROUND: u64 = 1 << 20;

/// Whether samples, as many as the steps say, can have made this film.
///
/// Sums of layers are not looked at, since a degenerate scene may have any.
pub fn is_plausible(film: &Film) -> bool {
    let most = film.done.iter().copied().max().map_or(0, samples_of);
    let tiles = (0..film.tiles.len()).all(|number| is_plausible_tile(film, number));
    tiles && most <= MOST_SAMPLES && film.splats.as_ref().is_none_or(|splats| are_plausible(splats, film, most))
}

/// The most samples that a pixel can have after so many steps: the first takes several of them.
fn samples_of(steps: u32) -> u32 {
    steps.saturating_sub(FIRST_SAMPLE_STEPS - 1).max(steps.min(1))
}

fn is_plausible_tile(film: &Film, number: usize) -> bool {
    let (tile, most) = (&film.tiles[number], samples_of(film.done[number]));
    let planned = film.planned.get(number);
    let most_of = |row: usize| planned.map_or(most, |planned| most.min(planned[row]));
    let counts = tile.count.iter().enumerate().all(|(row, &count)| count <= most_of(row));
    let negative = tile.negative_count.iter().zip(&tile.count).all(|(negative, count)| negative <= count);
    let rejected = tile.rejected <= tile.count.len() as u64 * u64::from(most);
    let sums = tile.sums().into_iter().chain(&tile.negative).all(|component| is_light(component));
    let moments = film
        .moments
        .get(number)
        .is_none_or(|own| [&own.r, &own.g, &own.b].into_iter().all(|component| is_light(component)));
    let layers = film.layers.get(number).is_none_or(|own| {
        let met = own.met.iter().zip(&own.taken).all(|(met, taken)| met <= taken);
        met && own.taken.iter().all(|&taken| taken <= most)
    });
    counts && negative && rejected && sums && moments && layers
}

fn are_plausible(splats: &FilmSplats, film: &Film, most: u32) -> bool {
    let pixels = u64::from(film.width) * u64::from(film.height);
    let paths = u64::from(most).saturating_mul(pixels).saturating_mul(MOST_PATHS).saturating_add(LAST_ROUND);
    // A filter that is negative in places may leave sums below 0.
    splats.paths <= paths && splats.sums.iter().flatten().all(|sum| sum.is_finite())
}

fn is_light(component: &[f64]) -> bool {
    component.iter().all(|sum| (0.0..f64::INFINITY).contains(sum))
}
