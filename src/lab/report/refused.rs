//! What a report does not say, and why.

use std::fmt;

/// The largest fraction of the reference's samples that a run may have where the reference's variance is not subtracted.
pub const MAX_OF_REFERENCE: f64 = 0.01;

/// A number that a report refuses, in one sentence each.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub enum Refused {
    /// A run and the reference would share their noise.
    SharedSeed {
        /// The seed that both have.
        seed: u64,
    },
    /// The reference is too noisy for the longest run, and its own variance is not known.
    ReferenceTooShort {
        /// Samples a pixel of the longest run.
        longest: u64,
        /// Samples a pixel of the reference.
        reference: u64,
    },
    /// The error is smaller than what the reference is uncertain by.
    BelowReference {
        /// Samples a pixel of the run.
        samples: u64,
        /// The MSE that came out.
        mse: f64,
        /// The least that the reference can tell from 0.
        min: f64,
    },
    /// Too few seeds for an interval.
    TooFewSeeds {
        /// How many there are.
        seeds: usize,
    },
    /// No error at all, which has no logarithm.
    NoError {
        /// Samples a pixel of the run.
        samples: u64,
    },
    /// Fewer than two sample counts, which make no line.
    TooFewLevels,
    /// The curves have no run time in common.
    NoCommonTime,
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::SharedSeed { seed } => write!(
                f,
                "seed {seed} is a run's and the reference's: the two would share their noise, and the error would come \
                 out too small; give the reference seeds of its own"
            ),
            Self::ReferenceTooShort { longest, reference } => write!(
                f,
                "no slope: the longest run has {longest} samples a pixel and the reference {reference} in one batch, \
                 whose variance is unknown; it needs {} in one batch, or two batches of disjoint seeds",
                longest * 100
            ),
            Self::BelowReference { samples, mse, min } => write!(
                f,
                "the MSE of {mse:.1e} at {samples} samples a pixel is below {min:.1e}, the least that this reference \
                 can tell from 0"
            ),
            Self::TooFewSeeds { seeds } => {
                write!(f, "no interval: {seeds} seeds are too few, {} are needed", super::ensemble::FEWEST)
            }
            Self::NoError { samples } => {
                write!(f, "no slope: at {samples} samples a pixel no error is left, and 0 has no logarithm")
            }
            Self::TooFewLevels => write!(f, "no slope: a line needs two sample counts"),
            Self::NoCommonTime => write!(f, "no reading at equal time: the two curves have no run time in common"),
        }
    }
}

/// Refuses seeds that runs and reference have in common.
pub fn disjoint(runs: &[u64], reference: &[u64]) -> Result<(), Refused> {
    match runs.iter().find(|seed| reference.contains(seed)) {
        Some(&seed) => Err(Refused::SharedSeed { seed }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shared_seed_is_refused_by_its_number() {
        assert_eq!(disjoint(&[1, 2, 3], &[4, 5]), Ok(()));
        let refused = disjoint(&[1, 2, 3], &[9, 3]).expect_err("refused");
        assert_eq!(refused, Refused::SharedSeed { seed: 3 });
        assert!(refused.to_string().starts_with("seed 3 is a run's and the reference's: "));
    }
}
