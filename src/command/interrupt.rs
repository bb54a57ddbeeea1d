use crate::render::Watch;
use indicatif::{ProgressBar, ProgressStyle};
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

/// Someone at a terminal: sees a bar, and may press Ctrl-C.
pub struct Waiting {
    bar: ProgressBar,
    counts_samples: bool,
}

impl Waiting {
    /// A bar of this many tiles on standard error, or, where that is 0, of samples whose number is told later; none where
    /// standard error is not a terminal or `quiet` is set.
    pub fn new(tiles: u64, quiet: bool) -> Self {
        let bar = if quiet { ProgressBar::hidden() } else { ProgressBar::new(tiles) };
        if let Ok(style) = ProgressStyle::with_template("rendering {bar:40} {percent:>3} %  {msg}{eta} left") {
            bar.set_style(style);
        }
        Self { bar, counts_samples: tiles == 0 }
    }

    /// Takes the bar off the screen.
    pub fn done(&self) {
        self.bar.finish_and_clear();
    }
}

impl Watch for Waiting {
    fn tile_done(&self) {
        if !self.counts_samples {
            self.bar.inc(1);
        }
    }

    fn traced(&self, samples: u64) {
        if self.counts_samples {
            self.bar.inc(samples);
        }
    }

    fn expect(&self, samples: u64, done: u32, of: u32) {
        if self.counts_samples {
            self.bar.set_length(samples);
            self.bar.set_message(format!("{done} of {of} samples, "));
        }
    }

    fn stopped(&self) -> bool {
        interrupted()
    }
}
