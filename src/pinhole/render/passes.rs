use super::adaptive::{Achieved, achieved, planned_samples};
use super::steps::{WHOLE, samples_after, steps_of};
use super::{RenderInProgress, Watch};
use crate::film::Film;
use crate::scene::Adaptive;
use crate::{Error, Result};
use std::time::{Duration, Instant};

/// The first picture is written after the first pass that ends later than this.
const FIRST: Duration = Duration::from_millis(150);
/// A picture is not written again sooner than this.
const SOONEST: Duration = Duration::from_millis(500);
/// Writing takes at most one part in this many of the time.
const FRACTION_FOR_WRITING: u32 = 20;
/// No pass is meant to take longer than this, so that what is on disk is never much older.
const LONGEST_PASS: Duration = Duration::from_secs(5);
/// The lattices of the first sample are one pass where they take less than this together.
const AT_ONCE: Duration = Duration::from_millis(250);

/// When a render ends, and how often it is saved.
#[derive(Clone, Copy, Debug, Default)]
pub struct Limits {
    /// The time after which no further pass begins.
    pub time: Option<Duration>,
    /// The time between two writings; by default, writing takes at most 5 % of the time.
    pub write_every: Option<Duration>,
    /// The error that each pixel is to reach, for adaptive sampling.
    pub adaptive: Option<Adaptive>,
}

/// The outcome of a render in passes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outcome {
    /// Whether the observer stopped it.
    pub stopped: bool,
    /// Whether the time ran out before the samples were done.
    pub out_of_time: bool,
    /// The number of samples that every pixel has, unless it was to have fewer.
    pub samples: u32,
    /// The errors that were reached, where sampling was adaptive.
    pub achieved: Option<Achieved>,
    /// Elapsed time from the beginning to the end of the last pass, including the writing in between.
    pub time: Duration,
}

/// Advances a render to its end in passes of growing numbers of samples, coarse lattices first.
///
/// `keep` is called between passes to save the film.
/// A pass begins only if, by the speed of the earlier ones, it ends before the time limit; the first sample of every
/// pixel is always taken.
///
/// Errors: those of `keep`.
pub fn render_in_passes(
    render: &mut RenderInProgress,
    limits: &Limits,
    watch: &dyn Watch,
    keep: &mut dyn FnMut(&Film) -> Result,
) -> Result<Outcome> {
    let mut passes = Passes {
        started: Instant::now(),
        written: Instant::now(),
        writing: Duration::ZERO,
        speed: Speed::default(),
        limits: *limits,
    };
    let mut outcome = Outcome::default();
    let max = render.sampling.samples;
    if let Some(adaptive) = limits.adaptive {
        if render.film.planned.is_empty() {
            if !render.film.pilot {
                render.begin_pilot();
            }
            if !passes.run_to(render, steps_of(adaptive.pilot), watch, keep, &mut outcome)? {
                return passes.ended(render, outcome);
            }
            let planned = planned_samples(&render.film, adaptive.error);
            render.begin_planned(planned);
        }
        let end = steps_of(render.film.most_planned().min(max));
        passes.run_to(render, end, watch, keep, &mut outcome)?;
        outcome.achieved = Some(achieved(&render.film, adaptive.error, max));
    } else {
        passes.run_to(render, steps_of(max), watch, keep, &mut outcome)?;
    }
    passes.ended(render, outcome)
}

/// The speed of sampling so far.
#[derive(Clone, Copy, Debug, Default)]
struct Speed {
    samples: u64,
    time: Duration,
}

impl Speed {
    fn take(&mut self, samples: u64, time: Duration) {
        // Only the longest pass counts: the first passes are small, and their times are unreliable.
        if time > self.time {
            *self = Self::default();
        }
        self.samples += samples;
        self.time += time;
    }

    fn time_of(&self, samples: u64) -> Duration {
        self.time.mul_f64(samples as f64 / self.samples.max(1) as f64)
    }
}

struct Passes {
    started: Instant,
    /// When the last writing ended.
    written: Instant,
    /// How long it took.
    writing: Duration,
    speed: Speed,
    limits: Limits,
}

impl Passes {
    /// Runs passes up to a step; returns whether it was reached.
    fn run_to(
        &mut self,
        render: &mut RenderInProgress,
        end: u32,
        watch: &dyn Watch,
        keep: &mut dyn FnMut(&Film) -> Result,
        outcome: &mut Outcome,
    ) -> Result<bool> {
        loop {
            let done = render.film.least_done();
            watch.expect(render.film.samples_between(0, end), samples_after(done), samples_after(end));
            if done >= end {
                return Ok(true);
            }
            let Some(next) = self.next(&render.film, done, end) else {
                outcome.out_of_time = true;
                return Ok(false);
            };
            let (before, began) = (render.film.samples_between(done, next), Instant::now());
            match render.advance(next, watch) {
                Ok(()) => {}
                Err(Error::Interrupted) => {
                    outcome.stopped = true;
                    return Ok(false);
                }
                Err(error) => return Err(error),
            }
            self.speed.take(before, began.elapsed());
            if next < end && self.is_time_to_write() {
                let began = Instant::now();
                keep(&render.film)?;
                self.writing = began.elapsed();
                self.written = Instant::now();
            }
        }
    }

    fn is_time_to_write(&self) -> bool {
        let soonest = if self.writing.is_zero() { FIRST } else { SOONEST };
        let pause = self.limits.write_every.unwrap_or((self.writing * FRACTION_FOR_WRITING).max(soonest));
        self.written.elapsed() >= pause
    }

    /// The step that the next pass advances to; none where the time is up.
    fn next(&self, film: &Film, done: u32, end: u32) -> Option<u32> {
        let predicted = |to: u32| self.speed.time_of(film.samples_between(done, to));
        if done < WHOLE {
            let at_once = done > 0 && predicted(WHOLE) < AT_ONCE;
            return Some(if at_once { WHOLE } else { done + 1 });
        }
        let longest = self.limits.write_every.unwrap_or(LONGEST_PASS).min(LONGEST_PASS);
        let left = self.limits.time.map(|time| time.saturating_sub(self.started.elapsed() + self.writing));
        let max = left.map_or(longest, |left| left.min(longest));
        // Twice as many samples as there are, or as many as fit into the time; at least one, unless even that does not
        // fit.
        let mut samples = samples_after(done).min(end - done);
        while samples > 1 && predicted(done + samples) > max {
            samples = samples.div_ceil(2);
        }
        let fits = left.is_none_or(|left| predicted(done + samples) <= left);
        fits.then_some(done + samples)
    }

    fn ended(&self, render: &RenderInProgress, mut outcome: Outcome) -> Result<Outcome> {
        outcome.samples = samples_after(render.film.least_done());
        outcome.time = self.started.elapsed();
        Ok(outcome)
    }
}

impl Film {
    /// The number of steps of the tile that is furthest behind.
    pub fn least_done(&self) -> u32 {
        self.done.iter().copied().min().unwrap_or(0)
    }

    /// The greatest number of samples planned for any pixel.
    pub fn most_planned(&self) -> u32 {
        self.planned.iter().flatten().copied().max().unwrap_or(0)
    }

    /// The number of pixel samples between two steps, if all tiles are where the last one is.
    pub fn samples_between(&self, from: u32, to: u32) -> u64 {
        let pixels = u64::from(self.width) * u64::from(self.height);
        // A lattice has four times as many pixels as the one before it; the first has one pixel in 64.
        let of_first = |steps: u32| match steps {
            0 => 0,
            steps if steps >= WHOLE => pixels,
            steps => pixels >> (2 * (WHOLE - steps)),
        };
        let further = |steps: u32| u64::from(samples_after(steps).max(1) - 1);
        if self.planned.is_empty() {
            return of_first(to) - of_first(from) + (further(to) - further(from)) * pixels;
        }
        let of_pixels = |steps: u32| -> u64 {
            let cap = further(steps);
            self.planned.iter().flatten().map(|&planned| u64::from(planned.saturating_sub(1)).min(cap)).sum()
        };
        of_first(to) - of_first(from) + of_pixels(to) - of_pixels(from)
    }
}
