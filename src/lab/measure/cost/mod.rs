//! What the stages of a scene cost: nanoseconds a row, and how far off what they write is.
//!
//! Reads: a scene and the stages on offer. Writes: a [`Cost`], times from whole renders on one thread, errors from the
//! columns of that very frame.

mod exact_frame;
mod kept;
mod probe;

pub use kept::{FILM, KeptStage, kept_costs, kept_film, kept_stages, place};
pub use probe::{PROBES, stage_errors};

use bevy_ecs::prelude::*;
use pinhole::Result;
use pinhole::plan::{Census, Stage, plan};
use pinhole::render::{Execution, Lap, Watch, render};
use std::fmt;

/// Renders of which the first is left out: it finds caches and pages cold.
pub const RENDERS: usize = 16;

/// What one stage costs.
#[derive(Clone, Debug, PartialEq)]
pub struct StageCost {
    /// The stage's name.
    pub stage: &'static str,
    /// Rows of what it wrote over the frame.
    pub rows: u64,
    /// Nanoseconds a row: the 10th, the 50th and the 90th percentile; none where it had no rows.
    pub nanoseconds: Option<[f64; 3]>,
    /// How far what it writes is off, in words; a dash where nothing exact is at hand.
    pub error: String,
}

/// What the stages of a scene cost, in the plan's order.
#[derive(Clone, Debug, PartialEq)]
pub struct Cost {
    /// One a kept stage.
    pub stages: Vec<StageCost>,
}

/// The names of the stages that a scene keeps, in the plan's order: what [`measure`] would tell the cost of.
///
/// Errors: there is no plan.
pub fn stage_names(scene: &World, offer: &[Stage]) -> Result<Vec<&'static str>> {
    Ok(plan(&Census::of(scene), offer)?.stages.iter().map(|stage| stage.name).collect())
}

/// Renders the scene on one thread again and again, then probes one frame; the scene must ask for statistics.
///
/// Errors: what a render would be refused for, or a stop by the one who watches.
pub fn measure(scene: &World, offer: &[Stage], watch: &dyn Watch) -> Result<Cost> {
    let execution = Execution { threads: Some(1), ..Execution::default() };
    let mut runs: Vec<Vec<Lap>> = Vec::with_capacity(RENDERS);
    let mut names = Vec::new();
    for _ in 0..RENDERS {
        let rendered = render(scene, offer, &execution, watch)?;
        names = rendered.plan.stages.iter().map(|stage| stage.name).collect();
        runs.push(rendered.laps);
    }
    let errors = stage_errors(scene, offer)?;
    let of_stage = |(slot, &stage): (usize, &&'static str)| {
        let laps: Vec<Lap> = runs[1..].iter().filter_map(|laps| laps.get(slot).copied()).collect();
        let error =
            errors.iter().find(|(name, _)| *name == stage).map_or_else(|| "-".into(), |(_, error)| error.clone());
        StageCost { stage, rows: laps.first().map_or(0, |lap| lap.rows), nanoseconds: percentiles(&laps), error }
    };
    Ok(Cost { stages: names.iter().enumerate().map(of_stage).collect() })
}

/// The 10th, the 50th and the 90th percentile of nanoseconds a row.
fn percentiles(laps: &[Lap]) -> Option<[f64; 3]> {
    let with_rows = laps.iter().filter(|lap| lap.rows > 0);
    let mut each: Vec<f64> = with_rows.map(|lap| lap.time.as_nanos() as f64 / lap.rows as f64).collect();
    each.sort_by(f64::total_cmp);
    let last = each.len().checked_sub(1)?;
    Some([0.1, 0.5, 0.9].map(|part| each[(part * last as f64).round() as usize]))
}

impl fmt::Display for Cost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{:<31}{:>8}{:>9}{:>18}   error of what it writes", "what ran", "rows", "ns a row", "10 to 90 %")?;
        for StageCost { stage, rows, nanoseconds, error } in &self.stages {
            let (median, range) = match nanoseconds {
                Some([low, median, high]) => (format!("{median:.2}"), format!("{low:.2} to {high:.2}")),
                None => ("-".into(), "-".into()),
            };
            writeln!(f, "{stage:<30} {rows:>8}{median:>9}{range:>18}   {error}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn the_median_stands_between_its_percentiles() {
        let laps: Vec<Lap> = (0..15).map(|time| Lap { time: Duration::from_nanos(time * 10), rows: 10 }).collect();
        assert_eq!(percentiles(&laps), Some([1.0, 7.0, 13.0]));
        assert_eq!(percentiles(&[Lap::default()]), None);
    }
}
