//! The reader's function in the picture of chapter 20: the rays that glass lets through.

use super::question::{Input, Vector};
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::extract::GlassTable;
use pinhole::follow::{Scattered, split_stage};
use pinhole::intersect::Surfaces;
use pinhole::material::SmoothGlass;
use pinhole::plan::{Column, Shared};
use pinhole::rays::WorldRays;
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};

/// Below this sine of the angle to the normal a ray is hardly bent, and does not tell by which index.
const TELLS: f64 = 1e-3;

/// Directions in which light goes on into glass and out of it.
pub fn mine(ask: Ask<Input, Option<Vector>>, _: &Setting<'_>) -> StandIn {
    StandIn::after(
        split_stage::<SmoothGlass>,
        move |glass: Res<Shared<GlassTable>>, mut tiles: Query<(RowPlaces, &WorldRays, &Surfaces, &mut Scattered)>| {
            for (place, rays, surfaces, mut scattered) in &mut tiles {
                for ray in 0..scattered.rows() {
                    let row = scattered.path[ray] as usize;
                    let (direction, normal) = (rays.direction_of(row), surfaces.get(row).normal.as_dvec3());
                    let bent = DVec3::new(
                        f64::from(scattered.dx[ray]),
                        f64::from(scattered.dy[ray]),
                        f64::from(scattered.dz[ray]),
                    );
                    let sine = bent.cross(normal).length();
                    if bent.dot(normal) > 0.0 || sine < TELLS {
                        continue;
                    }
                    let eta = nearest_eta(&glass.ior, direction.cross(normal).length() / sine);
                    let Some(direction) = ask.at(place, row, (direction.into(), normal.into(), eta)) else { continue };
                    match direction {
                        Some(direction) => {
                            let direction = DVec3::from(direction).as_vec3();
                            (scattered.dx[ray], scattered.dy[ray], scattered.dz[ray]) = direction.into();
                        }
                        None => (scattered.r[ray], scattered.g[ray], scattered.b[ray]) = (0.0, 0.0, 0.0),
                    }
                }
            }
        },
    )
}

/// The quotient of two of the scene's indices, air's 1 among them, that is nearest to a measured one.
fn nearest_eta(iors: &[f64], measured: f64) -> f64 {
    let media = || iors.iter().copied().chain([1.0]);
    let quotients = media().flat_map(|far| media().map(move |near| far / near));
    quotients.min_by(|a, b| (a - measured).abs().total_cmp(&(b - measured).abs())).unwrap_or(measured)
}
