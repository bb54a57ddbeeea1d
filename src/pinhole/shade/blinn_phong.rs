use super::highlight::{HighlightRow, highlight};
use super::light::light_evidence;
use super::{LightRays, Radiance, ShadowHits};
use crate::extract::{BlinnPhongTable, MaterialKind, MaterialTable, material_kind_evidence};
use crate::intersect::{ShadingNormals, Surfaces};
use crate::plan::{Shared, Stage, TileSystems};
use crate::rays::WorldRays;
use crate::scene::BlinnPhong;
use bevy_ecs::prelude::*;
use glam::DVec3;

// ANCHOR: half_vector_cosine
/// cos β between the normal and the half vector of the directions to light and eye; no vector need be normalised.
///
/// Where light and eye are opposite each other there is no half vector, and the result is NaN, which gives no
/// highlight.
#[inline(always)]
pub fn half_vector_cosine(normal: DVec3, to_light: DVec3, to_eye: DVec3) -> f64 {
    let half_vector = to_light / to_light.length() + to_eye / to_eye.length();
    normal.dot(half_vector) / (normal.length() * half_vector.length())
}
// ANCHOR_END: half_vector_cosine

/// Adds the light that Blinn–Phong highlights reflect to the eye.
pub fn add_blinn_phong(
    materials: Res<Shared<MaterialTable>>,
    highlights: Res<Shared<BlinnPhongTable>>,
    mut tiles: Query<(
        (&WorldRays, &Surfaces, Option<&ShadingNormals>),
        (&LightRays, Option<&ShadowHits>, &mut Radiance),
    )>,
) {
    for ((eye, surfaces, shading), (light, shadow, mut radiance)) in &mut tiles {
        let row = HighlightRow { eye, surfaces, shading, light, shadow };
        row.add_highlights(&materials, MaterialKind::BlinnPhong, &mut radiance, |row, [normal, to_light, to_eye]| {
            let cosine = half_vector_cosine(normal, to_light, to_eye);
            let height = highlight(highlights.peak[row], highlights.exponent[row], cosine);
            highlights.specular[row].map(|part| part * height)
        });
    }
}

/// The stage that runs [`add_blinn_phong`].
pub fn blinn_phong_stage() -> Stage {
    Stage::new("Add Blinn–Phong highlights", TileSystems::Shade, add_blinn_phong)
        .when(|scene| material_kind_evidence::<BlinnPhong>(scene, "Blinn–Phong surface").and(|| light_evidence(scene)))
}
