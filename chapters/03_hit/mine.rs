//! The reader's function in the picture of chapter 03: rays with spheres.

use super::question::{Answer, Input};
use bevy_ecs::prelude::*;
use pinhole::extract::SphereTable;
use pinhole::intersect;
use pinhole::intersect::Hits;
use pinhole::plan::{Column, Shared};
use pinhole::rays::WorldRays;
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};

/// The nearest sphere of each ray.
pub fn mine(ask: Ask<Input, Answer>, _: &Setting<'_>) -> StandIn {
    StandIn::instead(
        intersect::sphere_stage,
        move |spheres: Res<Shared<SphereTable>>, mut tiles: Query<(RowPlaces, &WorldRays, &mut Hits)>| {
            for (place, rays, mut hits) in &mut tiles {
                for row in 0..rays.rows() {
                    let (origin, direction) = (rays.origin_of(row).into(), rays.direction_of(row).into());
                    for (sphere, &shape) in spheres.row.iter().zip(&spheres.shape) {
                        let asked = (origin, direction, sphere.centre.into(), sphere.radius);
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
