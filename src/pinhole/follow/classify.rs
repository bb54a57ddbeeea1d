use crate::extract::{MaterialKind, MaterialTable, NO_ROW, ShapeTable};
use crate::intersect::{Hits, NO_SHAPE, shape_evidence};
use crate::plan::{Column, Shared, Stage, TileSystems, column};
use bevy_ecs::prelude::*;

column! {
    /// The rows that hit a perfect mirror, ascending.
    pub struct MirrorRows("mirror rows", "rows of the tile", "rows", Ray) {
        /// A row of the surfaces.
        row: u32,
        /// The row of the mirror table.
        of: u32,
    }
}

column! {
    /// The rows that hit glass, from either side, ascending.
    pub struct GlassRows("glass rows", "rows of the tile", "rows", Ray) {
        /// A row of the surfaces.
        row: u32,
        /// The row of the glass table.
        of: u32,
    }
}

column! {
    /// The rows that hit rough metal, ascending.
    pub struct MetalRows("metal rows", "rows of the tile", "rows", Ray) {
        /// A row of the surfaces.
        row: u32,
        /// The row of the metal table.
        of: u32,
    }
}

/// Lists the rows of each kind of material; from here on, each kind's stage visits its own rows only.
pub fn classify_materials(
    shapes: Res<Shared<ShapeTable>>,
    materials: Res<Shared<MaterialTable>>,
    mut tiles: Query<(&Hits, Option<&mut MirrorRows>, Option<&mut GlassRows>, Option<&mut MetalRows>)>,
) {
    let of_kind = |shape: usize, kind: MaterialKind| match shapes.material[shape] {
        NO_ROW => NO_ROW,
        material if materials.kind[material as usize] == kind => materials.row[material as usize],
        _ => NO_ROW,
    };
    for (hits, mirrors, glass, metal) in &mut tiles {
        if let Some(mut list) = mirrors {
            let list = &mut *list;
            list_rows(hits, [&mut list.row, &mut list.of], |shape| of_kind(shape, MaterialKind::Mirror));
        }
        if let Some(mut list) = glass {
            let list = &mut *list;
            list_rows(hits, [&mut list.row, &mut list.of], |shape| of_kind(shape, MaterialKind::Glass));
        }
        if let Some(mut list) = metal {
            let list = &mut *list;
            list_rows(hits, [&mut list.row, &mut list.of], |shape| of_kind(shape, MaterialKind::Metal));
        }
    }
}

/// Lists the rows whose shape has a row in this kind's table: every candidate is written, and the next overwrites it
/// unless it counts.
fn list_rows(hits: &Hits, [rows, of]: [&mut Vec<u32>; 2], row_of: impl Fn(usize) -> u32) {
    rows.resize(hits.rows(), 0);
    of.resize(hits.rows(), 0);
    let mut length = 0;
    for (row, &shape) in hits.shape.iter().enumerate() {
        rows[length] = row as u32;
        of[length] = if shape == NO_SHAPE { NO_ROW } else { row_of(shape as usize) };
        length += usize::from(of[length] != NO_ROW);
    }
    rows.truncate(length);
    of.truncate(length);
}

impl MirrorRows {
    fn paint_row(&self, _row: usize, _size: [u32; 2]) -> [f32; 3] {
        [1.0; 3]
    }
}

impl GlassRows {
    fn paint_row(&self, _row: usize, _size: [u32; 2]) -> [f32; 3] {
        [1.0; 3]
    }
}

impl MetalRows {
    fn paint_row(&self, _row: usize, _size: [u32; 2]) -> [f32; 3] {
        [1.0; 3]
    }
}

/// The stage that runs [`classify_materials`].
pub fn classify_materials_stage() -> Stage {
    Stage::new("Classify materials", TileSystems::Classify, classify_materials).when(shape_evidence)
}
