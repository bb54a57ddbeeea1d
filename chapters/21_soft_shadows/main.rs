//! Lamps with an area: a shadow's edge is as soft as the lamp is wide. One point of one lamp is asked at a time, at random.
//! A wide lamp overhead, a small one aside: the box and the ball have a shadow of each.
//! New here: `Emissive` lights other surfaces; the stage "Aim at lights with area"; the camera's `Integrator`.

use bevy_ecs::prelude::*;
use pinhole::scene::*;
use pinhole::{Chapter, intersect, rays, shade};

fn main() -> pinhole::Result {
    pinhole::run(chapter())
}

// ANCHOR: chapter
/// The scene, and the stages on offer.
pub fn chapter() -> Chapter {
    Chapter::new("21_soft_shadows", "lights with an area", scene)
        .offer(rays::stages())
        .offer(intersect::stages())
        .offer(shade::start_stage())
        .offer(shade::background_stage())
        .offer(shade::start_light_stage())
        .offer(shade::start_shadow_stage())
        .offer(shade::sphere_shadow_stage())
        .offer(shade::plane_shadow_stage())
        .offer(shade::rectangle_shadow_stage())
        .offer(shade::cuboid_shadow_stage())
        .offer(shade::light_stage())
        .offer(shade::emissive_stage())
        .offer(shade::area_light_stage())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(38.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.3, 2.1, 6.2].into(), target: [0.1, 0.85, 0.0].into(), ..LookAt::default() },
        Sampling { samples: 64, seed: 21, sampler: Sampler::Sobol, filter: Filter::GAUSSIAN },
        Integrator::Distribution { legs: 1 },
    ));
    world.spawn((Name::new("floor"), Plane::default(), Matte { colour: Rgb::grey(0.6) }));
    let ball = (Sphere { radius: 0.7 }, Placement::at(-0.9, 0.7, 0.2), Matte { colour: Rgb::new(0.7, 0.35, 0.2) });
    world.spawn((Name::new("ball"), ball));
    let turned = DQuat::from_xyzw(0.0, 0.26, 0.0, 0.966).normalize();
    let on_floor = Placement { orientation: turned, ..Placement::at(1.0, 0.6, -0.4) };
    let size = [0.5, 1.2, 0.5].into();
    world.spawn((Name::new("box"), Cuboid { size }, on_floor, Matte { colour: Rgb::grey(0.7) }));
    // Its own +y, where it shines, looks down and to the right.
    let downward = DQuat::from_xyzw(0.0, 0.0, 0.955, -0.296).normalize();
    let overhead = Placement { orientation: downward, ..Placement::at(-1.6, 2.6, 0.3) };
    let shade = Emissive { radiance: Rgb::new(9.0, 7.5, 5.5), sides: Sides::Front };
    world.spawn((Name::new("wide lamp"), Rectangle { width: 1.0, depth: 1.6 }, overhead, shade));
    let bulb = Emissive { radiance: Rgb::new(150.0, 200.0, 300.0), ..Emissive::default() };
    world.spawn((Name::new("bulb"), Sphere { radius: 0.09 }, Placement::at(2.6, 2.3, 1.2), bulb));
}
// ANCHOR_END: scene
