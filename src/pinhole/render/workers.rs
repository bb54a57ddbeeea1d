use super::Execution;
use std::thread::available_parallelism;

/// How many workers to start: as many as are asked for or the machine has cores, but no more than there are tiles or
/// batches of light to give them.
///
/// A thousand workers for one tile take longer to start than the tile takes.
pub(super) fn workers(execution: &Execution, tiles: u64, batches: u64) -> usize {
    let most = usize::try_from(tiles.max(batches).max(1)).unwrap_or(usize::MAX);
    execution.threads.filter(|&asked| asked > 0).unwrap_or_else(by_default).min(most)
}

/// What `rayon` takes where nothing is said, which has to be known here to be limited.
fn by_default() -> usize {
    let asked = std::env::var("RAYON_NUM_THREADS").ok().and_then(|number| number.parse().ok());
    asked.filter(|&number| number > 0).unwrap_or_else(|| available_parallelism().map_or(1, usize::from))
}
