//! The reader's function in the picture of chapter 19: the rays that mirrors reflect.

use super::question::{Input, Vector};
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::follow::{Scattered, specular_stage};
use pinhole::intersect::Surfaces;
use pinhole::material::MirrorTable;
use pinhole::plan::Column;
use pinhole::rays::WorldRays;
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};

/// Directions in which light goes on from mirrors.
pub fn mine(ask: Ask<Input, Vector>, _: &Setting<'_>) -> StandIn {
    StandIn::after(
        specular_stage::<MirrorTable>,
        move |mut tiles: Query<(RowPlaces, &WorldRays, &Surfaces, &mut Scattered)>| {
            for (place, rays, surfaces, mut scattered) in &mut tiles {
                // Rough metal has a pdf, a mirror has none.
                for ray in (0..scattered.rows()).filter(|&ray| scattered.pdf[ray] == f64::INFINITY).collect::<Vec<_>>()
                {
                    let row = scattered.path[ray] as usize;
                    let normal = surfaces.get(row).normal.as_dvec3();
                    if let Some(direction) = ask.at(place, row, (rays.direction_of(row).into(), normal.into())) {
                        let direction = DVec3::from(direction).as_vec3();
                        (scattered.dx[ray], scattered.dy[ray], scattered.dz[ray]) = direction.into();
                    }
                }
            }
        },
    )
}
