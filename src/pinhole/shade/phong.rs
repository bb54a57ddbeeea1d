use super::highlight::{HighlightRow, highlight};
use super::light::light_evidence;
use super::{LightRays, Radiance, ShadowHits};
use crate::extract::{MaterialKind, MaterialTable, PhongTable, material_kind_evidence};
use crate::intersect::{ShadingNormals, Surfaces};
use crate::plan::{Shared, Stage, TileSystems};
use crate::rays::WorldRays;
use crate::scene::Phong;
use bevy_ecs::prelude::*;
use glam::DVec3;

// ANCHOR: mirror_cosine
/// cos α between the direction to the eye and the mirror reflection of the direction to the light; no vector need be
/// normalised.
///
/// The reflection is 2(n·l)n − l; the formula is symmetric in eye and light.
#[inline(always)]
pub fn mirror_cosine(normal: DVec3, to_light: DVec3, to_eye: DVec3) -> f64 {
    let twice = 2.0 * normal.dot(to_light) * normal.dot(to_eye) / normal.dot(normal);
    (twice - to_light.dot(to_eye)) / (to_light.length() * to_eye.length())
}
// ANCHOR_END: mirror_cosine

/// Adds the light that Phong highlights reflect to the eye.
pub fn add_phong(
    materials: Res<Shared<MaterialTable>>,
    highlights: Res<Shared<PhongTable>>,
    mut tiles: Query<(
        (&WorldRays, &Surfaces, Option<&ShadingNormals>),
        (&LightRays, Option<&ShadowHits>, &mut Radiance),
    )>,
) {
    for ((eye, surfaces, shading), (light, shadow, mut radiance)) in &mut tiles {
        let row = HighlightRow { eye, surfaces, shading, light, shadow };
        row.add_highlights(&materials, MaterialKind::Phong, &mut radiance, |row, [normal, to_light, to_eye]| {
            let cosine = mirror_cosine(normal, to_light, to_eye);
            let height = highlight(highlights.peak[row], highlights.exponent[row], cosine);
            highlights.specular[row].map(|part| part * height)
        });
    }
}

/// The stage that runs [`add_phong`].
pub fn phong_stage() -> Stage {
    Stage::new("Add Phong highlights", TileSystems::Shade, add_phong)
        .when(|scene| material_kind_evidence::<Phong>(scene, "Phong surface").and(|| light_evidence(scene)))
}
