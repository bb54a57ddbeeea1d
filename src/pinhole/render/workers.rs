use super::Execution;
use std::thread::available_parallelism;

/// The number of workers to start: as many as requested, or one per core, but no more than there are tiles or batches
/// of light paths.
///
/// Starting a thousand workers for one tile would take longer than rendering it.
pub(super) fn workers(execution: &Execution, tiles: u64, batches: u64) -> usize {
    let max = usize::try_from(tiles.max(batches).max(1)).unwrap_or(usize::MAX);
    execution.threads.filter(|&threads| threads > 0).unwrap_or_else(by_default).min(max)
}

/// What `rayon` would choose by default, which must be known here so that it can be limited.
fn by_default() -> usize {
    let threads = std::env::var("RAYON_NUM_THREADS").ok().and_then(|number| number.parse().ok());
    threads.filter(|&number| number > 0).unwrap_or_else(|| available_parallelism().map_or(1, usize::from))
}
