use super::Scattered;
use super::specular::mirroring_normal;
use crate::extract::{MaterialTable, normal_map_evidence, traced_evidence};
use crate::intersect::{ShadingNormals, Surfaces, vertex_normal_evidence};
use crate::plan::{Column, Shared, Stage, StageKind, TileSystems};
use crate::rays::WorldRays;
use bevy_ecs::prelude::*;
use glam::DVec3;

// ANCHOR: shading_adjoint
/// The factor by which a path from a light differs from one from the camera at a surface with a shading normal N' and a
/// geometric normal N: |ωᵢ·N'| |ωₒ·N| / (|ωᵢ·N| |ωₒ·N'|) (Veach 1997, 5.3.2).
///
/// ωᵢ is the direction to the light, ωₒ the direction in which the ray is scattered.
/// A path from the camera counts light by the cosine to N'; a path from a light arrives at and leaves the geometric
/// surface.
#[inline(always)]
pub fn shading_adjoint(normal: DVec3, shading: DVec3, to_light: DVec3, onward: DVec3) -> f64 {
    let down = to_light.dot(normal) * onward.dot(shading);
    if down == 0.0 { 0.0 } else { (to_light.dot(shading) * onward.dot(normal) / down).abs() }
}
// ANCHOR_END: shading_adjoint

/// Applies that factor to the rays from lights that surfaces scatter.
pub fn correct_for_shading_normals(
    materials: Res<Shared<MaterialTable>>,
    mut tiles: Query<(&WorldRays, &Surfaces, &ShadingNormals, &mut Scattered)>,
) {
    for (rays, surfaces, shading, mut scattered) in &mut tiles {
        let scattered = &mut *scattered;
        for ray in 0..scattered.rows() {
            let row = scattered.row[ray] as usize;
            let (surface, direction) = (surfaces.get(row), rays.direction_of(row));
            let own = surface.normal.as_dvec3();
            let by = if materials.kind[surface.material as usize].is_specular() {
                mirroring_normal(Some(shading), row, own, direction)
            } else {
                shading.get(row)
            };
            let onward = [scattered.dx[ray], scattered.dy[ray], scattered.dz[ray]].map(f64::from);
            let more = shading_adjoint(own, by, -direction, DVec3::from(onward));
            [&mut scattered.r, &mut scattered.g, &mut scattered.b]
                .into_iter()
                .for_each(|component| component[ray] *= more);
        }
    }
}

/// The stage that runs [`correct_for_shading_normals`].
pub fn shading_adjoint_stage() -> Stage {
    Stage::new("Correct for shading normals", TileSystems::Roulette, correct_for_shading_normals)
        .on_light_paths()
        .kind(StageKind::Alternative)
        .when(|scene| traced_evidence(scene).and(|| vertex_normal_evidence(scene).or(normal_map_evidence(scene))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::ray_aim::Draws;

    /// With one normal nothing changes, and the reversed path has the inverse factor.
    #[test]
    fn reversed_paths_have_inverse_factors() {
        for index in 0..20_000 {
            let mut draws = Draws::new(2731, index);
            let [normal, shading, a, b] = [(); 4].map(|()| draws.unit_vector().normalize());
            assert!((shading_adjoint(normal, normal, a, b) - 1.0).abs() < 1e-14);
            let both = shading_adjoint(normal, shading, a, b) * shading_adjoint(normal, shading, b, a);
            assert!((both - 1.0).abs() < 1e-12, "{index}: {both}");
        }
        assert_eq!(shading_adjoint(DVec3::Y, DVec3::X, DVec3::X, DVec3::Y), 0.0);
        eprintln!("shading normals: 20000 pairs of directions");
    }
}
