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
pub use column::{
    Column, ColumnArrays, ColumnComponent, ColumnKind, ColumnValue, Lifetime, VectorRows, VectorRowsMut, column,
};
pub(crate) use custom::{Added, add_kind, check_added, check_is_added, with_added};
pub use decide::{Pass, Plan, PlanError, PlanRow, plan};
pub use evidence::Evidence;
pub use stage::{Stage, StageKind};
pub use systems::TileSystems;
pub use table::{Shared, Table};

unstable! {
    use census::{declared, entities};
    use column::{ComponentNumber, ComponentValue, ComponentValues, column_component, part_names};
    use decide::view_names;
    use evidence::{ComponentKind, counted};
    use row_lists::RowLists;
    use stage::in_order;
    use systems::{Bounce, RowKind, Sample};
    use table::{ExtractedTable, TableKind};
}
