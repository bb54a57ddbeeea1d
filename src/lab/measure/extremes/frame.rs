//! Whole frames: a camera looks at the limb of a sphere, and every pixel goes through all stages up to its hit.

use super::sphere::{T_BOUND, by_function, exact};
use super::{Group, Method, Tally, Trial};
use crate::measure::oracle_sphere::Sphere as ExactSphere;
use crate::measure::ray_aim::{AimedRay, Draws};
use bevy_ecs::prelude::*;
use glam::Vec3;
use pinhole::extract::SphereTable;
use pinhole::film::film_stage;
use pinhole::intersect::Hits;
use pinhole::look::view_stage;
use pinhole::plan::{Census, Column, Stage, Table};
use pinhole::rays::WorldRays;
use pinhole::render::inspect;
use pinhole::scene::*;
use pinhole::stages;
use std::ops::Range;

/// The side of a frame in pixels.
const SIDE: u32 = 16;
/// Rays of a frame.
const RAYS: u64 = (SIDE * SIDE) as u64;

const METHODS: [Method; 1] = [Method::pinhole("pinhole, frames of 16 x 16 through inspect", "u of t", T_BOUND)];

/// The one case.
pub fn trial() -> Trial {
    Trial::new(Group::Sphere, "limbs at 1.001 to 1e4 radii, as a camera sees them", &METHODS, check)
}

fn check(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(METHODS.len());
    for first in range.clone().step_by(RAYS as usize) {
        let rays = (range.end - first).min(RAYS) as usize;
        check_frame(&scene(first / RAYS), rays, &mut tally);
    }
    tally
}

/// The stages of chapter 3: up to the hits, which a view asks for.
fn offer() -> Vec<Stage> {
    let mut offer = [stages::camera_rays(), stages::intersection()].concat();
    offer.push(view_stage(&offer));
    offer.push(film_stage());
    offer
}

/// A camera anywhere, a sphere of any size, a view whose middle is the sphere's limb.
fn scene(frame: u64) -> World {
    let mut draws = Draws::new(33, frame);
    let radius = draws.power_of_ten(-6.0, 6.0);
    let distance = 1.0 + draws.power_of_ten(-3.0, 4.0);
    let eye = draws.unit_vector() * draws.power_of_ten(-6.0, 6.0);
    let towards = draws.unit_vector();
    let across = draws.unit_vector_across(towards);
    let angle = libm::asin(1.0 / distance);
    let limb = (towards * libm::cos(angle) + across * libm::sin(angle)) * (distance * radius + eye.length());
    // From the narrowest pixels that are taken to a wide view.
    let pixel = draws.power_of_ten(-5.3, -2.0);
    let fov = Degrees((2.0 * libm::atan(pixel * f64::from(SIDE) / 2.0)).to_degrees());

    let mut world = World::new();
    world.spawn((
        PerspectiveCamera { fov, axis: FovAxis::Vertical },
        LookAt { eye, target: eye + limb, up: draws.unit_vector() },
        Resolution { width: SIDE, height: SIDE },
        View { column: Hits::NAME.into() },
    ));
    let centre = eye + towards * (distance * radius);
    world.spawn((Sphere { radius }, Placement::at(centre.x, centre.y, centre.z), Matte::default()));
    world
}

/// Checks the first rays of a frame; a scene that is refused is a failure.
fn check_frame(scene: &World, rays: usize, tally: &mut Tally) {
    let (frame, table) = (inspect(scene, &offer(), SIDE), SphereTable::extract(&Census::of(scene)));
    let (Ok(frame), Ok(table)) = (frame, table) else {
        tally.scores[0].check(false);
        return;
    };
    let sphere = ExactSphere { centre: table.row[0].centre, radius: table.row[0].radius };
    let tile = frame.world.entity(frame.tiles[0]);
    let (Some(world), Some(hits)) = (tile.get::<WorldRays>(), tile.get::<Hits>()) else { return };
    for row in 0..rays {
        let origin = Vec3::new(world.ox[row], world.oy[row], world.oz[row]);
        let ray = AimedRay { origin, direction: Vec3::new(world.dx[row], world.dy[row], world.dz[row]) };
        let exact = exact(ray, sphere);
        tally.count(exact.is_some());
        tally.scores[0].check(hits.t[row].to_bits() == by_function(ray, sphere).to_bits());
        tally.scores[0].check_t(Some(hits.t[row]).filter(|t| t.is_finite()), exact);
    }
}
