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
/// cos α between the way to the eye and the way to the light mirrored in the surface; no vector need have length 1.
///
/// The mirrored way is 2(n·l)n − l; the formula stays the same when eye and light change places.
#[inline(always)]
pub fn mirror_cosine(normal: DVec3, to_light: DVec3, to_eye: DVec3) -> f64 {
    let twice = 2.0 * normal.dot(to_light) * normal.dot(to_eye) / normal.dot(normal);
    (twice - to_light.dot(to_eye)) / (to_light.length() * to_eye.length())
}
// ANCHOR_END: mirror_cosine

/// Adds what Phong surfaces send towards the eye in their highlights.
pub fn add_phong(
    materials: Res<Shared<MaterialTable>>,
    highlights: Res<Shared<PhongTable>>,
    mut tiles: Query<(
        (&WorldRays, &Surfaces, Option<&ShadingNormals>),
        (&LightRays, Option<&ShadowHits>, &mut Radiance),
    )>,
) {
    for ((eye, surfaces, shading), (light, shadow, mut radiance)) in &mut tiles {
        let lit = HighlightRow { eye, surfaces, shading, light, shadow };
        lit.add_highlights(&materials, MaterialKind::Phong, &mut radiance, |row, [normal, to_light, to_eye]| {
            let cosine = mirror_cosine(normal, to_light, to_eye);
            let height = highlight(highlights.peak[row], highlights.exponent[row], cosine);
            highlights.specular[row].map(|part| part * height)
        });
    }
}

/// The stage on offer.
pub fn phong_stage() -> Stage {
    Stage::new("Add Phong highlights", TileSystems::Shade, add_phong)
        .when(|scene| material_kind_evidence::<Phong>(scene, "Phong surface").and(|| light_evidence(scene)))
}
