//! The reader's function in the picture of chapter 24: rays with moving spheres.

use super::question::{Answer, Input};
use bevy_ecs::prelude::*;
use pinhole::extract::MovingTable;
use pinhole::intersect;
use pinhole::intersect::{Hits, at_rest};
use pinhole::plan::{Column, Shared};
use pinhole::rays::{RayTimes, WorldRays};
use pinhole::shapes::{Body, PlacedSphere};
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};

/// The nearest moving shape of each ray; spheres by the reader's function.
pub fn mine(ask: Ask<Input, Answer>, _: &Setting<'_>) -> StandIn {
    StandIn::instead(
        intersect::moving_stage,
        move |moving: Res<Shared<MovingTable>>, mut tiles: Query<(RowPlaces, &WorldRays, &RayTimes, &mut Hits)>| {
            for (place, rays, times, mut hits) in &mut tiles {
                for row in 0..rays.rows() {
                    let (origin, direction, time) = (rays.origin_of(row), rays.direction_of(row), times.time[row]);
                    for ((body, &velocity), &shape) in moving.body.iter().zip(&moving.velocity).zip(&moving.shape) {
                        let still = at_rest(origin, velocity, time);
                        let t = match body {
                            Body::Sphere(PlacedSphere { centre, radius }, ()) => {
                                // The reader is promised a direction of length 1, which f32 is not to the last digit.
                                let length = direction.length();
                                let (o, d) = (origin.into(), (direction / length).into());
                                let asked = (o, d, (*centre).into(), *radius, velocity.into(), time);
                                ask.at(place, row, asked).flatten().map_or(f64::INFINITY, |t| t / length)
                            }
                            other => other.t(still, direction),
                        };
                        if t > 0.0 && t < hits.t[row] {
                            (hits.t[row], hits.shape[row]) = (t, shape);
                        }
                    }
                }
            }
        },
    )
}
