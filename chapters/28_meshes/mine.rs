//! The reader's function in the picture of chapter 28: rays with meshes.

use super::question::{Answer, Input};
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::extract::MeshTable;
use pinhole::intersect;
use pinhole::intersect::{HitPrimitives, Hits};
use pinhole::plan::{Column, Shared};
use pinhole::rays::WorldRays;
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};

/// The closest mesh of each ray, each asked along the ray that the reader's function gives, wherever that is in the world.
pub fn mine(ask: Ask<Input, Answer>, _: &Setting<'_>) -> StandIn {
    StandIn::instead(
        intersect::mesh_stage,
        move |meshes: Res<Shared<MeshTable>>,
              mut tiles: Query<(RowPlaces, &WorldRays, &mut Hits, Option<&mut HitPrimitives>)>| {
            for (place, rays, mut hits, mut primitives) in &mut tiles {
                for row in 0..rays.rows() {
                    let ray = [rays.origin_of(row), rays.direction_of(row)];
                    for (mesh, &shape) in meshes.row.iter().zip(&meshes.shape) {
                        let columns = [0, 1, 2].map(|axis| mesh.world_from_object.col(axis));
                        let (scale, axes) =
                            (columns.map(DVec3::length), columns.map(|column| column.normalize().into()));
                        let asked = (ray[0].into(), ray[1].into(), mesh.position.into(), axes, scale);
                        let Some([origin, direction]) = ask.at(place, row, asked) else { continue };
                        let origin = mesh.world_from_object * DVec3::from(origin) + mesh.position;
                        let closest = mesh.closest(origin, mesh.world_from_object * DVec3::from(direction));
                        if closest.t < hits.t[row] {
                            (hits.t[row], hits.shape[row]) = (closest.t, shape);
                            if let Some(primitives) = &mut primitives {
                                primitives.primitive[row] = closest.primitive;
                            }
                        }
                    }
                }
            }
        },
    )
}
