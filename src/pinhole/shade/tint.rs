//! Factors of surfaces' colours: those of the material, and those of a mesh's vertices.

use super::SurfaceColours;
use super::row_slopes::with_mesh_slopes;
use crate::extract::{MeshTable, MovingTable, ShapeTable, TintTable, tint_evidence, vertex_colour_evidence};
use crate::intersect::{HitPrimitives, Hits, MaterialRows, Surfaces, at_rest};
use crate::plan::{Shared, Stage, TileSystems};
use crate::rays::{RayTimes, WorldRays};
use crate::shapes::{AnyShape, PlacedMesh, RayHit, ShapeKind};
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use bevy_ecs::system::SystemParam;

/// The hits of a tile, and the colours that are multiplied there.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct TintView {
    rays: &'static WorldRays,
    hits: &'static Hits,
    surfaces: &'static Surfaces,
    materials: &'static MaterialRows,
    primitives: Option<&'static HitPrimitives>,
    times: Option<&'static RayTimes>,
    colours: &'static mut SurfaceColours,
}

/// The meshes that have colours; none where no tint asks for them.
#[derive(SystemParam)]
pub struct ColouredMeshes<'w> {
    shapes: Option<Res<'w, Shared<ShapeTable>>>,
    meshes: Option<Res<'w, Shared<MeshTable>>>,
    moving: Option<Res<'w, Shared<MovingTable>>>,
}

impl ColouredMeshes<'_> {
    /// The colour of a mesh where a ray hits it.
    fn colour(&self, hit: &TintViewItem<'_, '_>, row: usize) -> Option<[f64; 3]> {
        let (shapes, primitive) = (self.shapes.as_ref()?, hit.primitives?.primitive[row]);
        let shape = hit.hits.shape[row] as usize;
        let (origin, own) = (hit.rays.origin_of(row), shapes.row[shape] as usize);
        let (mesh, origin): (&PlacedMesh, _) = match (shapes.kind[shape], &self.moving, hit.times) {
            (ShapeKind::Moving, Some(moving), Some(times)) => match &moving.body[own] {
                AnyShape::Mesh(mesh, ()) => (mesh, at_rest(origin, moving.velocity[own], times.time[row])),
                _ => return None,
            },
            (ShapeKind::Mesh, ..) => (&self.meshes.as_ref()?.row[own], origin),
            _ => return None,
        };
        let ray = RayHit::at_rest(origin, hit.rays.direction_of(row), hit.hits.t[row]);
        mesh.vertex_colour(&RayHit { primitive, ..ray })
    }
}

/// Multiplies the colours of surfaces whose material is tinted.
pub fn tint_surfaces(tints: Res<Shared<TintTable>>, meshes: ColouredMeshes<'_>, mut tiles: Query<TintView>) {
    for mut hit in &mut tiles {
        for &row in &hit.materials.row {
            let row = row as usize;
            let Some(tint) = tints.row_of(hit.surfaces.material[row] as usize) else { continue };
            let vertices = if tints.by_vertex[tint] { meshes.colour(&hit, row) } else { None };
            let (own, factor, vertices) = (hit.colours.get(row), tints.factor[tint], vertices.unwrap_or([1.0; 3]));
            hit.colours.set(row, [0, 1, 2].map(|part| own[part] * factor[part] * vertices[part]));
        }
    }
}

/// The stage that runs [`tint_surfaces`].
pub fn tint_stage() -> Stage {
    // What moves has been intersected with its table and its times, which are there therefore.
    with_mesh_slopes(Stage::new("Multiply by vertex colours", TileSystems::Tint, tint_surfaces))
        .reads_where::<HitPrimitives>(vertex_colour_evidence)
        .when(tint_evidence)
}
