//! Which runs a report makes: sample counts, seeds, and the batches of the reference.

use serde::{Deserialize, Serialize};

/// Where the reference's seeds begin: far above those of runs.
const REFERENCE_SEEDS: u64 = 1_000_000;

/// The runs of a report.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Ladder {
    /// Samples a pixel, from few to many.
    pub samples: Vec<u32>,
    /// Seeds a sample count.
    pub seeds: u32,
    /// Batches of each reference, of disjoint seeds.
    pub batches: u32,
    /// Samples a pixel of each batch.
    pub batch_samples: u32,
}

impl Ladder {
    /// Sample counts 4ᵏ, of which a `quick` report has four instead of five; 16 seeds each, or 8.
    ///
    /// The reference has 32 times the samples of the longest run, and its variance is subtracted.
    pub fn new(quick: bool) -> Self {
        let levels = if quick { 4 } else { 5 };
        let samples: Vec<u32> = (0..levels).map(|power| 1 << (2 * power)).collect();
        let longest = 1 << (2 * (levels - 1));
        Self { samples, seeds: if quick { 8 } else { 16 }, batches: 8, batch_samples: 4 * longest }
    }

    /// The seed of a run: another one for each level, so that levels are independent of each other.
    pub fn seed(&self, level: usize, run: u32) -> u64 {
        1 + level as u64 * u64::from(self.seeds) + u64::from(run)
    }

    /// The seeds of all runs.
    pub fn seeds(&self) -> Vec<u64> {
        (0..self.samples.len()).flat_map(|level| (0..self.seeds).map(move |run| self.seed(level, run))).collect()
    }

    /// The seeds of the reference's batches.
    pub fn reference_seeds(&self) -> Vec<u64> {
        (0..u64::from(self.batches)).map(|batch| REFERENCE_SEEDS + batch).collect()
    }

    /// Samples a pixel of a whole reference.
    pub fn reference_samples(&self) -> u64 {
        u64::from(self.batches) * u64::from(self.batch_samples)
    }

    /// Samples a pixel that one variant's runs take together.
    pub fn samples_of_runs(&self) -> u64 {
        u64::from(self.seeds) * self.samples.iter().map(|&samples| u64::from(samples)).sum::<u64>()
    }
}

#[cfg(test)]
mod tests {
    use super::super::refused::disjoint;
    use super::*;

    #[test]
    fn no_seed_is_used_twice() {
        for quick in [false, true] {
            let ladder = Ladder::new(quick);
            let mut seeds = ladder.seeds();
            assert_eq!(disjoint(&seeds, &ladder.reference_seeds()), Ok(()));
            let count = seeds.len();
            seeds.sort_unstable();
            seeds.dedup();
            assert_eq!(seeds.len(), count);
            assert_eq!(count, ladder.samples.len() * ladder.seeds as usize);
        }
        assert_eq!(Ladder::new(false).samples, [1, 4, 16, 64, 256]);
    }
}
