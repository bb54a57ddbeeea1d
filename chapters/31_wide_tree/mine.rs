//! The reader's function in the picture of chapter 31: pearls through the renderer's wide tree.

use super::question::Input;
use bevy_ecs::prelude::*;
use pinhole::bvh::Bvh;
use pinhole::extract::SphereTable;
use pinhole::intersect;
use pinhole::intersect::Hits;
use pinhole::plan::{Column, Shared};
use pinhole::rays::WorldRays;
use pinhole::shapes::{Shape, hierarchy_of};
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};
use pinhole_lab::naive::wide::{closest, first_planes};
use std::sync::{Arc, OnceLock};

/// Spheres through the wide tree in plain f64, with the reader's mask at every node.
pub fn mine(ask: Ask<Input, u32>, _: &Setting<'_>) -> StandIn {
    let tree: Arc<OnceLock<Bvh>> = Arc::default();
    StandIn::instead(
        intersect::sphere_stage,
        move |spheres: Res<Shared<SphereTable>>, mut tiles: Query<(RowPlaces, &WorldRays, &mut Hits)>| {
            // Spheres are bounded.
            let tree = tree.get_or_init(|| hierarchy_of(&spheres.row).unwrap_or_default());
            for (place, rays, mut hits) in &mut tiles {
                for row in 0..rays.rows() {
                    let ray = [rays.origin_of(row), rays.direction_of(row)];
                    let mask = |enters, leaves, t| ask.at(place, row, (enters, leaves, t)).unwrap_or(0);
                    let t_of = |number: usize| spheres.row[number].t(ray[0], ray[1]);
                    let (t, number) = closest(tree, (ray, first_planes(ray[1])), hits.t[row], mask, t_of);
                    if t < hits.t[row] {
                        (hits.t[row], hits.shape[row]) = (t, spheres.shape[number]);
                    }
                }
            }
        },
    )
}
