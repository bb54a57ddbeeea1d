//! A pixel's footprint on a surface.

use crate::each::Each;
use crate::extract::{
    EmissionMapTable, MeshTable, PixelSteps, ShapeTable, UvSlopes, filtered_emission_evidence, filtered_evidence,
    kind_evidence,
};
use crate::intersect::{EmissiveRows, HitPrimitives, Hits, MaterialRows, Surfaces};
use crate::plan::{Census, Column, Evidence, Shared, Stage, TileSystems, VectorRowsMut, column};
use crate::rays::WorldRays;
use crate::shapes::{PlacedMesh, Shape, UvSlope};
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use bevy_ecs::system::SystemParam;
use glam::DVec3;

column! {
    /// The footprint of each pixel on the surface that it sees: the offsets from its ray's intersection with the
    /// tangent plane to those of its right and lower neighbours' rays; infinite where they do not intersect it.
    pub struct Footprints("footprint", "world", "scene units", Ray, begun in Footprint) {
        /// The offset to the right.
        right: DVec3 as [rx, ry, rz],
        /// The offset down.
        down: DVec3 as [dx, dy, dz],
    }
}

impl Footprints {
    /// The square root of each offset's length, right as red and down as green, scaled such that 1 scene unit is one
    /// half.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        let shade = |step: DVec3| {
            let root = step.length().sqrt();
            if root.is_finite() { (root / (1.0 + root)) as f32 } else { 1.0 }
        };
        let [right, down] = self.get(row);
        [shade(right), shade(down), 0.0]
    }

    /// The offsets of a row: to the right, and down.
    #[inline(always)]
    pub fn get(&self, row: usize) -> [DVec3; 2] {
        [self.right(row), self.down(row)]
    }
}

// ANCHOR: step_on_surface
/// The differential of a hit along its tangent plane, as its ray changes to the next pixel's (ray differentials, Igehy
/// 1999).
///
/// Without the plane, the hit at O + tR would be displaced by `moved`: by the change of the origin, and t times that of
/// the direction.
/// That leaves the plane n · x = k by n · moved, which is corrected along R.
/// A ray parallel to the plane divides by 0: its footprint is infinite.
#[inline(always)]
pub fn step_on_surface(moved: DVec3, direction: DVec3, normal: DVec3) -> DVec3 {
    let step = moved - direction * (normal.dot(moved) / normal.dot(direction));
    if step.is_finite() { step } else { DVec3::INFINITY }
}
// ANCHOR_END: step_on_surface

/// The hits on surfaces, and the pixel's footprints on them.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct FootprintView {
    rays: &'static WorldRays,
    hits: &'static Hits,
    surfaces: &'static Surfaces,
    list: &'static MaterialRows,
    emissive: Option<&'static EmissiveRows>,
    footprints: &'static mut Footprints,
}

/// Computes the footprint of each pixel on the surface that it sees.
pub fn compute_footprints(
    (steps, emission): (Res<Shared<PixelSteps>>, Option<Res<Shared<EmissionMapTable>>>),
    mut tiles: Query<FootprintView>,
) {
    for FootprintViewItem { rays, hits, surfaces, list, emissive, mut footprints } in &mut tiles {
        // A shape that only emits has no material.
        let emissive = emissive.filter(|_| emission.is_some()).map_or(&[][..], |emissive| &emissive.row);
        let (mut right, mut down) = footprints.slices_mut(surfaces.rows());
        right.set_all([0.0; 3]);
        down.set_all([0.0; 3]);
        for &row in list.row.iter().chain(emissive) {
            let row = row as usize;
            let direction = rays.direction_of(row);
            let normal = surfaces.get(row).normal.as_dvec3();
            // The offsets are those of a direction that ends on the image plane at distance 1, while this direction has
            // length 1.
            let distance = hits.t[row] * direction.dot(steps.ahead);
            let moved = match steps.angle {
                None => {
                    [steps.origin[0] + steps.direction[0] * distance, steps.origin[1] + steps.direction[1] * distance]
                }
                Some(angle) => {
                    <[DVec3; 2]>::from(direction.any_orthonormal_pair()).each(|tangent| tangent * (angle * hits.t[row]))
                }
            };
            right.put(row, step_on_surface(moved[0], direction, normal));
            down.put(row, step_on_surface(moved[1], direction, normal));
        }
    }
}

/// The stage that runs [`compute_footprints`].
pub fn footprint_stage() -> Stage {
    Stage::new("Compute footprints", TileSystems::Footprint, compute_footprints)
        .reads_where::<EmissiveRows>(filtered_emission_evidence)
        .table_where::<EmissionMapTable>(filtered_emission_evidence)
        .when(filtered_evidence)
}

/// The gradients of u and v where rays hit: one for each shape, or for each triangle of a mesh.
#[derive(SystemParam)]
pub struct RowSlopes<'w> {
    slopes: Option<Res<'w, Shared<UvSlopes>>>,
    meshes: Option<Res<'w, Shared<MeshTable>>>,
    shapes: Option<Res<'w, Shared<ShapeTable>>>,
}

impl RowSlopes<'_> {
    /// Those of a shape, at the primitive that a row hit; none where nothing asks for any.
    #[inline(always)]
    pub fn get(&self, shape: usize, primitives: Option<&HitPrimitives>, row: usize) -> Option<UvSlope> {
        let slope = self.slopes.as_ref()?.slope[shape];
        match (slope, &self.meshes, &self.shapes, primitives) {
            (UvSlope::OfPrimitive, Some(meshes), Some(shapes), Some(primitives)) => {
                let mesh = &meshes.row[shapes.row[shape] as usize];
                Some(mesh.uv_slope_of(&(), primitives.primitive[row]))
            }
            _ => Some(slope),
        }
    }
}

/// Declares what [`RowSlopes`] reads of meshes, where there are any that keep still.
pub fn with_mesh_slopes(stage: Stage) -> Stage {
    stage
        .table_where::<MeshTable>(mesh_evidence)
        .table_where::<ShapeTable>(mesh_evidence)
        .reads_where::<HitPrimitives>(mesh_evidence)
}

fn mesh_evidence(scene: &Census<'_>) -> Evidence {
    kind_evidence::<PlacedMesh>(scene)
}

#[cfg(test)]
mod footprint_tests {
    use super::*;

    #[test]
    fn an_offset_is_in_the_plane_and_ends_on_the_neighbour_s_ray() {
        // A floor 1 below the eye, a ray at 45° down and ahead, and its lower neighbour, a thousandth steeper on the
        // image plane.
        let (normal, unit) = (DVec3::Y, DVec3::new(0.0, -1.0, -1.0));
        let direction = unit.normalize();
        let (t, distance) = (2.0_f64.sqrt(), 1.0);
        let small = DVec3::new(0.0, -1e-3, 0.0);
        let step = step_on_surface(small * distance, direction, normal);
        let neighbour = (unit + small) / 1.001;
        let truth = neighbour - direction * t;
        assert!(step.y.abs() < 1e-15 && (step - truth).length() < 2e-6, "{step} for {truth}");
        // Towards the horizon the derivative is no longer close to the difference, but it is finite.
        assert!(step_on_surface(DVec3::X, DVec3::NEG_Z, DVec3::Y) == DVec3::INFINITY);
        assert!(step_on_surface(DVec3::X, DVec3::new(0.0, -1e-300, -1.0), DVec3::Y).x == 1.0);
    }
}
