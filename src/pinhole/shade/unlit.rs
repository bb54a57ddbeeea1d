use super::light::light_evidence;
use super::{Radiance, SurfaceColours};
use crate::extract::{MaterialTable, emissive_evidence, followed_evidence, material_evidence, occlusion_evidence};
use crate::intersect::{MaterialRows, Surfaces, shape_evidence};
use crate::plan::{Census, Evidence, Shared, Stage, StageKind, TileSystems};
use bevy_ecs::prelude::*;

// ANCHOR: shade_unlit
/// Sets every row's radiance to the colour of the surface that it hit: the picture of a scene without light.
pub fn shade_unlit(
    materials: Res<Shared<MaterialTable>>,
    mut tiles: Query<(&Surfaces, Option<&SurfaceColours>, &MaterialRows, &mut Radiance)>,
) {
    for (surfaces, colours, list, mut radiance) in &mut tiles {
        for &row in &list.row {
            let row = row as usize;
            let material = surfaces.material[row] as usize;
            let [r, g, b] = colours.map_or_else(|| materials.parameters[material].colour, |colours| colours.get(row));
            (radiance.r[row], radiance.g[row], radiance.b[row]) = (r as f32, g as f32, b as f32);
        }
    }
}
// ANCHOR_END: shade_unlit

/// The stage that runs [`shade_unlit`], the alternative to lighting for scenes without any.
pub fn unlit_stage() -> Stage {
    Stage::new("Show unlit surfaces", TileSystems::Shade, shade_unlit).kind(StageKind::Alternative).when(|scene| {
        let material = shown_evidence(scene);
        let followed = followed_evidence(scene).or(occlusion_evidence(scene));
        let shining = light_evidence(scene).or(emissive_evidence(scene)).or(followed);
        if material.needed { Evidence { needed: !shining.needed, ..shining }.and(|| material) } else { material }
    })
}

/// Evidence that there is a surface to show.
pub fn shown_evidence(scene: &Census<'_>) -> Evidence {
    let shapes = shape_evidence(scene);
    if shapes.needed { material_evidence(scene) } else { shapes }
}
