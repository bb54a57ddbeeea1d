use crate::each::list_those;
use crate::extract::{MaterialTable, NO_ROW, ShapeTable, lit_from_behind_evidence};
use crate::intersect::{Hits, MaterialRows};
use crate::plan::{Shared, Stage, TileSystems, column};
use bevy_ecs::prelude::*;

column! {
    /// The rows whose surface transmits light that is sampled, so that lights behind it count too; ascending.
    pub struct TransmissiveRows("transmissive rows", "rows of the tile", "rows", Ray) {
        /// A row of the surfaces.
        row: u32,
    }
}

impl TransmissiveRows {
    fn paint_row(&self, _row: usize, _size: [u32; 2]) -> [f32; 3] {
        [1.0; 3]
    }
}

/// Lists the rows for which lights are sampled on both sides of the surface.
pub fn list_transmissive_rows(
    shapes: Res<Shared<ShapeTable>>,
    materials: Res<Shared<MaterialTable>>,
    mut tiles: Query<(&Hits, &MaterialRows, &mut TransmissiveRows)>,
) {
    for (hits, list, mut far) in &mut tiles {
        let transmits = |row: u32| match shapes.material[hits.shape[row as usize] as usize] {
            NO_ROW => false,
            material => materials.kind[material as usize].transmits(),
        };
        list_those(list.row.iter().map(|&row| (row, transmits(row))), &mut far.row);
    }
}

/// The stage that runs [`list_transmissive_rows`].
pub fn transmissive_rows_stage() -> Stage {
    Stage::new("List rows: transmissive", TileSystems::Classify, list_transmissive_rows).when(lit_from_behind_evidence)
}
