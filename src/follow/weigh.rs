use super::emission::power_heuristic;
use crate::extract::{MaterialKind, MaterialTable, area_light_evidence, material_evidence, weighed_evidence};
use crate::intersect::{ShadingNormals, Surfaces};
use crate::plan::{Column, Shared, Stage, StageKind, TileSystems};
use crate::shade::{LightDensities, LightRays};
use bevy_ecs::prelude::*;
use std::f64::consts::FRAC_1_PI;

// ANCHOR: weigh_matte
/// Takes from every light ray the part that matte surfaces find by chance: their rays go there as densely as cos θ / π.
pub fn weigh_matte(
    materials: Res<Shared<MaterialTable>>,
    mut tiles: Query<(&Surfaces, Option<&ShadingNormals>, &LightDensities, &mut LightRays)>,
) {
    for (surfaces, shading, densities, mut rays) in &mut tiles {
        for ray in 0..rays.rows() {
            let (row, aimed) = (rays.path[ray] as usize, densities.density[ray]);
            let surface = surfaces.get(row);
            let scatters = !matches!(materials.kind[surface.material as usize], MaterialKind::Metal);
            if aimed == 0.0 || !scatters {
                continue;
            }
            let normal = shading.map_or_else(|| surface.normal.as_dvec3(), |shading| shading.get(row));
            let by_chance = rays.direction_of(ray).dot(normal).max(0.0) * FRAC_1_PI;
            rays.weigh(ray, power_heuristic(aimed, by_chance));
        }
    }
}
// ANCHOR_END: weigh_matte

/// The stage on offer.
pub fn weigh_matte_stage() -> Stage {
    Stage::new("Weigh light aimed at from matte surfaces", TileSystems::Weigh, weigh_matte)
        .kind(StageKind::Alternative)
        .reads::<Surfaces>()
        .reads_if::<ShadingNormals>()
        .reads_where::<LightDensities>(weighed_evidence)
        .reads::<LightDensities>()
        .reads::<LightRays>()
        .writes::<LightRays>()
        .table::<MaterialTable>()
        .when(|scene| area_light_evidence(scene).and(weighed_evidence(scene)).and(material_evidence(scene)))
}
