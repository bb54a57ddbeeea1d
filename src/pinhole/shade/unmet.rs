//! Shapes that no stage on offer meets.

use super::shadow::ShadowHits;
use crate::extract::{ShapeTable, shape_name};
use crate::intersect::{Hits, Surfaces};
use crate::plan::{Census, ColumnKind, Plan, Stage, TableKind};
use crate::scene::SceneError;
use bevy_ecs::prelude::*;

/// Checks that for every shape of a scene there are stages on offer that meet it, describe it, and let it cast a shadow,
/// as far as the plan traces rays for that: a chapter offers the stages taught so far, and a shape of another kind would
/// be missing from its picture without a word.
///
/// Errors: the first shape that no stage on offer looks for.
pub fn check_shapes_are_intersected(scene: &Census<'_>, offer: &[Stage], plan: &Plan) -> Result<(), SceneError> {
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
        let shapes = scene.table::<ShapeTable>()?;
        let unmet = shapes.kind.iter().enumerate().find(|(_, kind)| !meets(column, kind.table()));
        if let Some((shape, kind)) = unmet {
            let value = format!("in the table of {}", kind.table().name);
            return Err(SceneError::new(shape_name(scene, shape), "shape", value, accepted));
        }
    }
    Ok(())
}
