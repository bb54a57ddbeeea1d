use bevy_ecs::schedule::Schedule;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// How many worlds hold the tiles while they run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Worlds {
    /// One a worker, which runs tile after tile in it; memory does not grow with the frame.
    #[default]
    PerWorker,
    /// One for all tiles at once, so that every column can be read afterwards.
    One,
}

/// How to execute a plan; nothing here can change a bit of the image.
#[derive(Clone)]
pub struct Execution {
    /// Workers; none for as many as the machine has cores.
    pub threads: Option<usize>,
    /// The most pixels along the side of a full tile; where many lights or shapes would make its columns large or its
    /// stages slow, a render takes fewer.
    pub tile_side: u32,
    /// How many worlds hold the tiles.
    pub worlds: Worlds,
    /// A last say over each worker's schedule, for tests that shuffle its order.
    pub arrange: Option<Arc<dyn Fn(&mut Schedule) + Send + Sync>>,
}

impl Default for Execution {
    fn default() -> Self {
        Self { threads: None, tile_side: 32, worlds: Worlds::default(), arrange: None }
    }
}

/// Someone who waits for a render: is told of progress, and may stop it.
pub trait Watch: Sync {
    /// A tile is done.
    fn tile_done(&self) {}
    /// So many samples of pixels have been traced.
    fn traced(&self, _samples: u64) {}
    /// A pass begins: so many samples of pixels are expected altogether, and so many samples a pixel are done.
    fn expect(&self, _samples: u64, _done: u32, _of: u32) {}
    /// Whether to stop before the next sample of a tile.
    fn stopped(&self) -> bool {
        false
    }
    /// A flag that is set to stop even between two bounces of a tile, so that an endless path ends too.
    fn stop_flag(&self) -> Option<Arc<AtomicBool>> {
        None
    }
}

/// Nobody waits.
impl Watch for () {}
