//! The columns and tables that a system reads and writes, from bevy's access of the system's parameters.

use super::stage::Configs;
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
