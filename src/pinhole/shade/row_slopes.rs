use crate::extract::{MeshTable, ShapeTable, UvSlopes, kind_evidence};
use crate::intersect::HitPrimitives;
use crate::plan::{Census, Evidence, Shared, Stage};
use crate::shapes::{PlacedMesh, Shape, UvSlope};
use bevy_ecs::prelude::*;
use bevy_ecs::system::SystemParam;

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
