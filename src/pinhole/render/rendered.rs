use super::clock::Lap;
use crate::film::{Curve, Film};
use crate::plan::Plan;
use std::time::Duration;

/// The result of a render.
pub struct Rendered {
    /// The stages that ran, and those that did not.
    pub plan: Plan,
    /// The accumulated radiance.
    pub film: Film,
    /// One lap per kept stage, summed over workers; empty where no statistics were requested.
    pub laps: Vec<Lap>,
    /// The number of workers.
    pub threads: usize,
    /// Elapsed time from the first tile to the last.
    pub time: Duration,
    /// Memory of the tables, in bytes.
    pub table_bytes: usize,
}

impl Rendered {
    /// The curve that turns the film into a picture: sRGB for radiance, the identity for a view's values.
    pub fn curve(&self) -> Curve {
        if self.plan.view.is_some() { Curve::Straight } else { Curve::Srgb }
    }
}
