use crate::extract::{MaterialTable, NO_ROW, ShapeTable, bsdf_evidence};
use crate::intersect::{Hits, NO_SHAPE, rows_of_kind};
use crate::material::Bsdf;
use crate::plan::{Column, Shared, Stage, TileSystems};
use bevy_ecs::prelude::*;

rows_of_kind! {
    /// The rows that hit a surface with a specular BSDF, ascending.
    pub struct BsdfRows<B: Bsdf>
}

/// Lists the rows that hit a surface with this BSDF: every candidate is written, and the next overwrites it unless it
/// counts.
pub fn classify_bsdf<B: Bsdf>(
    shapes: Res<Shared<ShapeTable>>,
    materials: Res<Shared<MaterialTable>>,
    mut tiles: Query<(&Hits, &mut BsdfRows<B>)>,
) {
    let has_bsdf = |shape: usize| match shapes.material[shape] {
        NO_ROW => false,
        material => materials.kind[material as usize] == B::KIND,
    };
    for (hits, mut list) in &mut tiles {
        list.row.resize(hits.rows(), 0);
        let mut length = 0;
        for (row, &shape) in hits.shape.iter().enumerate() {
            list.row[length] = row as u32;
            length += usize::from(shape != NO_SHAPE && has_bsdf(shape as usize));
        }
        list.row.truncate(length);
    }
}

/// The stage that runs [`classify_bsdf`].
pub fn classify_bsdf_stage<B: Bsdf>() -> Stage {
    Stage::new(B::NAMES.classify, TileSystems::Classify, classify_bsdf::<B>).when(bsdf_evidence::<B>)
}
