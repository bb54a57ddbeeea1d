use super::ShadowRays;
use super::light::{either, or_light};
use crate::each::set_all;
use crate::extract::{
    HierarchyOf, delta_light_evidence, hierarchy_evidence, joined_evidence, kind_evidence, light_kinds,
    material_evidence, moving_evidence, occlusion_evidence, unless_occlusion,
};
use crate::intersect::{HitColumn, NO_SHAPE, intersect_moving, intersect_shapes};
use crate::plan::{Census, Column, Evidence, Stage, TileSystems, column};
use crate::shapes::{ClosestHits, Listed, PlacedPlane, PlacedSphere, ShapeVisitor, visit_shapes};
use bevy_ecs::prelude::*;

column! {
    /// The shape, if any, that blocks each shadow ray.
    pub struct ShadowHits("shadow hit", "along the shadow ray", "scene units", Ray, begun in ClearShadows) {
        /// The distance to the blocking shape, or the shadow ray's t_max where it is not blocked.
        t: f64,
        /// The number of the blocking shape; none where the light is visible.
        shape: u32,
        /// The row of the tile whose surface the shadow ray starts on.
        row: u32,
    }
}

impl ShadowHits {
    /// White where the light is visible, black in shadow.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [if self.shape[row] == NO_SHAPE { 1.0 } else { 0.0 }; 3]
    }
}

impl HitColumn for ShadowHits {
    fn closest_hits(&mut self) -> ClosestHits<'_> {
        let (t, shape, _) = self.slices_mut(self.rows());
        ClosestHits { t, shape, primitive: None, any: true }
    }
}

/// Sets every shadow ray to unblocked up to its t_max.
pub fn start_shadows(mut tiles: Query<(&ShadowRays, &mut ShadowHits)>) {
    for (rays, mut hits) in &mut tiles {
        let (t, shape, path) = hits.slices_mut(rays.rows());
        for (t, &t_max) in t.iter_mut().zip(&rays.t_max) {
            *t = f64::from(t_max);
        }
        set_all(shape, NO_SHAPE);
        path.copy_from_slice(&rays.row);
    }
}

/// The stage that clears shadow hits.
pub fn start_shadow_stage() -> Stage {
    Stage::new("Clear shadow hits", TileSystems::ClearShadows, start_shadows).when(shadow_evidence)
}

// ANCHOR: shape_shadow_stage
/// The stage that intersects shadow rays with one kind of shape.
pub fn shape_shadow_stage<S: Listed>() -> Stage {
    let intersect = intersect_shapes::<S, ShadowRays, ShadowHits>;
    Stage::new(S::NAMES.shadow, TileSystems::TraceShadowRays, intersect)
        .table_where::<HierarchyOf<S>>(hierarchy_evidence::<S>)
        .when(|scene| kind_evidence::<S>(scene).and(|| shadow_evidence(scene)))
}
// ANCHOR_END: shape_shadow_stage

/// The stage that intersects shadow rays with spheres.
pub fn sphere_shadow_stage() -> Stage {
    shape_shadow_stage::<PlacedSphere>()
}

/// The stage that intersects shadow rays with planes.
pub fn plane_shadow_stage() -> Stage {
    shape_shadow_stage::<PlacedPlane>()
}

/// The stages that trace shadow rays for each registered shape, and whether it is one that only a non-uniform scale
/// makes.
pub fn shape_shadow_stages() -> Vec<(bool, fn() -> Stage)> {
    struct Collected(Vec<(bool, fn() -> Stage)>);
    impl ShapeVisitor for Collected {
        fn visit<S: Listed>(&mut self) {
            self.0.push((S::NON_UNIFORM == Some(true), shape_shadow_stage::<S>));
        }
    }
    let mut collected = Collected(Vec::new());
    visit_shapes(&mut collected);
    collected.0
}

/// The stage that intersects shadow rays with moving shapes, each at the time of the ray that hit the surface.
pub fn moving_shadow_stage() -> Stage {
    let intersect = intersect_moving::<ShadowRays, ShadowHits>;
    Stage::new("Trace shadow rays: moving shapes", TileSystems::TraceShadowRays, intersect)
        .when(|scene| moving_evidence(scene).and(|| shadow_evidence(scene)))
}

/// Evidence that a light casts shadows on a material.
pub fn shadow_evidence(scene: &Census<'_>) -> Evidence {
    let points = delta_light_evidence(scene, "shadow-casting light", |entity| {
        light_kinds(scene).any(|kind| (kind.casts_shadows)(entity))
    });
    let receiving = or_light(scene, points).and(|| material_evidence(scene));
    either(either(unless_occlusion(scene, receiving), joined_evidence(scene)), occlusion_evidence(scene))
}
