use super::clock::Lap;
use crate::film::{Curve, Film};
use crate::plan::Plan;
use std::time::Duration;

/// What a render leaves.
pub struct Rendered {
    /// What ran and what did not.
    pub plan: Plan,
    /// The light that arrived.
    pub film: Film,
    /// A lap a kept stage, summed over workers; empty where no statistics were asked for.
    pub laps: Vec<Lap>,
    /// Workers.
    pub threads: usize,
    /// From the first tile to the last.
    pub time: Duration,
    /// Bytes that the tables take.
    pub table_bytes: usize,
}

impl Rendered {
    /// How the film becomes a picture: light by the sRGB curve, a view's numbers as they are.
    pub fn curve(&self) -> Curve {
        if self.plan.view.is_some() { Curve::Straight } else { Curve::Srgb }
    }
}
