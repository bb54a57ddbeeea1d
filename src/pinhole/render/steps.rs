use crate::film::FIRST_SAMPLE_STEPS;
use crate::rays::Tile;

/// The lattices of a picture's first sample, by the distance between their pixels, coarsest first.
pub const LATTICES: [u32; FIRST_SAMPLE_STEPS as usize] = [8, 4, 2, 1];

/// The number of steps after which every pixel has its first sample.
pub const WHOLE: u32 = FIRST_SAMPLE_STEPS;

/// The number of steps after which every pixel has this many samples: the first sample takes four, each further one
/// takes one.
pub fn steps_of(samples: u32) -> u32 {
    samples.saturating_add(WHOLE - 1)
}

/// The number of samples that every pixel has after so many steps; 0 until each has its first.
pub fn samples_after(steps: u32) -> u32 {
    steps.saturating_sub(WHOLE - 1)
}

/// The step at which the next sample after so many steps ends, or the last one that is asked for, and the sample's number.
pub fn next_sample(done: u32, to: u32) -> (u32, u32) {
    let next = if done < WHOLE { to.min(WHOLE) } else { done + 1 };
    (next, samples_after(next).max(1) - 1)
}

/// One run of the schedule over a tile: the number of a sample, for the pixels of some lattices or for all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Run {
    /// The sample's number.
    pub sample: u32,
    /// For the first sample, the range of indices into [`LATTICES`] that this run covers.
    lattices: [usize; 2],
}

// ANCHOR: runs
/// The runs that advance a tile from `done` steps to `to`.
///
/// Consecutive lattices are run at once, since a pixel's sums do not depend on its neighbours'.
pub fn runs(done: u32, to: u32) -> Vec<Run> {
    let lattices = [done.min(WHOLE) as usize, to.min(WHOLE) as usize];
    let first = (lattices[0] < lattices[1]).then_some(Run { sample: 0, lattices });
    let later = done.max(WHOLE)..to.max(WHOLE);
    let later = later.map(|step| Run { sample: step - (WHOLE - 1), lattices: [0, LATTICES.len()] });
    first.into_iter().chain(later).collect()
}
// ANCHOR_END: runs

impl Run {
    /// The first sample of all pixels.
    pub const FIRST: Self = Self::of_all(0);

    /// A sample of all pixels.
    pub const fn of_all(sample: u32) -> Self {
        Self { sample, lattices: [0, LATTICES.len()] }
    }

    /// The number of steps that a tile has finished after this run.
    pub fn ends(&self) -> u32 {
        if self.sample == 0 { self.lattices[1] as u32 } else { self.sample.saturating_add(WHOLE) }
    }

    /// Whether a pixel is on the lattices of this run but on none of an earlier one.
    fn holds(&self, x: u32, y: u32) -> bool {
        let on = |lattice: u32| x.is_multiple_of(lattice) && y.is_multiple_of(lattice);
        let coarser = self.lattices[0].checked_sub(1).is_some_and(|before| on(LATTICES[before]));
        on(LATTICES[self.lattices[1] - 1]) && !coarser
    }

    /// The rows of a tile's film that take part, ascending; `planned` is the number of samples for each row, where
    /// sampling is adaptive.
    pub fn rows(&self, tile: Tile, planned: Option<&[u32]>, into: &mut Vec<u32>) {
        into.clear();
        let wanted = |row: usize| planned.is_none_or(|planned| self.sample < planned[row]);
        let held = |row: usize| {
            let [x, y] = tile.pixel_of(row);
            self.holds(x, y)
        };
        let all = self.lattices == [0, LATTICES.len()];
        into.extend((0..tile.rows()).filter(|&row| wanted(row) && (all || held(row))).map(|row| row as u32));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sample_of_every_pixel_is_run_once_and_in_order_however_the_steps_are_cut() {
        let (mut tried, mut cuts) = (0, 0);
        for tile in [Tile { x: 0, y: 0, width: 16, height: 9 }, Tile { x: 31, y: 62, width: 31, height: 5 }] {
            for cut in 0_u32..1 << 7 {
                let (mut done, mut next) = (0, vec![0; tile.rows()]);
                let ends = (1..=7).filter(|end| cut >> (end - 1) & 1 == 1).chain([steps_of(5)]);
                for to in ends {
                    for run in runs(done, to) {
                        let mut rows = Vec::new();
                        run.rows(tile, None, &mut rows);
                        for row in rows {
                            assert_eq!(next[row as usize], run.sample, "row {row}");
                            next[row as usize] += 1;
                            tried += 1;
                        }
                    }
                    assert_eq!(runs(done, to).last().map_or(done, Run::ends), to.max(done), "the last run ends there");
                    done = to;
                }
                assert!(next.iter().all(|&samples| samples == 5), "{next:?}");
                cuts += 1;
            }
        }
        eprintln!("steps: {tried} samples, a render divided into passes in {cuts} different ways");
    }

    #[test]
    fn steps_and_samples_lead_to_each_other() {
        assert_eq!([0, 3, 4, 5, 19].map(samples_after), [0, 0, 1, 2, 16]);
        assert_eq!([1, 2, 16].map(steps_of), [4, 5, 19]);
        // A damaged checkpoint may hold any number of steps; none of them overflows.
        assert_eq!(samples_after(u32::MAX), u32::MAX - 3);
    }

    #[test]
    fn pixels_with_fewer_planned_samples_stop_sooner() {
        let tile = Tile { x: 0, y: 0, width: 2, height: 1 };
        let mut rows = Vec::new();
        let counts: Vec<Vec<u32>> = runs(0, steps_of(4))
            .iter()
            .map(|run| {
                run.rows(tile, Some(&[1, 3]), &mut rows);
                rows.clone()
            })
            .collect();
        assert_eq!(counts, [vec![0, 1], vec![1], vec![1], vec![]]);
    }
}
