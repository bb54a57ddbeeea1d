//! What a report says: every number of its page, as it goes to JSON.

use super::interval::Interval;
use super::ladder::Ladder;
use super::provenance::Provenance;
use serde::{Deserialize, Serialize};

/// A number with its interval, or the sentence by which it is refused.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Statistic {
    /// It is told.
    Value(Interval),
    /// It is not, and why.
    Refused(String),
}

impl Statistic {
    /// The number, where it is told.
    pub fn value(&self) -> Option<Interval> {
        match self {
            Self::Value(interval) => Some(*interval),
            Self::Refused(_) => None,
        }
    }

    /// A number, or what it is refused for.
    pub fn of<R: ToString>(told: Result<Interval, R>) -> Self {
        match told {
            Ok(interval) if <[f64; 3]>::from(interval).iter().all(|end| end.is_finite()) => Self::Value(interval),
            Ok(interval) => {
                Self::Refused(format!("no value: {} is so uncertain that its interval has no end", interval.value))
            }
            Err(refused) => Self::Refused(refused.to_string()),
        }
    }
}

/// Times in seconds: the median with its interval, and the median distance from it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// The median, its interval by BCa.
    pub median: Interval,
    /// The median distance from the median.
    pub mad: f64,
    /// Standard deviation over mean.
    pub variation: f64,
}

/// All runs of one sample count.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LevelSummary {
    /// Samples a pixel.
    pub samples: u32,
    /// Mean of (x − r)², the reference's variance subtracted.
    pub mse: Statistic,
    /// Mean of (x − r)² / (r² + 0.01), the reference's part subtracted.
    pub rel_mse: f64,
    /// The same without the tail.
    pub trimmed_rel_mse: f64,
    /// Mean of |x − r|, as measured.
    pub mae: f64,
    /// The largest |x − r| of any run.
    pub largest: f64,
    /// The fraction of the MSE that comes from the 0.1 % of pixels that add most to it: the median over runs.
    pub tail_fraction: f64,
    /// Variance from seed to seed.
    pub variance: Statistic,
    /// bias².
    pub bias_squared: Statistic,
    /// 1 / (MSE · T).
    pub efficiency: Statistic,
    /// CPU time of the render alone.
    pub render: Spread,
    /// CPU time of plan, tables and render.
    pub whole: Spread,
    /// Wall time of the same: the median.
    pub wall: f64,
    /// Numbers of all images that are NaN, +∞, −∞, negative.
    pub odd: [u64; 4],
    /// Samples that did not join a film.
    pub rejected: u64,
}

/// What a stage took in the run with timers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StageSummary {
    /// Its name.
    pub stage: String,
    /// Rows that it visited.
    pub rows: u64,
    /// Milliseconds.
    pub milliseconds: f64,
}

/// One way to make the picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VariantSummary {
    /// What it is called.
    pub name: String,
    /// Its sampler and filter, as a scene file writes them.
    pub sampling: String,
    /// By sample count.
    pub levels: Vec<LevelSummary>,
    /// The slope of ln MSE over ln samples.
    pub slope: Statistic,
    /// The variance of its reference's mean, V_ref.
    pub reference_variance: f64,
    /// Fingerprint of its scene.
    pub scene: String,
    /// Digest of its film of a few samples a pixel, which its errors belong to.
    pub film: String,
    /// Camera and shadow rays a sample; a camera ray's path has one segment.
    pub rays: [f64; 2],
    /// Shapes that each ray is tested against: all, for there is no hierarchy.
    #[serde(default)]
    pub tests_a_ray: usize,
    /// Its stages, in a run with timers of 16 samples a pixel.
    pub stages: Vec<StageSummary>,
}

/// How a variant compares with the first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// The variant.
    pub variant: String,
    /// At what: so many samples, or so many seconds.
    pub at: At,
    /// Its MSE over the first one's: below 1 it is the better.
    pub mse: Statistic,
    /// Its efficiency over the first one's, at equal samples: above 1 it is the better.
    pub efficiency: Option<Statistic>,
}

/// What two variants have alike where they are compared.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum At {
    /// Samples a pixel.
    Samples(u32),
    /// CPU seconds of the render.
    Seconds(f64),
}

/// A whole report, without its images.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// The chapter or scene.
    pub name: String,
    /// What it is about.
    pub title: String,
    /// What it was compared with, as typed.
    pub against: Vec<String>,
    /// What is known of each variant's scene before its runs.
    #[serde(skip)]
    pub scenes: Vec<SceneSummary>,
    /// Pixels from left to right and from top to bottom.
    pub size: [u32; 2],
    /// Which runs were made.
    pub ladder: Ladder,
    /// Workers of a run.
    pub threads: usize,
    /// The variants, the first of which the others are compared with.
    pub variants: Vec<VariantSummary>,
    /// Comparisons with the first.
    pub comparisons: Vec<Comparison>,
    /// The level of each interval of a comparison, at which all hold together with 95 %.
    pub family_level: f64,
    /// CPU time with timers over that without.
    pub timers: Option<Interval>,
    /// What may make the times unfit, in sentences.
    pub flags: Vec<String>,
    /// Where and when.
    pub provenance: Provenance,
}

/// A variant's scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneSummary {
    /// Its fingerprint.
    pub fingerprint: String,
    /// Digest of its film of a few samples a pixel.
    pub film: String,
    /// How many shapes it holds.
    pub shapes: usize,
}
