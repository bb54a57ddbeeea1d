use super::{Hook, RenderWorld};
use crate::plan::{ColumnKind, Plan, Stage};
use crate::rays::Tile;
use bevy_ecs::prelude::*;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The time that a stage took over all tiles of a worker.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lap {
    /// Time spent in the stage.
    pub time: Duration,
    /// Rows that it processed.
    pub rows: u64,
}

/// A stopwatch for the stages of one worker; exists only where statistics are requested.
#[derive(Resource, Debug)]
pub struct StageClock {
    last: Instant,
    /// One lap for each stage that the plan keeps, in the plan's order.
    pub laps: Vec<Lap>,
}

impl StageClock {
    /// A stopwatch with a lap for each stage that the plan keeps.
    pub fn new(plan: &Plan) -> Self {
        Self { last: Instant::now(), laps: vec![Lap::default(); plan.stages.len()] }
    }

    /// Starts timing, before the first stage of a tile.
    pub fn start(&mut self) {
        self.last = Instant::now();
    }

    fn lap(&mut self, slot: usize, ended: Instant, rows: u64) {
        self.laps[slot].time += ended - self.last;
        self.laps[slot].rows += rows;
        self.start();
    }
}

/// The laps of a worker's world so far; none where no statistics were requested, or the world is not made yet.
pub(super) fn laps_of(world: &Mutex<Option<RenderWorld>>) -> Option<Vec<Lap>> {
    let world = world.lock().unwrap_or_else(PoisonError::into_inner);
    Some(world.as_ref()?.world.get_resource::<StageClock>()?.laps.clone())
}

/// A system after each stage that records its lap; the system's own work falls between two laps.
pub(super) fn clock_hook() -> Hook {
    Arc::new(|slot, stage, plan| {
        let counted = counted_columns(stage, plan);
        let take_lap = move |world: &mut World, tiles: &mut QueryState<EntityRef<'static>, With<Tile>>| {
            let ended = Instant::now();
            let rows_of = |tile| counted.iter().map(|column| (column.rows)(&tile) as u64).max().unwrap_or(0);
            let rows = tiles.iter(world).map(rows_of).sum();
            world.resource_mut::<StageClock>().lap(slot, ended, rows);
        };
        take_lap.into_configs()
    })
}

/// The columns whose number of rows says how much a stage did: the list of rows that it processes, where it updates
/// some rows of an existing column, and otherwise the columns that it writes.
fn counted_columns(stage: &Stage, plan: &Plan) -> Vec<ColumnKind> {
    let fills_in = !stage.appends && stage.writes.iter().all(|column| stage.reads.contains(column));
    let list = stage.reads.iter().find(|column| fills_in && column.unit == "rows");
    let of_stage = |column: &&ColumnKind| stage.writes.contains(column);
    match list {
        Some(list) => vec![*list],
        None => plan.columns.iter().filter(of_stage).copied().collect(),
    }
}

/// The processor time of this thread so far; none on systems that do not measure it.
pub(super) fn thread_time() -> Option<Duration> {
    #[cfg(any(unix, windows))]
    let time = cpu_time::ThreadTime::try_now().ok().map(|time| time.as_duration());
    #[cfg(not(any(unix, windows)))]
    let time = None;
    time
}
