use super::{MaterialKind, Parameters, material_entities, one_material};
use crate::plan::{Census, Table};
use crate::scene::SceneError;
use std::collections::HashMap;

/// Stands for no row, in a column of row numbers.
pub const NO_ROW: u32 = u32::MAX;

/// The materials of shapes of all kinds, in spawn order; their further parameters are in the table of their BSDF.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MaterialTable {
    /// The kind of each.
    pub kind: Vec<MaterialKind>,
    /// Its row in the table of its BSDF.
    pub row: Vec<u32>,
    /// The parameters of each where no texture gives another.
    pub parameters: Vec<Parameters>,
    /// The row of what fills its shapes in the table of glass; [`NO_ROW`] for opaque materials.
    pub interior: Vec<u32>,
}

impl MaterialTable {
    /// Materials that are opaque and of one row each, as for tests.
    pub fn opaque(kind: Vec<MaterialKind>, colour: Vec<[f64; 3]>) -> Self {
        let count = kind.len();
        Self {
            kind,
            row: vec![0; count],
            parameters: colour.into_iter().map(Parameters::coloured).collect(),
            interior: vec![NO_ROW; count],
        }
    }
}

impl Table for MaterialTable {
    const NAME: &'static str = "materials";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let mut table = Self::default();
        let (mut rows_of_kind, mut interiors) = (HashMap::<MaterialKind, u32>::new(), 0);
        for &entity in material_entities(scene).iter() {
            let written = one_material(scene, entity)?;
            let kind = written.kind(scene, entity);
            let rows = rows_of_kind.entry(kind).or_default();
            table.row.push(*rows);
            *rows += 1;
            table.kind.push(kind);
            table.parameters.push(written.parameters(scene, entity)?);
            let is_filled = written.interior(scene, entity)?.is_some();
            table.interior.push(if is_filled { interiors } else { NO_ROW });
            interiors += u32::from(is_filled);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.kind.len() * (size_of::<MaterialKind>() + 2 * size_of::<u32>() + size_of::<Parameters>())
    }
}
