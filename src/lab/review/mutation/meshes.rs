//! Mistakes between rays and meshes.

use bevy_ecs::prelude::*;
use pinhole::extract::{MeshTable, ShapeTable};
use pinhole::intersect::{Hits, NO_SHAPE, ShapeRows, Surfaces};
use pinhole::plan::{Column, Shared};
use pinhole::rays::WorldRays;
use pinhole::shapes::{PlacedMesh, ShapeKind};

/// The direction brought to length 1 in object space, so that t counts in a unit of the mesh's own.
pub fn own_unit(
    meshes: Res<Shared<MeshTable>>,
    shapes: Res<Shared<ShapeTable>>,
    mut tiles: Query<(&WorldRays, &mut Hits)>,
) {
    for (rays, mut hits) in &mut tiles {
        for row in 0..rays.rows() {
            let shape = hits.shape[row] as usize;
            if hits.shape[row] != NO_SHAPE && shapes.kind[shape] == ShapeKind::Mesh {
                let mesh = &meshes.row[shapes.row[shape] as usize];
                hits.t[row] *= (mesh.object_from_world * rays.direction_of(row)).length();
            }
        }
    }
}

/// The sign of the normal.
pub fn inward(mut tiles: Query<(&ShapeRows<PlacedMesh>, &mut Surfaces)>) {
    for (list, mut surfaces) in &mut tiles {
        for &row in &list.row {
            let mut surface = surfaces.get(row as usize);
            surface.normal = -surface.normal;
            surfaces.set(row as usize, surface);
        }
    }
}

/// No mesh is looked for.
pub fn ignored() {}
