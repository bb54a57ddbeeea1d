//! The reader's function in the picture of chapter 13: rays with cuboids.

use super::question::{Answer, Input};
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::extract::CuboidTable;
use pinhole::intersect;
use pinhole::intersect::Hits;
use pinhole::plan::{Column, Shared};
use pinhole::rays::WorldRays;
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};

/// The nearest cuboid of each ray, each asked in its own axes about its own centre.
pub fn mine(ask: Ask<Input, Answer>, _: &Setting<'_>) -> StandIn {
    StandIn::instead(
        intersect::cuboid_stage,
        move |cuboids: Res<Shared<CuboidTable>>, mut tiles: Query<(RowPlaces, &WorldRays, &mut Hits)>| {
            for (place, rays, mut hits) in &mut tiles {
                for row in 0..rays.rows() {
                    for (slabs, &shape) in cuboids.row.iter().zip(&cuboids.shape) {
                        let own = |v: DVec3| slabs.normal.map(|normal| normal.dot(v));
                        let (origin, direction) =
                            (own(rays.origin_of(row) - slabs.centre), own(rays.direction_of(row)));
                        let asked = (origin, direction, slabs.half.map(|half| -half), slabs.half);
                        let t = ask.at(place, row, asked).flatten();
                        if let Some(t) = t.filter(|t| *t > 0.0 && *t < hits.t[row]) {
                            (hits.t[row], hits.shape[row]) = (t, shape);
                        }
                    }
                }
            }
        },
    )
}
