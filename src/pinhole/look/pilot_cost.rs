use crate::render::ProbeRun;

/// So many runs are averaged over for the cost of a ray; in a picture of one small tile, it is traced again for that.
const ENOUGH_RUNS: usize = 8;
/// From so many runs that were given up a lower bound is taken.
const ENOUGH_FOR_A_BOUND: usize = 3;

/// What runs over small tiles cost.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cost {
    /// Completed runs but the first, which finds everything cold: how many, their rays, and their seconds.
    whole: (usize, usize, f64),
    /// All runs.
    tried: (usize, usize, f64),
    is_unknown: bool,
}

impl Cost {
    /// Adds a run.
    pub(super) fn add(&mut self, rays: usize, run: ProbeRun, is_first: bool) {
        let Some(time) = run.time.map(|time| time.as_secs_f64()) else {
            self.is_unknown = true;
            return;
        };
        let take = |(runs, all, seconds): (usize, usize, f64)| (runs + 1, all + rays, seconds + time);
        self.tried = take(self.tried);
        if run.whole && !is_first {
            self.whole = take(self.whole);
        }
    }

    /// Whether the runs are enough to be averaged over.
    pub(super) fn is_known(&self) -> bool {
        self.is_unknown || self.whole.0 >= ENOUGH_RUNS
    }

    /// Seconds a ray; the least that it can be where runs were given up. None from one run or two.
    pub(super) fn of_a_ray(&self, is_least: bool) -> Option<f64> {
        let ((runs, rays, seconds), enough) =
            if is_least { (self.tried, ENOUGH_FOR_A_BOUND) } else { (self.whole, ENOUGH_RUNS) };
        (!self.is_unknown && runs >= enough && rays > 0).then(|| seconds / rays as f64)
    }
}
