//! A stage, and what its system reads and writes.

use super::{Census, Column, ColumnKind, Evidence, Lifetime, RowKind, Shared, Table, TableKind, TileSystems};
use bevy_ecs::component::ComponentId;
use bevy_ecs::prelude::*;
use bevy_ecs::query::{ComponentAccessKind, FilteredAccess};
use bevy_ecs::schedule::{Chain, Schedule, ScheduleConfigs};
use bevy_ecs::system::{ScheduleSystem, SystemAccess};
use std::any::TypeId;
use std::collections::BTreeMap;
use std::sync::{Arc, PoisonError, RwLock};

/// What dropping a stage means for the picture, where its predicate says that it is not needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StageKind {
    /// Forcing it on leaves the image bit-identical.
    Exact,
    /// It samples directions or terminates paths at random; its mean is compared with closed forms.
    Estimator,
    /// It is one of several stages that write the same column; forcing it on beside another has no meaning.
    Alternative,
}

/// What makes the configuration of a stage's system.
pub type Configs = dyn Fn() -> ScheduleConfigs<ScheduleSystem> + Send + Sync;

/// Systems as one chain: each runs after the one before it in the list.
///
/// The schedule's graph has then a node for each. With a set around every system it would have twice as many, and four
/// times as many pairs of which it is found out whether one leads to the other.
pub fn in_order(systems: Vec<ScheduleConfigs<ScheduleSystem>>) -> ScheduleConfigs<ScheduleSystem> {
    ScheduleConfigs::Configs { configs: systems, collective_conditions: Vec::new(), metadata: Chain::default() }.chain()
}

/// A stage on offer: its name, the columns that it reads and writes, when a scene needs it, and the system that runs.
///
/// ```
/// use pinhole::intersect::{Hits, shape_evidence};
/// use pinhole::plan::column;
/// use pinhole::prelude::*;
///
/// column! {
///     /// How near each hit is.
///     pub struct Nearness("nearness", "none, a ratio", "1", Ray) {
///         /// 1 at the eye, 0 at infinity.
///         value: f32,
///     }
/// }
///
/// impl Nearness {
///     fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
///         [self.value[row]; 3]
///     }
/// }
///
/// fn fill_nearness(mut tiles: Query<(&Hits, &mut Nearness)>) {
///     for (hits, mut nearness) in &mut tiles {
///         let values = nearness.slices_mut(hits.t.len());
///         values.iter_mut().zip(&hits.t).for_each(|(value, t)| *value = (1.0 / (1.0 + t)) as f32);
///     }
/// }
///
/// // The plan finds out by itself that the stage reads `Hits` and writes `Nearness`.
/// let stage = Stage::new("Compute nearness", TileSystems::Shade, fill_nearness).when(shape_evidence);
/// assert_eq!((stage.reads[0].name, stage.writes[0].name), ("hit", "nearness"));
/// ```
#[derive(Clone)]
pub struct Stage {
    /// The type of its system, which identifies the stage.
    pub id: TypeId,
    /// Its name, in words, such as "Transform rays to world space".
    pub name: &'static str,
    /// The set that it runs in.
    pub set: TileSystems,
    /// Its place among the stages of its set, where their order decides the last bits of a sum.
    pub place: usize,
    /// What dropping it means.
    pub kind: StageKind,
    /// Columns that it cannot run without.
    pub reads: Vec<ColumnKind>,
    /// Columns that it reads where they exist.
    pub reads_if: Vec<ColumnKind>,
    /// Columns that it reads where they exist, and requests where the scene gives a reason.
    pub reads_where: Vec<(ColumnKind, fn(&Census<'_>) -> Evidence)>,
    /// Columns that it writes; those that nothing reads do not exist.
    pub writes: Vec<ColumnKind>,
    /// Whether it runs at every bounce, or at the first one only.
    pub on_every_bounce: bool,
    /// Whether something else does its work at the first bounce of camera paths, and why.
    pub spared_first: fn(&Census<'_>) -> Evidence,
    /// Whether it is spared the first bounce, which the plan decides.
    pub from_second_bounce: bool,
    /// The passes that it runs in.
    pub passes: &'static [RowKind],
    /// Whether it appends rows to what it writes, after those of other stages.
    pub appends: bool,
    /// Tables that it reads.
    pub tables: Vec<TableKind>,
    /// Tables that it reads where the scene gives a reason.
    pub tables_where: Vec<(TableKind, fn(&Census<'_>) -> Evidence)>,
    /// Tables that it reads where a column that it writes is read.
    pub tables_with: Vec<(TableKind, ColumnKind)>,
    /// Whether it reads the column that a `View` names.
    pub reads_view: bool,
    /// Whether a scene needs it.
    pub when: fn(&Census<'_>) -> Evidence,
    /// The system's configuration, made anew for each schedule.
    pub system: Arc<Configs>,
}

impl Stage {
    /// A stage that is always needed, and reads and writes what its system's parameters say.
    ///
    /// `&C` is a column it cannot run without, `Option<&C>` one that it reads where it exists, `&mut C` one that it
    /// writes, `Res<Shared<T>>` a table.
    /// A column that stages of an earlier set begin ([`Column::BEGUN`]) is read as well, for it is changed in place.
    /// An exclusive system (`&mut World`) says nothing by its parameters, so what it touches is added one by one.
    pub fn new<Marker: 'static, S>(name: &'static str, set: TileSystems, system: S) -> Self
    where
        S: IntoScheduleConfigs<ScheduleSystem, Marker> + Clone + Send + Sync + 'static,
    {
        let configs = move || system.clone().into_configs();
        Self::made(TypeId::of::<S>(), name, set, Arc::new(configs))
    }

    /// This is compiled once; what stands in `new`, for every system.
    fn made(id: TypeId, name: &'static str, set: TileSystems, system: Arc<Configs>) -> Self {
        let access = Access::of(id, &*system);
        let changed = |column: &&ColumnKind| column.begun.is_some_and(|begun| begun < set);
        let changed: Vec<ColumnKind> = access.needs.iter().filter(changed).copied().collect();
        Self {
            id,
            name,
            set,
            place: usize::MAX,
            kind: StageKind::Exact,
            reads: access.reads.iter().chain(&changed).copied().collect(),
            reads_if: access.reads_if.clone(),
            reads_where: Vec::new(),
            writes: access.writes.clone(),
            on_every_bounce: set.on_every_bounce(),
            spared_first: |_| Evidence::default(),
            from_second_bounce: false,
            passes: set.passes(),
            appends: false,
            tables: access.tables.clone(),
            tables_where: Vec::new(),
            tables_with: Vec::new(),
            reads_view: false,
            when: |_| Evidence::always("every picture needs it"),
            system,
        }
    }

    /// Restricts it to the first bounce.
    pub fn on_first_bounce(mut self) -> Self {
        self.on_every_bounce = false;
        self
    }

    /// Leaves the first bounce of camera paths to another stage, where the scene gives a reason.
    pub fn spared_first_where(mut self, predicate: fn(&Census<'_>) -> Evidence) -> Self {
        self.spared_first = predicate;
        self
    }

    /// Restricts it to the pass over pixels.
    pub fn on_camera_paths(mut self) -> Self {
        self.passes = &[RowKind::Pixel];
        self
    }

    /// Has it run for paths from the camera and from lights, whatever its set.
    pub fn on_all_paths(mut self) -> Self {
        self.passes = &[RowKind::Pixel, RowKind::LightPath];
        self
    }

    /// Restricts it to the pass over light paths.
    pub fn on_light_paths(mut self) -> Self {
        self.passes = &[RowKind::LightPath];
        self
    }

    /// Whether it is made of the same system as the stage that `constructor` makes.
    pub fn is(&self, constructor: fn() -> Self) -> bool {
        *self == constructor()
    }

    /// Whether it runs in the pass whose rows are of this kind.
    pub fn runs_in(&self, row: RowKind) -> bool {
        self.passes.contains(&row)
    }

    /// Whether it traces further bounces, or paths that start elsewhere than on the camera.
    pub fn traces_further(&self) -> bool {
        self.set == TileSystems::RemainingBounces || !self.runs_in(RowKind::Pixel)
    }

    /// Whether it runs at the first bounce of the pass whose rows are of this kind.
    pub fn runs_first_in(&self, row: RowKind) -> bool {
        self.runs_in(row) && !(self.from_second_bounce && row == RowKind::Pixel)
    }

    /// Adds a column that it cannot run without; needed for exclusive systems only.
    pub fn reads<C: Column>(mut self) -> Self {
        add(&mut self.reads, ColumnKind::of::<C>());
        self
    }

    /// Adds a column that it reads where it exists, and requests only where the scene gives a reason.
    pub fn reads_where<C: Column>(self, predicate: fn(&Census<'_>) -> Evidence) -> Self {
        self.reads_kind_where(ColumnKind::of::<C>(), predicate)
    }

    fn reads_kind_where(mut self, column: ColumnKind, predicate: fn(&Census<'_>) -> Evidence) -> Self {
        self.reads.retain(|own| *own != column);
        self.reads_if.retain(|own| *own != column);
        self.reads_where.push((column, predicate));
        self
    }

    /// Adds a column that it writes; needed for exclusive systems only.
    pub fn writes<C: Column>(mut self) -> Self {
        add(&mut self.writes, ColumnKind::of::<C>());
        self
    }

    /// Adds a column that it updates in place, although it is in the set whose stages begin the column.
    pub fn changes<C: Column>(self) -> Self {
        self.reads::<C>().writes::<C>()
    }

    /// Adds a column that it appends rows to, which cannot exist without a stage that clears it first.
    pub fn appends<C: Column>(mut self) -> Self {
        self.appends = true;
        self.changes::<C>()
    }

    /// Adds a table that it reads; needed for exclusive systems only.
    pub fn table<T: Table>(mut self) -> Self {
        add(&mut self.tables, TableKind::of::<T>());
        self
    }

    /// Adds a table that it reads where the scene gives a reason.
    pub fn table_where<T: Table>(self, predicate: fn(&Census<'_>) -> Evidence) -> Self {
        self.table_kind_where(TableKind::of::<T>(), predicate)
    }

    fn table_kind_where(mut self, table: TableKind, predicate: fn(&Census<'_>) -> Evidence) -> Self {
        self.tables.retain(|own| *own != table);
        self.tables_where.push((table, predicate));
        self
    }

    /// Adds a table that it reads only to write a certain column, and so only where that column is read.
    pub fn table_with<T: Table, C: Column>(mut self) -> Self {
        let table = TableKind::of::<T>();
        self.tables.retain(|own| *own != table);
        self.tables_with.push((table, ColumnKind::of::<C>()));
        self
    }

    /// Removes a table that its system could read and never does.
    pub fn without_table<T: Table>(mut self) -> Self {
        self.tables.retain(|own| !own.is::<T>());
        self
    }

    /// The tables that it reads for a scene, where these of its columns are read.
    pub fn tables_for(&self, scene: &Census<'_>, columns: &[ColumnKind]) -> Vec<TableKind> {
        let needed = self.tables_where.iter().filter(|(_, predicate)| predicate(scene).needed);
        let beside = self.tables_with.iter().filter(|(_, column)| columns.contains(column));
        let more = needed.map(|(table, _)| table).chain(beside.map(|(table, _)| table));
        self.tables.iter().chain(more).copied().collect()
    }

    /// The tables that it does not read for a scene although there is something to put into them, and why.
    pub fn tables_left_out(&self, scene: &Census<'_>) -> Vec<(TableKind, String)> {
        let reasons = self.tables_where.iter().map(|(table, predicate)| (*table, predicate(scene)));
        let left_out = reasons.filter(|(_, evidence)| !evidence.needed && evidence.count > 0);
        left_out.map(|(table, evidence)| (table, evidence.reason)).collect()
    }

    /// Makes it read the column that a `View` names.
    pub fn reads_the_view(mut self) -> Self {
        self.reads_view = true;
        self
    }

    /// Sets the predicate by which a scene needs it.
    pub fn when(mut self, predicate: fn(&Census<'_>) -> Evidence) -> Self {
        self.when = predicate;
        self
    }

    /// Sets what dropping it means.
    pub fn kind(mut self, kind: StageKind) -> Self {
        self.kind = kind;
        self
    }
}

fn add<T: PartialEq>(list: &mut Vec<T>, item: T) {
    if !list.contains(&item) {
        list.push(item);
    }
}

impl PartialEq for Stage {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

impl std::fmt::Debug for Stage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Stage({})", self.name)
    }
}

// The columns and tables that a system reads and writes, from bevy's access of the system's parameters.

/// The columns that any world has registered, by the type of their component.
static COLUMNS: RwLock<BTreeMap<TypeId, ColumnKind>> = RwLock::new(BTreeMap::new());
/// The tables that any world has registered, by the type of their resource.
static TABLES: RwLock<BTreeMap<TypeId, TableKind>> = RwLock::new(BTreeMap::new());
/// The access of systems, by their types, cached because lists of stages are made repeatedly.
///
/// The type of a system is that of its function or closure, or of a tuple of these, and determines its parameters.
static SYSTEMS: RwLock<BTreeMap<TypeId, Arc<Access>>> = RwLock::new(BTreeMap::new());

/// The columns and tables of a system, each in the order of its parameters.
#[derive(Debug, Default)]
pub(super) struct Access {
    /// Columns that its queries require.
    pub reads: Vec<ColumnKind>,
    /// Columns that it reads where they exist.
    pub reads_if: Vec<ColumnKind>,
    /// Columns that it writes.
    pub writes: Vec<ColumnKind>,
    /// Those of the written columns that its queries require.
    pub needs: Vec<ColumnKind>,
    /// Tables, including optional ones, which bevy's access does not distinguish.
    pub tables: Vec<TableKind>,
}

impl Access {
    /// The access of the systems in this configuration, where `system` is the type that it is made of.
    pub fn of(system: TypeId, configs: &Configs) -> Arc<Self> {
        if let Some(known) = SYSTEMS.read().unwrap_or_else(PoisonError::into_inner).get(&system) {
            return Arc::clone(known);
        }
        let access = Arc::new(Self::measured(configs()));
        SYSTEMS.write().unwrap_or_else(PoisonError::into_inner).insert(system, Arc::clone(&access));
        access
    }

    fn measured(configs: ScheduleConfigs<ScheduleSystem>) -> Self {
        // In a fresh world, components are numbered in the order of the system's parameters.
        let (mut world, mut schedule) = (World::new(), Schedule::default());
        schedule.add_systems(configs);
        let mut access = Self::default();
        // Its systems say what they touch before the schedule is built, which would take most of a program's start.
        schedule.graph_mut().initialize(&mut world);
        let systems = &schedule.graph().systems;
        for system in systems.iter().filter_map(|(key, ..)| systems.get(key)) {
            if let SystemAccess::Shared(parameters) = system.access() {
                parameters.filtered_accesses().iter().for_each(|parameter| access.add(parameter, &world));
            }
        }
        let Self { reads, reads_if, writes, .. } = &mut access;
        reads.retain(|column| !writes.contains(column));
        reads_if.retain(|column| !writes.contains(column) && !reads.contains(column));
        access
    }

    fn add(&mut self, parameter: &FilteredAccess, world: &World) {
        let needed: Vec<ComponentId> = parameter.with_filters().collect();
        let type_of = |id| world.components().get_info(id).and_then(|info| info.type_id());
        for kind in parameter.access().try_iter_access().into_iter().flatten() {
            let Some(touched) = type_of(*kind.index()) else { continue };
            if let Some(table) = TABLES.read().unwrap_or_else(PoisonError::into_inner).get(&touched) {
                push(&mut self.tables, *table);
            }
            let Some(column) = COLUMNS.read().unwrap_or_else(PoisonError::into_inner).get(&touched).copied() else {
                continue;
            };
            // The film holds earlier samples, whether or not a stage has run for it yet.
            let needed = needed.contains(kind.index()) && column.lifetime != Lifetime::Film;
            match kind {
                ComponentAccessKind::Exclusive(_) => {
                    push(&mut self.writes, column);
                    if needed {
                        push(&mut self.needs, column);
                    }
                }
                ComponentAccessKind::Shared(_) if needed => push(&mut self.reads, column),
                ComponentAccessKind::Shared(_) => push(&mut self.reads_if, column),
                ComponentAccessKind::Archetypal(_) => {}
            }
        }
    }
}

fn push<T: PartialEq>(list: &mut Vec<T>, item: T) {
    if !list.contains(&item) {
        list.push(item);
    }
}

impl ColumnKind {
    /// Registers the column with the plan; bevy calls this through the column's `Component` when it first sees it.
    pub fn remember(self) {
        COLUMNS.write().unwrap_or_else(PoisonError::into_inner).insert(self.id, self);
    }
}

impl TableKind {
    /// Registers the table with the plan.
    pub(super) fn remember<T: Table>(self) {
        TABLES.write().unwrap_or_else(PoisonError::into_inner).insert(TypeId::of::<Shared<T>>(), self);
    }
}
