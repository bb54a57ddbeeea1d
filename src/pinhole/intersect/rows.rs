use crate::plan::{Column, ColumnComponent, ColumnKind, ComponentValue, Lifetime, column};
use crate::shapes::Listed;
use bevy_ecs::component::{ComponentId, Mutable, RequiredComponentsRegistrator, StorageType};
use bevy_ecs::prelude::*;
use std::marker::PhantomData;

/// The rows that hit one kind of shape, ascending.
#[derive(Clone, Debug, PartialEq)]
pub struct ShapeRows<S> {
    /// Rows of the hits.
    pub row: Vec<u32>,
    of: PhantomData<S>,
}

impl<S> Default for ShapeRows<S> {
    fn default() -> Self {
        Self { row: Vec::new(), of: PhantomData }
    }
}

// What `column!` writes for a column that is not generic.
impl<S: Listed> Component for ShapeRows<S> {
    const STORAGE_TYPE: StorageType = StorageType::Table;
    type Mutability = Mutable;

    fn register_required_components(_: ComponentId, _: &mut RequiredComponentsRegistrator<'_, '_>) {
        ColumnKind::of::<Self>().remember();
    }
}

impl<S: Listed> Column for ShapeRows<S> {
    const NAME: &'static str = S::NAMES.rows;
    const SPACE: &'static str = "rows of the tile";
    const UNIT: &'static str = "rows";
    const LIFETIME: Lifetime = Lifetime::Ray;

    fn rows(&self) -> usize {
        self.row.len()
    }

    fn components(&self) -> Vec<ColumnComponent<'_>> {
        vec![ColumnComponent { name: "row", values: ComponentValue::values(&self.row) }]
    }

    fn paint(&self, _row: usize, _size: [u32; 2]) -> [f32; 3] {
        [1.0; 3]
    }
}

column! {
    /// The rows whose surface has a non-specular material, which is every material but mirrors and glass; ascending.
    pub struct MaterialRows("material rows", "rows of the tile", "rows", Ray) {
        /// A row of the surfaces.
        row: u32,
    }
}

column! {
    /// The rows whose surface emits light, ascending.
    pub struct EmissiveRows("emissive rows", "rows of the tile", "rows", Ray) {
        /// A row of the hits.
        row: u32,
        /// A row of the table of emissive surfaces.
        emissive: u32,
    }
}

impl EmissiveRows {
    fn paint_row(&self, _row: usize, _size: [u32; 2]) -> [f32; 3] {
        [1.0; 3]
    }
}

impl MaterialRows {
    fn paint_row(&self, _row: usize, _size: [u32; 2]) -> [f32; 3] {
        [1.0; 3]
    }
}
