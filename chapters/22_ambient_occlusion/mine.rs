//! The reader's function in the picture of chapter 22: the directions of the open sky.

use super::question::Input;
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::extract::SamplingTable;
use pinhole::follow;
use pinhole::intersect::Surfaces;
use pinhole::material::frame_of;
use pinhole::plan::Shared;
use pinhole::rays::{Depth, Draws, SampleNumber, draws_of_two};
use pinhole::sample::Purpose;
use pinhole::shade::LightRays;
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};

/// Directions about the normal, in which the open sky is looked for.
pub fn mine(ask: Ask<Input, [f64; 3]>, _: &Setting<'_>) -> StandIn {
    StandIn::after(
        follow::sky_rays_stage,
        move |sampling: Res<Shared<SamplingTable>>,
              mut points: Local<Vec<[f64; 2]>>,
              mut tiles: Query<(RowPlaces, Option<&SampleNumber>, &Surfaces, &mut LightRays)>| {
            for (place, number, surfaces, mut rays) in &mut tiles {
                let (tile, samples, _) = place;
                let draws = Draws { sampling: &sampling, tile, number, samples, paths: None, depth: Depth(0) };
                draws_of_two(&draws, Purpose::Direction, &rays.path, &mut points);
                for (ray, &[u, v]) in points.iter().enumerate() {
                    let row = rays.path[ray] as usize;
                    if let Some(own) = ask.at(place, row, (u, v)) {
                        let direction = frame_of(surfaces.get(row).normal.as_dvec3()) * DVec3::from(own);
                        (rays.dx[ray], rays.dy[ray], rays.dz[ray]) = direction.as_vec3().into();
                    }
                }
            }
        },
    )
}
