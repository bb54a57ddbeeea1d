use super::Scattered;
use super::mirror::mirroring_normal;
use crate::extract::{MaterialKind, MaterialTable, traced_evidence};
use crate::intersect::{ShadingNormals, Surfaces, vertex_normal_evidence};
use crate::plan::{Column, Shared, Stage, StageKind, TileSystems};
use crate::rays::WorldRays;
use bevy_ecs::prelude::*;
use glam::DVec3;

// ANCHOR: shading_adjoint
/// What a ray from a light counts for, beyond what one from the camera does, where a surface is shaded by another normal
/// than its own: |ωᵢ·N'| |ωₒ·N| / (|ωᵢ·N| |ωₒ·N'|), N' being the one to shade by (Veach 1997, 5.3.2).
///
/// ωᵢ is the way to the light, ωₒ the way that the ray goes on.
/// The camera's ray counts light by the cosine to N'; a ray from the light falls on the true surface and leaves it.
#[inline(always)]
pub fn shading_adjoint(normal: DVec3, shading: DVec3, to_light: DVec3, onward: DVec3) -> f64 {
    let down = to_light.dot(normal) * onward.dot(shading);
    if down == 0.0 { 0.0 } else { (to_light.dot(shading) * onward.dot(normal) / down).abs() }
}
// ANCHOR_END: shading_adjoint

/// Weighs the rays from lights that mirrors, glass and metal send on by normals other than their own.
///
/// Matte surfaces weigh theirs themselves.
pub fn correct_for_shading_normals(
    materials: Res<Shared<MaterialTable>>,
    mut tiles: Query<(&WorldRays, &Surfaces, &ShadingNormals, &mut Scattered)>,
) {
    for (rays, surfaces, shading, mut scattered) in &mut tiles {
        let scattered = &mut *scattered;
        for ray in 0..scattered.rows() {
            let row = scattered.path[ray] as usize;
            let (surface, direction) = (surfaces.get(row), rays.direction_of(row));
            let own = surface.normal.as_dvec3();
            let by = match materials.kind[surface.material as usize] {
                MaterialKind::Mirror | MaterialKind::Glass => mirroring_normal(Some(shading), row, own, direction),
                MaterialKind::Metal => shading.get(row),
                MaterialKind::Matte | MaterialKind::Phong | MaterialKind::BlinnPhong => continue,
            };
            let onward = [scattered.dx[ray], scattered.dy[ray], scattered.dz[ray]].map(f64::from);
            let more = shading_adjoint(own, by, -direction, DVec3::from(onward));
            [&mut scattered.r, &mut scattered.g, &mut scattered.b]
                .into_iter()
                .for_each(|component| component[ray] *= more);
        }
    }
}

/// The stage on offer.
pub fn shading_adjoint_stage() -> Stage {
    Stage::new("Correct for shading normals", TileSystems::Roulette, correct_for_shading_normals)
        .on_light_paths()
        .kind(StageKind::Alternative)
        .when(|scene| traced_evidence(scene).and(|| vertex_normal_evidence(scene)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::ray_aim::Draws;

    /// With one normal nothing changes, and the way back undoes the way there.
    #[test]
    fn ways_there_and_back_undo_each_other() {
        for index in 0..20_000 {
            let mut draws = Draws::new(2731, index);
            let [normal, shading, a, b] = [(); 4].map(|()| draws.unit_vector().normalize());
            assert!((shading_adjoint(normal, normal, a, b) - 1.0).abs() < 1e-14);
            let both = shading_adjoint(normal, shading, a, b) * shading_adjoint(normal, shading, b, a);
            assert!((both - 1.0).abs() < 1e-12, "{index}: {both}");
        }
        assert_eq!(shading_adjoint(DVec3::Y, DVec3::X, DVec3::X, DVec3::Y), 0.0);
        eprintln!("shading normals: 20000 pairs of ways");
    }
}
