//! The reader's function in the picture of chapter 30: pebbles through a tree of boxes.

use super::question::{Answer, Input};
use bevy_ecs::prelude::*;
use pinhole::extract::SphereTable;
use pinhole::intersect;
use pinhole::intersect::Hits;
use pinhole::plan::{Column, Shared};
use pinhole::rays::WorldRays;
use pinhole::shapes::Shape;
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};
use pinhole_lab::naive::tree::{Search, Tree, by_cost};
use std::sync::{Arc, OnceLock};

/// Spheres through the plain tree of the page, whose children are visited as the reader says.
pub fn mine(ask: Ask<Input, Answer>, _: &Setting<'_>) -> StandIn {
    let tree: Arc<OnceLock<Tree>> = Arc::default();
    StandIn::instead(
        intersect::sphere_stage,
        move |spheres: Res<Shared<SphereTable>>, mut tiles: Query<(RowPlaces, &WorldRays, &mut Hits)>| {
            let tree = tree.get_or_init(|| Tree::of_shapes(&spheres.row, by_cost));
            for (place, rays, mut hits) in &mut tiles {
                for row in 0..rays.rows() {
                    let ray = [rays.origin_of(row), rays.direction_of(row)];
                    let mut search = Search::new(ray, hits.t[row]);
                    let order = |enters, closest| ask.at(place, row, (enters, closest)).unwrap_or_default();
                    tree.closest(&mut search, &order, &mut |number| spheres.row[number].t(ray[0], ray[1]));
                    if search.t < hits.t[row] {
                        (hits.t[row], hits.shape[row]) = (search.t, spheres.shape[search.number]);
                    }
                }
            }
        },
    )
}
