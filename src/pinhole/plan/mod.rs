//! Which stages a scene needs, and why.
//!
//! Reads: the scene's components and the stages on offer.
//! Writes: a [`Plan`]: every stage, kept or dropped, with the reason; the columns and tables that will exist; the
//! passes over the image.
//!
//! A stage is kept when the scene needs it *and* a kept stage, or a request, reads what it writes.
//! A dropped stage is never built, so it costs nothing.

mod access;
mod census;
mod column;
mod decide;
mod evidence;
mod print;
mod stage;
mod systems;
mod table;

pub use census::{Census, entities};
pub use column::{
    Column, ColumnComponent, ColumnKind, ComponentNumber, ComponentValue, ComponentValues, Lifetime, column,
    column_component,
};
pub use decide::{Pass, Plan, PlanError, PlanRow, plan, view_names};
pub use evidence::{ComponentKind, Evidence, counted};
pub use stage::{Slot, Stage, StageKind};
pub use systems::{Bounce, RowKind, Sample, TileSystems};
pub use table::{ExtractedTable, Shared, Table, TableKind};
