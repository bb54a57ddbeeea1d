//! The reader's function in the picture of chapter 29: boxes around meshes.

use super::question::Input;
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::extract::MeshTable;
use pinhole::intersect;
use pinhole::intersect::{HitPrimitives, Hits};
use pinhole::plan::{Column, Shared};
use pinhole::rays::WorldRays;
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};
use pinhole_lab::naive::boxes::box_of_mesh;
use pinhole_lab::naive::mesh::keep_closer;

/// The closest mesh of each ray; only those are intersected whose box the ray enters by the reader's function.
pub fn mine(ask: Ask<Input, bool>, _: &Setting<'_>) -> StandIn {
    StandIn::instead(
        intersect::mesh_stage,
        move |meshes: Res<Shared<MeshTable>>,
              mut boxes: Local<Vec<[DVec3; 2]>>,
              mut tiles: Query<(RowPlaces, &WorldRays, &mut Hits, Option<&mut HitPrimitives>)>| {
            if boxes.is_empty() {
                *boxes = meshes.row.iter().map(box_of_mesh).collect();
            }
            for (place, rays, mut hits, mut primitives) in &mut tiles {
                for row in 0..rays.rows() {
                    let (origin, direction) = (rays.origin_of(row), rays.direction_of(row));
                    for ((mesh, &shape), [low, high]) in meshes.row.iter().zip(&meshes.shape).zip(&*boxes) {
                        let (origin_asked, inverse) = (origin.into(), direction.recip().into());
                        let asked = (origin_asked, inverse, (*low).into(), (*high).into(), hits.t[row]);
                        if !ask.at(place, row, asked).unwrap_or(false) {
                            continue;
                        }
                        let closest = mesh.closest(origin, direction);
                        keep_closer((&mut *hits, primitives.as_deref_mut()), row, shape, closest);
                    }
                }
            }
        },
    )
}
