use super::adaptive::{Achieved, achieved, planned_samples};
use super::steps::{WHOLE, samples_after, steps_of};
use super::{RenderInProgress, Watch};
use crate::film::Film;
use crate::scene::Adaptive;
use crate::{Error, Result};
use std::time::{Duration, Instant};

/// Nobody sees a picture that is written again sooner than this.
const SOONEST: Duration = Duration::from_millis(500);
/// Writing takes at most one part in so many of the time.
const SHARE_OF_WRITING: u32 = 20;
/// No pass is meant to take longer than this, so that what is on disk is never much older.
const LONGEST_PASS: Duration = Duration::from_secs(5);
/// The first samples of all pixels are one pass where they take less than this.
const AT_ONCE: Duration = Duration::from_millis(250);

/// When a render ends, and how often what it has is kept.
#[derive(Clone, Copy, Debug, Default)]
pub struct Limits {
    /// The time after which no further pass begins.
    pub time: Option<Duration>,
    /// How much time goes by between two writings; none for as often as writing takes at most 5 % of the time.
    pub write_every: Option<Duration>,
    /// The error that each pixel is to have.
    pub adaptive: Option<Adaptive>,
}

/// What a render in passes came to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outcome {
    /// Whether the one who watches stopped it.
    pub stopped: bool,
    /// Whether the time was up before the samples were done.
    pub out_of_time: bool,
    /// Samples that every pixel has, unless it was to have fewer.
    pub samples: u32,
    /// What was asked and what came of it, where the number of samples was decided pixel by pixel.
    pub achieved: Option<Achieved>,
    /// From the beginning to the end of the last pass, writing in between included.
    pub time: Duration,
}

/// Brings a render to its end in passes of growing numbers of samples, low resolution first.
///
/// `keep` is called between passes, to write what there is.
/// A pass begins only where, by the speed of those before it, it ends before the time is up; the first sample of every
/// pixel is always taken.
///
/// Errors: what `keep` says.
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
    let most = render.sampling.samples;
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
        let end = steps_of(render.film.most_planned().min(most));
        passes.run_to(render, end, watch, keep, &mut outcome)?;
        outcome.achieved = Some(achieved(&render.film, adaptive.error, most));
    } else {
        passes.run_to(render, steps_of(most), watch, keep, &mut outcome)?;
    }
    passes.ended(render, outcome)
}

/// The speed of samples so far.
#[derive(Clone, Copy, Debug, Default)]
struct Speed {
    samples: u64,
    time: Duration,
}

impl Speed {
    fn take(&mut self, samples: u64, time: Duration) {
        // What a long pass says counts alone: the first passes are small and say little.
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
    /// When the last writing was over.
    written: Instant,
    /// How long it took.
    writing: Duration,
    speed: Speed,
    limits: Limits,
}

impl Passes {
    /// Runs passes up to a step; whether it got there.
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
        let pause = self.limits.write_every.unwrap_or((self.writing * SHARE_OF_WRITING).max(SOONEST));
        self.written.elapsed() >= pause
    }

    /// The step that the next pass goes to; none where the time is up.
    fn next(&self, film: &Film, done: u32, end: u32) -> Option<u32> {
        let predicted = |to: u32| self.speed.time_of(film.samples_between(done, to));
        if done < WHOLE {
            let at_once = done > 0 && predicted(WHOLE) < AT_ONCE;
            return Some(if at_once { WHOLE } else { done + 1 });
        }
        let longest = self.limits.write_every.unwrap_or(LONGEST_PASS).min(LONGEST_PASS);
        let left = self.limits.time.map(|time| time.saturating_sub(self.started.elapsed() + self.writing));
        let most = left.map_or(longest, |left| left.min(longest));
        // Twice as many samples as there are, or as many as fit; at least one, unless the time is up before it ends.
        let mut samples = samples_after(done).min(end - done);
        while samples > 1 && predicted(done + samples) > most {
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
    /// The fewest steps that a tile has behind it.
    pub fn least_done(&self) -> u32 {
        self.done.iter().copied().min().unwrap_or(0)
    }

    /// The most samples that a pixel is to get.
    pub fn most_planned(&self) -> u32 {
        self.planned.iter().flatten().copied().max().unwrap_or(0)
    }

    /// How many samples of all pixels lie between two steps, if all tiles are where the least is.
    pub fn samples_between(&self, from: u32, to: u32) -> u64 {
        let pixels = u64::from(self.width) * u64::from(self.height);
        // A quarter of a lattice's pixels were on the one before it; the first holds 1 of 64.
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
