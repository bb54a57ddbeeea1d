//! What someone who waits for a render sees: a bar at a terminal, and elsewhere a line every tenth.

use super::span::told;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::{IsTerminal, Write, stderr};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// No two lines follow each other sooner than this.
const SOONEST: Duration = Duration::from_secs(1);

/// How far a render is, on standard error.
pub struct Progress {
    shown: Shown,
}

enum Shown {
    Nothing,
    Bar(ProgressBar),
    Lines(Lines),
}

impl Progress {
    /// Nothing to be seen.
    pub fn hidden() -> Self {
        Self { shown: Shown::Nothing }
    }

    /// A bar of so many steps where standard error is a terminal, and nothing elsewhere.
    pub fn bar(steps: u64) -> Self {
        if !stderr().is_terminal() {
            return Self::hidden();
        }
        let bar = ProgressBar::new(steps);
        if let Ok(style) = ProgressStyle::with_template("rendering {bar:40} {percent:>3} %  {msg}{eta} left") {
            bar.set_style(style);
        }
        Self { shown: Shown::Bar(bar) }
    }

    /// Says at once what is going to be rendered, where standard error is no terminal, which will show a bar.
    pub fn announce(what: &str, width: u32, height: u32) {
        if !stderr().is_terminal() {
            say(&format!("rendering {what}: {width} × {height} pixels"));
        }
    }

    /// A bar where standard error is a terminal; elsewhere a line every tenth of the steps, or of the time where there is a
    /// limit to it.
    pub fn of(what: &str, steps: u64, limit: Option<Duration>) -> Self {
        if stderr().is_terminal() {
            return Self::bar(steps);
        }
        Self { shown: Shown::Lines(Lines::new(what, steps, limit)) }
    }

    /// So many steps more are done.
    pub fn advance(&self, steps: u64) {
        match &self.shown {
            Shown::Nothing => {}
            Shown::Bar(bar) => bar.inc(steps),
            Shown::Lines(lines) => lines.advance(steps),
        }
    }

    /// A pass begins: how many steps there are altogether, and how many samples of how many each pixel has.
    pub fn expect(&self, steps: u64, done: u32, of: u32) {
        match &self.shown {
            Shown::Nothing => {}
            Shown::Bar(bar) => {
                if bar.length() != Some(steps) {
                    bar.set_length(steps);
                    bar.set_position(before(steps, done, of));
                    // What was done before says nothing about how fast it goes now: it is taken in, and then forgotten.
                    bar.tick();
                    bar.reset_eta();
                }
                bar.set_message(format!("{done} of {of} samples, "));
            }
            Shown::Lines(lines) => lines.expect(steps, done, of),
        }
    }

    /// Takes a bar off the screen.
    pub fn done(&self) {
        if let Shown::Bar(bar) = &self.shown {
            bar.finish_and_clear();
        }
    }
}

/// How many steps are done where each pixel has so many samples of so many.
fn before(steps: u64, done: u32, of: u32) -> u64 {
    (steps as f64 * f64::from(done) / f64::from(of.max(1))) as u64
}

/// Progress as lines.
struct Lines {
    what: String,
    began: Instant,
    limit: Option<Duration>,
    steps: AtomicU64,
    done: AtomicU64,
    pace: Mutex<Pace>,
}

/// Which tenths have been told of, and when; and since when, and from how many steps on, the speed is measured.
#[derive(Default)]
struct Pace {
    since: Duration,
    from: u64,
    tenths: u32,
    told: Duration,
    samples: Option<[u32; 2]>,
}

impl Lines {
    fn new(what: &str, steps: u64, limit: Option<Duration>) -> Self {
        let (steps, done) = (AtomicU64::new(steps), AtomicU64::new(0));
        Self { what: what.into(), began: Instant::now(), limit, steps, done, pace: Mutex::default() }
    }

    fn advance(&self, steps: u64) {
        let done = self.done.fetch_add(steps, Ordering::Relaxed) + steps;
        let all = self.steps.load(Ordering::Relaxed);
        let passed = self.began.elapsed();
        let by_steps = done as f64 / all.max(1) as f64;
        let fraction = self.limit.map_or(by_steps, |limit| by_steps.max(passed.div_duration_f64(limit)));
        let mut pace = self.pace.lock().unwrap_or_else(PoisonError::into_inner);
        let by_speed = pace.left([done, all], passed);
        let left = self.limit.map_or(by_speed, |limit| by_speed.min(limit.saturating_sub(passed)));
        if let Some(line) = pace.line(fraction, passed, left) {
            say(&format!("rendering {}: {line}", self.what));
        }
    }

    /// What was done before this program began, or in a pilot, is told by the samples that each pixel has; how long the
    /// rest takes is told by what is done from now on.
    fn expect(&self, steps: u64, done: u32, of: u32) {
        let mut pace = self.pace.lock().unwrap_or_else(PoisonError::into_inner);
        if self.steps.swap(steps, Ordering::Relaxed) != steps {
            let before = before(steps, done, of);
            self.done.store(before, Ordering::Relaxed);
            (pace.since, pace.from) = (self.began.elapsed(), before);
        }
        // No number of samples is a goal where only the time ends the render.
        pace.samples = self.limit.is_none().then_some([done, of]);
    }
}

impl Pace {
    /// How long the rest of the steps takes at the speed since it has been measured.
    fn left(&self, [done, all]: [u64; 2], passed: Duration) -> Duration {
        let (rest, own) = (all.saturating_sub(done), done.saturating_sub(self.from).max(1));
        let seconds = passed.saturating_sub(self.since).as_secs_f64() * rest as f64 / own as f64;
        Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX)
    }

    /// The line that is due when a fraction of the work is done after some time, and so much time is left.
    fn line(&mut self, fraction: f64, passed: Duration, left: Duration) -> Option<String> {
        let tenths = (fraction * 10.0) as u32;
        if tenths <= self.tenths || tenths >= 10 {
            return None;
        }
        self.tenths = tenths;
        if passed.saturating_sub(self.told) < SOONEST {
            return None;
        }
        self.told = passed;
        let samples = self.samples.map_or(String::new(), |[done, of]| format!(", {done} of {of} samples a pixel"));
        Some(format!("{tenths}0 %{samples}, about {} left", told(left)))
    }
}

/// Writes a line to standard error, whether it can be or not.
pub fn say(line: &str) {
    let _ = writeln!(stderr(), "{line}");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_comes_every_tenth_and_no_sooner_than_a_second() {
        let mut pace = Pace { samples: Some([2, 16]), ..Pace::default() };
        let mut at = |fraction: f64, seconds: f64| {
            let passed = Duration::from_secs_f64(seconds);
            let left = pace.left([(fraction * 100.0).round() as u64, 100], passed);
            pace.line(fraction, passed, left)
        };
        assert_eq!(at(0.05, 2.0), None);
        assert_eq!(at(0.11, 4.0).as_deref(), Some("10 %, 2 of 16 samples a pixel, about 32.4 s left"));
        assert_eq!(at(0.12, 9.0), None, "the same tenth");
        assert_eq!(at(0.21, 4.5), None, "too soon");
        assert_eq!(at(0.22, 9.0), None, "a tenth that was passed over stays so");
        assert!(at(0.55, 20.0).is_some_and(|line| line.starts_with("50 %, ")));
        assert_eq!(at(1.0, 40.0), None, "what follows says that it is done");
    }

    /// Nine tenths that an earlier program did, or a pilot, are no speed of this one's.
    #[test]
    fn the_time_left_is_told_by_what_this_program_did() {
        let lines = Lines::new("a", 0, None);
        lines.expect(1000, 9, 10);
        let left = |done: u64, seconds: u64| {
            let pace = lines.pace.lock().unwrap_or_else(PoisonError::into_inner);
            pace.left([done, 1000], pace.since + Duration::from_secs(seconds))
        };
        assert_eq!(lines.done.load(Ordering::Relaxed), 900);
        assert_eq!(left(950, 30), Duration::from_secs(30), "50 steps in 30 s, and 50 more to do");
        assert_eq!(left(975, 30), Duration::from_secs(10));
        // The same steps are expected again in every pass, and the speed goes on being measured from the first of them.
        lines.advance(50);
        lines.expect(1000, 9, 10);
        assert_eq!(lines.done.load(Ordering::Relaxed), 950);
        assert_eq!(left(950, 30), Duration::from_secs(30));

        // The same for a bar: it stands where the work stands.
        let bar = ProgressBar::hidden();
        let progress = Progress { shown: Shown::Bar(bar.clone()) };
        progress.expect(1000, 9, 10);
        std::thread::sleep(Duration::from_millis(20));
        progress.advance(25);
        progress.expect(1000, 9, 10);
        assert_eq!((bar.position(), bar.length()), (925, Some(1000)));
        assert!(bar.per_sec() < 2e4, "{} steps a second are those of before", bar.per_sec());
    }

    #[test]
    fn a_hundred_quick_steps_are_not_a_hundred_lines() {
        let (mut pace, rest) = (Pace::default(), Duration::from_secs(1));
        let lines = (1..=1000)
            .filter_map(|step| pace.line(f64::from(step) / 1000.0, Duration::from_millis(10 * step as u64), rest));
        assert_eq!(lines.count(), 9);
        let mut pace = Pace::default();
        let lines =
            (1..=1000).filter_map(|step| pace.line(f64::from(step) / 1000.0, Duration::from_millis(step as u64), rest));
        assert_eq!(lines.count(), 0);
    }
}
