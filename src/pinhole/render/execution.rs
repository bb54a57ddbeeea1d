use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// How many worlds hold the tiles while the stages run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Worlds {
    /// One per worker, which processes one tile after another; memory does not grow with the size of the image.
    #[default]
    PerWorker,
    /// One for all tiles at once, so that every column can be read afterwards.
    One,
}

/// How to execute a plan; none of these settings changes a bit of the image.
#[derive(Clone, Debug)]
pub struct Execution {
    /// The number of workers; none for one per core.
    pub threads: Option<usize>,
    /// The greatest side of a tile, in pixels; a render uses smaller tiles where many lights or shapes would make the
    /// columns large or the stages slow.
    pub tile_side: u32,
    /// How many worlds hold the tiles.
    pub worlds: Worlds,
}

impl Default for Execution {
    fn default() -> Self {
        Self { threads: None, tile_side: 32, worlds: Worlds::default() }
    }
}

/// An observer of a render: it is notified of progress, and may stop the render.
pub trait Watch: Sync {
    /// A tile is finished.
    fn tile_done(&self) {}
    /// This many pixel samples have been taken since the last call.
    fn traced(&self, _samples: u64) {}
    /// A pass begins; in total this many pixel samples are expected, and `done` of `of` samples per pixel are finished.
    fn expect(&self, _samples: u64, _done: u32, _of: u32) {}
    /// Whether to stop before the next sample of a tile.
    fn stopped(&self) -> bool {
        false
    }
    /// A flag that, once set, stops the render even between two bounces of a tile, so that a path without end stops
    /// too.
    fn stop_flag(&self) -> Option<Arc<AtomicBool>> {
        None
    }
}

/// No observer.
impl Watch for () {}
