use super::progress::Progress;
use pinhole::film::writes_in_progress;
use pinhole::render::Watch;
use std::io::{IsTerminal, Write};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, LazyLock};
use std::time::{Duration, Instant};
use std::{process, thread};

/// Set once the reader has pressed Ctrl-C, or has asked by SIGTERM.
static INTERRUPTED: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);
/// How many there are who look at the flag and end by themselves.
static ENDING_BY_ITSELF: AtomicUsize = AtomicUsize::new(0);
/// The status of a program that Ctrl-C has ended, as shells have it: 128 and the signal's number.
const STATUS: i32 = 130;
/// How long a file that is being written is waited for.
const WAIT_FOR_FILES: Duration = Duration::from_millis(800);
const LOOK_AGAIN: Duration = Duration::from_millis(5);

/// From now on Ctrl-C and SIGTERM end the program within a second.
///
/// Where something is under way that keeps what it has, it is told to stop and ends by itself, unless it is asked a second
/// time; everything else, whatever it may be waiting for, just ends.
pub fn stop_on_interrupt() {
    let flag = Arc::clone(&INTERRUPTED);
    let handled = ctrlc::set_handler(move || {
        let again = flag.swap(true, Ordering::SeqCst);
        if again {
            process::exit(STATUS);
        }
        if ENDING_BY_ITSELF.load(Ordering::SeqCst) == 0 {
            end();
        }
    });
    if let Err(refused) = handled {
        let _ = writeln!(std::io::stderr(), "pinhole: Ctrl-C will end the program at once: {refused}");
    }
}

/// Ends the program, but lets a file that is being written become whole.
fn end() {
    let asked = Instant::now();
    while writes_in_progress() > 0 && asked.elapsed() < WAIT_FOR_FILES {
        thread::sleep(LOOK_AGAIN);
    }
    // A terminal shows ^C, or a bar, on the line that the cursor is on.
    let mut errors = std::io::stderr();
    let line = if errors.is_terminal() { "\n" } else { "" };
    let _ = writeln!(errors, "{line}pinhole: stopped; no file was left half written");
    process::exit(STATUS);
}

/// Held by whoever looks at [`interrupted`] many times a second, or hands [`stop_flag`] on to a render, and ends by itself
/// in good order.
pub struct EndsByItself;

impl EndsByItself {
    /// From now on, until this is dropped.
    pub fn begin() -> Self {
        ENDING_BY_ITSELF.fetch_add(1, Ordering::SeqCst);
        Self
    }
}

impl Drop for EndsByItself {
    fn drop(&mut self) {
        ENDING_BY_ITSELF.fetch_sub(1, Ordering::SeqCst);
    }
}

/// Whether the reader has asked to stop.
pub fn interrupted() -> bool {
    INTERRUPTED.load(Ordering::SeqCst)
}

/// The flag itself, for a render to look at within a tile.
pub fn stop_flag() -> Arc<AtomicBool> {
    Arc::clone(&INTERRUPTED)
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

    fn stop_flag(&self) -> Option<Arc<AtomicBool>> {
        Some(stop_flag())
    }
}
