use super::Radiance;
use crate::extract::{MatteTable, matte_evidence};
use crate::intersect::{MatteRows, Surfaces, shape_evidence};
use crate::plan::{Evidence, Shared, Stage, StageKind, TileSystems};
use crate::scene::PointLight;
use bevy_ecs::prelude::*;

// ANCHOR: shade_flat
/// Gives every row the colour of the surface that it hit, as if colour were light: the picture of a scene in which
/// nothing shines.
pub fn shade_flat(mattes: Res<Shared<MatteTable>>, mut tiles: Query<(&Surfaces, &MatteRows, &mut Radiance)>) {
    for (surfaces, list, mut radiance) in &mut tiles {
        for &row in &list.row {
            let row = row as usize;
            let [r, g, b] = mattes.colour[surfaces.matte[row] as usize];
            (radiance.r[row], radiance.g[row], radiance.b[row]) = (r as f32, g as f32, b as f32);
        }
    }
}
// ANCHOR_END: shade_flat

/// The stage on offer: the alternative to light, for scenes without any.
pub fn flat_stage() -> Stage {
    Stage::new("Show surfaces unlit", TileSystems::Shade, shade_flat)
        .kind(StageKind::Alternative)
        .reads::<Surfaces>()
        .reads::<MatteRows>()
        .reads::<Radiance>()
        .writes::<Radiance>()
        .table::<MatteTable>()
        .when(|scene| {
            let shapes = shape_evidence(scene);
            if !shapes.needed {
                return shapes;
            }
            let lights = Evidence::of::<PointLight>(scene, "point light");
            Evidence { needed: !lights.needed, ..lights }.and(matte_evidence(scene))
        })
}
