use super::SurfaceColours;
use crate::extract::{MaterialTable, surface_colour_evidence};
use crate::intersect::{MaterialRows, Surfaces};
use crate::plan::{Column, Shared, Stage, TileSystems};
use bevy_ecs::prelude::*;

/// Gives every row with a diffuse material that material's colour, and black to the others.
pub fn colour_surfaces(
    materials: Res<Shared<MaterialTable>>,
    mut tiles: Query<(&Surfaces, &MaterialRows, &mut SurfaceColours)>,
) {
    for (surfaces, list, mut colours) in &mut tiles {
        let (r, g, b) = colours.slices_mut(surfaces.rows());
        r.fill(0.0);
        g.fill(0.0);
        b.fill(0.0);
        for &row in &list.row {
            let row = row as usize;
            [r[row], g[row], b[row]] = materials.parameters[surfaces.material[row] as usize].colour;
        }
    }
}

impl SurfaceColours {
    /// Sets the colour of a row.
    #[inline(always)]
    pub(super) fn set(&mut self, row: usize, colour: [f64; 3]) {
        [self.r[row], self.g[row], self.b[row]] = colour;
    }
}

/// The stage that runs [`colour_surfaces`]; the texture stages overwrite its colours.
pub fn colour_stage() -> Stage {
    Stage::new("Look up surface colours", TileSystems::Colour, colour_surfaces).when(surface_colour_evidence)
}
