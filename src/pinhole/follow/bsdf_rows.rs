use crate::extract::{MaterialTable, NO_ROW, ShapeTable, bsdf_evidence};
use crate::intersect::{Hits, NO_SHAPE};
use crate::material::Bsdf;
use crate::plan::{Column, ColumnComponent, ColumnKind, ComponentValues, Lifetime, Shared, Stage, TileSystems};
use bevy_ecs::component::{Component, ComponentId, Mutable, RequiredComponentsRegistrator, StorageType};
use bevy_ecs::prelude::*;
use std::marker::PhantomData;

/// The rows that hit a surface with a specular BSDF, ascending.
#[derive(Clone, Debug, PartialEq)]
pub struct BsdfRows<B> {
    /// A row of the surfaces.
    pub row: Vec<u32>,
    bsdf: PhantomData<fn() -> B>,
}

impl<B> Default for BsdfRows<B> {
    fn default() -> Self {
        Self { row: Vec::new(), bsdf: PhantomData }
    }
}

// What `column!` writes, which knows no type parameters.
impl<B: Bsdf> Component for BsdfRows<B> {
    const STORAGE_TYPE: StorageType = StorageType::Table;
    type Mutability = Mutable;

    fn register_required_components(_: ComponentId, _: &mut RequiredComponentsRegistrator<'_, '_>) {
        ColumnKind::of::<Self>().remember();
    }
}

impl<B: Bsdf> Column for BsdfRows<B> {
    const NAME: &'static str = B::NAMES.rows;
    const SPACE: &'static str = "rows of the tile";
    const UNIT: &'static str = "rows";
    const LIFETIME: Lifetime = Lifetime::Ray;

    fn rows(&self) -> usize {
        self.row.len()
    }

    fn components(&self) -> Vec<ColumnComponent<'_>> {
        vec![ColumnComponent { name: "row", values: ComponentValues::U32(&self.row) }]
    }

    fn paint(&self, _row: usize, _size: [u32; 2]) -> [f32; 3] {
        [1.0; 3]
    }
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
