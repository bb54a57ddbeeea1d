use super::{MetallicRoughness, SurfaceColours};
use crate::extract::MaterialTable;
use crate::material::Parameters;
use bevy_ecs::query::QueryData;

/// The columns that textures write of surfaces' parameters, each where some texture does.
#[derive(QueryData)]
pub struct ParameterColumns {
    /// Colours.
    pub colours: Option<&'static SurfaceColours>,
    /// Metallic and roughness.
    pub metallic_roughness: Option<&'static MetallicRoughness>,
}

impl ParameterColumnsItem<'_, '_> {
    /// The parameters of a row's surface: a column's, or the material's own where there is no such column.
    #[inline(always)]
    pub fn get(&self, materials: &MaterialTable, row: usize, material: usize) -> Parameters {
        let own = &materials.parameters[material];
        let [metallic, roughness] =
            self.metallic_roughness.map_or([own.metallic, own.roughness], |column| column.get(row));
        Parameters { colour: self.colours.map_or(own.colour, |column| column.get(row)), metallic, roughness }
    }
}
