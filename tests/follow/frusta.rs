//! Capped cylinders and cones as lights: found by BSDF sampling, sampled, and as starts of light paths.

use super::caustics::agrees;
use super::*;
use glam::{DQuat, DVec3};
use pinhole::scene::*;

/// A camera that looks down at a ground and a ball.
pub(super) fn ground_and_ball(ball: impl Bundle, place: Placement) -> World {
    let mut world = World::new();
    let look = LookAt { eye: DVec3::new(0.2, 2.4, 3.2), target: DVec3::new(0.0, 0.3, 0.0), up: DVec3::Y };
    let fov = PerspectiveCamera { fov: Degrees(50.0), ..Default::default() };
    let integrator = Integrator::Path { max_depth: 5, lights: LightStrategy::Mis, roulette: 0 };
    world.spawn((Name::new("camera"), look, fov, Resolution { width: 32, height: 24 }, integrator));
    let grey = Matte { colour: Rgb::new(0.7, 0.6, 0.5) };
    world.spawn((Rectangle { width: 5.0, depth: 5.0 }, Placement::at(0.0, 0.0, 0.0), grey));
    world.spawn((Sphere { radius: 0.4 }, place, ball));
    world
}

/// A ground under a cylinder that lies on its side, scaled in its axes differently, and under a cone on its tip.
///
/// Ground and ball see their sides, and some points a base.
fn under_a_pipe_and_a_hat(ball: impl Bundle) -> World {
    let mut world = ground_and_ball(ball, Placement::at(0.1, 0.9, 0.0));
    let emissive = |r, g, b| Emissive { radiance: Rgb::new(r, g, b), ..Emissive::default() };
    let orientation = DQuat::from_xyzw(0.1, 0.2, 0.6, 0.7).normalize();
    let scale = DVec3::new(0.7, 1.3, 1.6);
    let lying = Placement { orientation, scale, ..Placement::at(-1.2, 1.3, 0.1) };
    world.spawn((Cylinder { radius: 0.25, height: 0.8, capped: true }, lying, emissive(6.0, 5.0, 3.0)));
    let upside_down =
        Placement { orientation: DQuat::from_xyzw(1.0, 0.0, 0.1, 0.0).normalize(), ..Placement::at(1.3, 0.9, 0.2) };
    world.spawn((Cone { radius: 0.45, height: 0.8, capped: true }, upside_down, emissive(3.0, 4.0, 6.0)));
    world
}

#[test]
fn light_strategies_agree_under_cylinders_and_cones() {
    let make = || under_a_pipe_and_a_hat(Matte { colour: Rgb::new(0.5, 0.7, 0.8) });
    strategies_agree("a pipe and a hat", &make, ALL, 6, 8);
}

#[test]
fn light_paths_that_start_on_cylinders_and_cones_bring_what_the_camera_s_paths_bring() {
    agrees("caustics of a pipe and a hat", &|| under_a_pipe_and_a_hat(Glass::default()), 16);
}
