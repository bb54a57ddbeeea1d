//! Shapes that no stage on offer intersects.

use super::shadow::ShadowHits;
use crate::extract::{MovingTable, NonOpaqueTable, ShapeTable, listed_kind, shape_name};
use crate::intersect::{Hits, Surfaces};
use crate::plan::{Census, ColumnKind, Plan, Stage, TableKind};
use crate::scene::SceneError;
use crate::shapes::ShapeKind;
use bevy_ecs::prelude::*;

/// Checks that for every shape of a scene there are stages on offer that intersect it, compute its surface, and trace
/// shadow rays against it, where the plan requires these: a chapter offers the stages taught so far, and other shapes
/// would be missing from its picture without a warning.
///
/// Errors: the first shape that no stage on offer intersects.
pub fn check_shapes_are_intersected(scene: &Census<'_>, offer: &[Stage], plan: &Plan) -> Result<(), SceneError> {
    let intersects = |column: ColumnKind, table: TableKind| {
        offer.iter().any(|stage| stage.writes.contains(&column) && stage.tables.contains(&table))
    };
    let columns = [
        (ColumnKind::of::<Hits>(), "no stage on offer intersects it; offer stages::all(), which do"),
        (ColumnKind::of::<Surfaces>(), "no stage on offer computes its surface; offer stages::all(), which do"),
        (
            ColumnKind::of::<ShadowHits>(),
            "no stage on offer traces shadow rays against it; offer stages::all(), which do",
        ),
    ];
    for (column, accepted) in columns {
        if !plan.columns.contains(&column) {
            continue;
        }
        let shapes = scene.table::<ShapeTable>()?;
        let tables = shapes
            .kind
            .iter()
            .filter(|kind| **kind != ShapeKind::Medium)
            .map(|&kind| listed_kind(scene, kind).map_or_else(TableKind::of::<MovingTable>, |listed| listed.table));
        let non_opaque = scene.table::<NonOpaqueTable>()?;
        let also = non_opaque.shape.iter().map(|&shape| (shape as usize, TableKind::of::<NonOpaqueTable>()));
        // The tables of the kinds have their surfaces.
        let also = also.filter(|_| column != ColumnKind::of::<Surfaces>());
        let missing = tables.enumerate().chain(also).find(|(_, table)| !intersects(column, *table));
        if let Some((shape, table)) = missing {
            let value = format!("in the table of {}", table.name);
            return Err(SceneError::new(shape_name(scene, shape), "shape", value, accepted));
        }
    }
    Ok(())
}
