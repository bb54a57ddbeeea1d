//! Shapes that no stage on offer meets.

use super::shadow::ShadowHits;
use crate::extract::ShapeTable;
use crate::intersect::{Hits, Surfaces};
use crate::plan::{ColumnKind, Plan, Stage, Table, TableKind};
use crate::scene::SceneError;
use bevy_ecs::prelude::*;

/// Checks that for every shape of a scene there are stages on offer that meet it, describe it, and let it cast a shadow,
/// as far as the plan traces rays for that: a chapter offers the stages taught so far, and a shape of another kind would
/// be missing from its picture without a word.
///
/// Errors: the first shape that no stage on offer looks for.
pub fn check_shapes_are_intersected(scene: &World, offer: &[Stage], plan: &Plan) -> Result<(), SceneError> {
    let meets = |column: ColumnKind, table: TableKind| {
        offer.iter().any(|stage| stage.writes.contains(&column) && stage.tables.contains(&table))
    };
    let columns = [
        (ColumnKind::of::<Hits>(), "no stage on offer intersects that; offer stages::all(), which do"),
        (ColumnKind::of::<Surfaces>(), "no stage on offer describes that; offer stages::all(), which do"),
        (
            ColumnKind::of::<ShadowHits>(),
            "no stage on offer looks for that in the way of light; offer stages::all(), which do",
        ),
    ];
    for (column, accepted) in columns {
        if !plan.columns.contains(&column) {
            continue;
        }
        let shapes = ShapeTable::extract(scene)?;
        let unmet = shapes.kind.iter().zip(&shapes.name).find(|(kind, _)| !meets(column, kind.table()));
        if let Some((kind, name)) = unmet {
            let value = format!("in the table of {}", kind.table().name);
            return Err(SceneError::new(name.clone(), "shape", value, accepted));
        }
    }
    Ok(())
}
