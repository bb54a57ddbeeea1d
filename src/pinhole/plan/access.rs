//! What a system reads and writes, as bevy knows it from the system's parameters.

use super::{ColumnKind, Lifetime, Shared, Table, TableKind};
use bevy_ecs::component::ComponentId;
use bevy_ecs::prelude::*;
use bevy_ecs::query::{ComponentAccessKind, FilteredAccess};
use bevy_ecs::schedule::{Schedule, ScheduleConfigs};
use bevy_ecs::system::{ScheduleSystem, SystemAccess};
use std::any::TypeId;
use std::collections::BTreeMap;
use std::sync::{Arc, PoisonError, RwLock};

/// The columns that any world has registered, by the type of their component.
static COLUMNS: RwLock<BTreeMap<TypeId, ColumnKind>> = RwLock::new(BTreeMap::new());
/// The tables that any world has registered, by the type of their resource.
static TABLES: RwLock<BTreeMap<TypeId, TableKind>> = RwLock::new(BTreeMap::new());
/// What systems touch, by their types, since lists of stages are made over and over.
///
/// The type of a system is that of its function or closure, or of a tuple of such, and so are its parameters.
static SYSTEMS: RwLock<BTreeMap<TypeId, Arc<Access>>> = RwLock::new(BTreeMap::new());

/// What a system reads and writes, each in the order of its parameters.
#[derive(Debug, Default)]
pub(super) struct Access {
    /// Columns without which its queries find nothing.
    pub reads: Vec<ColumnKind>,
    /// Columns it reads where they exist.
    pub reads_if: Vec<ColumnKind>,
    /// Columns it writes.
    pub writes: Vec<ColumnKind>,
    /// Those of them without which its queries find nothing.
    pub needs: Vec<ColumnKind>,
    /// Tables, optional ones among them, for bevy tells no difference.
    pub tables: Vec<TableKind>,
}

impl Access {
    /// What the systems of this configuration touch, where `system` is the type that it is made of.
    pub fn of(system: TypeId, configs: impl FnOnce() -> ScheduleConfigs<ScheduleSystem>) -> Arc<Self> {
        if let Some(known) = SYSTEMS.read().unwrap_or_else(PoisonError::into_inner).get(&system) {
            return Arc::clone(known);
        }
        let access = Arc::new(Self::measured(configs()));
        SYSTEMS.write().unwrap_or_else(PoisonError::into_inner).insert(system, Arc::clone(&access));
        access
    }

    fn measured(configs: ScheduleConfigs<ScheduleSystem>) -> Self {
        // In a world of its own, components are numbered in the order of the system's parameters.
        let (mut world, mut schedule) = (World::new(), Schedule::default());
        schedule.add_systems(configs);
        let mut access = Self::default();
        let built = schedule.initialize(&mut world).is_ok();
        for (_, system) in schedule.systems_with_access().ok().filter(|_| built).into_iter().flatten() {
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
            // The film holds the samples before this one, whether or not a stage has run for it yet.
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
    /// Makes the column known to the plan; bevy calls this by way of the column's `Component` where it first sees it.
    pub fn remember(self) {
        COLUMNS.write().unwrap_or_else(PoisonError::into_inner).insert(self.id, self);
    }
}

impl TableKind {
    /// Makes the table known to the plan.
    pub(super) fn remember<T: Table>(self) {
        TABLES.write().unwrap_or_else(PoisonError::into_inner).insert(TypeId::of::<Shared<T>>(), self);
    }
}
