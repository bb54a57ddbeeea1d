//! Which stages a scene needs, and why.
//!
//! Reads: the scene's components and the stages on offer.
//! Writes: a [`Plan`]: every stage, kept or dropped, with the reason; the columns and tables that will exist; the
//! passes over the image.
//!
//! A stage is kept when the scene needs it *and* a kept stage, or a request, reads what it writes.
//! A dropped stage is never built, so it costs nothing.
//!
//! ```
//! use pinhole::plan::plan;
//! use pinhole::prelude::*;
//!
//! let mut scene = World::new();
//! scene.spawn((Name::new("camera"), PerspectiveCamera::default()));
//! scene.spawn((Name::new("moon"), Sphere::default(), Matte::default()));
//! let plan = plan(&Census::of(&scene), &pinhole::stages::all())?;
//! let row = |stage| plan.rows.iter().find(|row| row.stage == stage).map(|row| (row.kept, row.reason.as_str()));
//! assert_eq!(row("Intersect disks"), Some((false, "0 disks")));
//! # Ok::<(), pinhole::plan::PlanError>(())
//! ```

mod census;
mod column;
mod custom;
mod decide;
mod evidence;
mod print;
mod row_lists;
mod stage;
mod systems;
mod table;

pub use census::Census;
pub(crate) use census::united;
#[doc(hidden)]
pub use census::{declared, entities};
pub use column::{Column, Lifetime};
#[doc(hidden)]
pub use column::{
    ColumnArrays, ColumnComponent, ColumnKind, ColumnValue, ComponentNumber, ComponentValue, ComponentValues,
    VectorRows, VectorRowsMut, column, column_component, part_names,
};
pub(crate) use custom::{Added, add_kind, check_added, check_is_added, with_added};
#[doc(hidden)]
pub use decide::{Pass, PlanRow, view_names};
pub use decide::{Plan, PlanError, plan};
pub use evidence::Evidence;
#[doc(hidden)]
pub use evidence::{ComponentKind, counted};
#[doc(hidden)]
pub use row_lists::RowLists;
pub use stage::Stage;
#[doc(hidden)]
pub use stage::{StageKind, in_order};
pub use systems::TileSystems;
#[doc(hidden)]
pub use systems::{Bounce, RowKind, Sample};
#[doc(hidden)]
pub use table::{ExtractedTable, TableKind};
pub use table::{Shared, Table};
