use super::progress::Progress;
use crate::render::Watch;
use std::io::Write;
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};

/// Set once the reader has pressed Ctrl-C.
static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// From now on Ctrl-C stops a render between two tiles, and nothing is written; a second one ends the program.
pub fn stop_on_interrupt() {
    let handled = ctrlc::set_handler(|| {
        if INTERRUPTED.swap(true, Ordering::Relaxed) {
            process::exit(130);
        }
    });
    if let Err(refused) = handled {
        let _ = writeln!(std::io::stderr(), "pinhole: Ctrl-C will end the program at once: {refused}");
    }
}

/// Whether the reader has pressed Ctrl-C.
pub fn interrupted() -> bool {
    INTERRUPTED.load(Ordering::Relaxed)
}

/// Someone who waits: sees how far a render is, and may press Ctrl-C.
pub struct Waiting {
    progress: Progress,
    counts_samples: bool,
}

impl Waiting {
    /// A bar of this many tiles on standard error, or, where that is 0, of samples whose number is told later; none where
    /// standard error is not a terminal or `quiet` is set.
    pub fn new(tiles: u64, quiet: bool) -> Self {
        Self::with(if quiet { Progress::hidden() } else { Progress::bar(tiles) }, tiles)
    }

    /// The same with another way to show how far it is.
    pub fn with(progress: Progress, tiles: u64) -> Self {
        Self { progress, counts_samples: tiles == 0 }
    }

    /// Takes the bar off the screen.
    pub fn done(&self) {
        self.progress.done();
    }
}

impl Watch for Waiting {
    fn tile_done(&self) {
        if !self.counts_samples {
            self.progress.advance(1);
        }
    }

    fn traced(&self, samples: u64) {
        if self.counts_samples {
            self.progress.advance(samples);
        }
    }

    fn expect(&self, samples: u64, done: u32, of: u32) {
        if self.counts_samples {
            self.progress.expect(samples, done, of);
        }
    }

    fn stopped(&self) -> bool {
        interrupted()
    }
}
