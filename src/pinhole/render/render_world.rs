use super::clock::{StageClock, clock_hook};
use super::steps::Run;
use crate::Result;
use crate::extract::validate;
use crate::film::FilmTile;
use crate::follow::{Stop, check_materials_are_followed, is_whole};
use crate::plan::{
    Bounce, Census, ColumnKind, ExtractedTable, Plan, RowKind, Sample, Stage, TileSystems, check_added, in_order, plan,
};
use crate::rays::{ActivePixels, Depth, PixelSamples, SampleNumber, Tile};
use crate::shade::check_shapes_are_intersected;
use bevy_ecs::prelude::*;
use bevy_ecs::schedule::{ScheduleConfigs, ScheduleLabel, SingleThreadedExecutor};
use bevy_ecs::system::ScheduleSystem;
use std::mem;
use std::sync::Arc;

/// Makes a system that runs right after each stage, for timing and recording; it must not change the picture.
pub type Hook = Arc<dyn Fn(usize, &Stage, &Plan) -> ScheduleConfigs<ScheduleSystem> + Send + Sync>;

/// Checks a scene, plans it, and extracts its tables.
///
/// Errors: the reason why the scene is invalid, or why there is no plan.
pub fn prepare(scene: &Census<'_>, offer: &[Stage]) -> Result<(Plan, Vec<ExtractedTable>)> {
    validate(scene)?;
    check_added(scene, offer)?;
    let plan = plan(scene, offer)?;
    check_shapes_are_intersected(scene, offer, &plan)?;
    check_materials_are_followed(scene, offer)?;
    let tables = plan.tables.iter().map(|table| (table.extract)(scene)).collect::<std::result::Result<Vec<_>, _>>()?;
    Ok((plan, tables))
}

/// The world of one worker: tiles with their columns, the shared tables, and the schedule that the plan built.
pub struct RenderWorld {
    /// Tiles and tables.
    pub world: World,
    /// The kept stages in order.
    pub schedule: Schedule,
    /// The entities of the tiles, which hold the columns.
    pub tiles: Vec<Entity>,
}

impl RenderWorld {
    /// A world with room for `tiles` tiles at once.
    pub fn new(plan: &Plan, tables: &[ExtractedTable], tiles: usize, hooks: &[Hook]) -> Self {
        Self::of_pass(RowKind::Pixel, plan, tables, tiles, hooks)
    }

    /// A world for the pass whose rows are of this kind.
    pub fn of_pass(row: RowKind, plan: &Plan, tables: &[ExtractedTable], tiles: usize, hooks: &[Hook]) -> Self {
        let mut world = World::new();
        for table in tables {
            (table.insert)(&mut world);
        }
        let tiles = (0..tiles).map(|_| spawn_tile(&mut world, plan, row)).collect();
        let mut hooks = hooks.to_vec();
        if plan.statistics {
            world.insert_resource(StageClock::new(plan));
            // The clock comes first, so that it does not time the others.
            hooks.insert(0, clock_hook());
        }
        let follows = plan.stages.iter().any(|stage| stage.set == TileSystems::RemainingBounces);
        if follows {
            world.insert_resource(Stop::default());
            world.add_schedule(schedule_of(Bounce, plan, &hooks, |stage| stage.runs_in(row) && stage.on_every_bounce));
        }
        let mut schedule = schedule_of(Sample, plan, &hooks, |stage| stage.runs_first_in(row));
        if follows {
            schedule.configure_sets((TileSystems::Moments.run_if(is_whole), TileSystems::Film.run_if(is_whole)));
        }
        Self { world, schedule, tiles }
    }

    /// Exchanges a tile's part of the film with that in its entity: once to lend it, once to take it back.
    pub fn swap_film(&mut self, tile: Entity, film: &mut FilmTile) {
        let mut entity = self.world.entity_mut(tile);
        if let Some(mut place) = entity.get_mut::<Tile>() {
            *place = film.tile;
        }
        if let Some(mut own) = entity.get_mut::<FilmTile>() {
            mem::swap(&mut *own, film);
        }
    }

    /// Selects the pixels of a tile that take part in the next run and the sample that they take; returns their number.
    pub fn activate(&mut self, tile: Entity, run: &Run, planned: Option<&[u32]>) -> usize {
        let mut entity = self.world.entity_mut(tile);
        let place = entity.get::<Tile>().copied().unwrap_or_default();
        if let Some(mut number) = entity.get_mut::<SampleNumber>() {
            *number = SampleNumber(run.sample);
        }
        match entity.get_mut::<ActivePixels>() {
            Some(mut active) => {
                run.rows(place, planned, &mut active.0);
                active.0.len()
            }
            None => place.rows(),
        }
    }

    /// Selects no pixel of a tile for the next run.
    pub fn rest(&mut self, tile: Entity) -> usize {
        if let Some(mut active) = self.world.get_mut::<ActivePixels>(tile) {
            active.0.clear();
        }
        0
    }

    /// Sets the condition on which a run is abandoned; only runs that trace bounces can be, since others are short.
    pub fn stop_at(&mut self, stop: Stop) {
        if let Some(mut own) = self.world.get_resource_mut::<Stop>() {
            *own = stop;
        }
    }

    /// Runs every kept stage once over all tiles of this world; returns whether the run was completed, since an
    /// abandoned one adds nothing to the film.
    pub fn run(&mut self) -> bool {
        if let Some(mut stop) = self.world.get_resource_mut::<Stop>() {
            stop.given_up = false;
        }
        if let Some(mut clock) = self.world.get_resource_mut::<StageClock>() {
            clock.start();
        }
        self.schedule.run(&mut self.world);
        self.world.get_resource::<Stop>().is_none_or(|stop| !stop.given_up)
    }
}

fn spawn_tile(world: &mut World, plan: &Plan, row: RowKind) -> Entity {
    let mut tile = world.spawn((Tile::default(), Depth::default()));
    let written =
        |column: &&ColumnKind| plan.stages.iter().any(|stage| stage.runs_in(row) && stage.writes.contains(column));
    let columns: Vec<&ColumnKind> = plan.columns.iter().filter(written).collect();
    if row == RowKind::LightPath {
        tile.insert(SampleNumber::default());
    } else if columns.iter().any(|column| column.is::<PixelSamples>()) {
        tile.insert((SampleNumber::default(), ActivePixels::default()));
    }
    for column in columns {
        (column.insert)(&mut tile);
    }
    tile.id()
}

/// A schedule of the stages that hold, one after another as in the plan.
///
/// Also where any order gives the same bits, so that a picture costs the same each time: what is hit leaves less to the
/// shapes that come later.
fn schedule_of(label: impl ScheduleLabel, plan: &Plan, hooks: &[Hook], holds: impl Fn(&Stage) -> bool) -> Schedule {
    let mut schedule = Schedule::new(label);
    schedule.set_executor(SingleThreadedExecutor::new());
    let mut systems = Vec::new();
    for (slot, stage) in plan.stages.iter().enumerate().filter(|(_, stage)| holds(stage)) {
        systems.push((stage.system)().in_set(stage.set));
        systems.extend(hooks.iter().map(|hook| hook(slot, stage, plan).in_set(stage.set)));
    }
    schedule.add_systems(in_order(systems));
    schedule
}
