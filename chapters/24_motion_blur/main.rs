//! Motion blur: each ray has a time of its own while the shutter is open, and hits what moves where it is then.
//! A ball flies by, a coin falls, and their shadows go with them; what stands still stays sharp.
//! New here: the `Shutter` on the camera, `Motion` on shapes, and the stages "Sample times" and "Intersect moving shapes".

use bevy_ecs::prelude::*;
use pinhole::scene::*;
use pinhole::{Chapter, stages};
use std::process::ExitCode;

fn main() -> ExitCode {
    pinhole::run(chapter())
}

// ANCHOR: chapter
/// The scene, and the stages on offer.
pub fn chapter() -> Chapter {
    Chapter::new("24_motion_blur", "motion blur", scene)
        .offer(stages::camera_rays())
        .offer(stages::samples())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::textures())
        .offer(stages::direct_light())
        .offer(stages::lights())
        .offer(stages::motion())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(36.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.0, 1.6, 6.5].into(), target: [0.0, 1.0, 0.0].into(), ..LookAt::default() },
        Shutter { open: 0.0, close: 0.5 },
        Sampling { samples: 64, seed: 24, ..Sampling::default() },
    ));
    let matte = |r, g, b| Matte { colour: Rgb::new(r, g, b) };
    let still = (Sphere { radius: 0.6 }, Placement::at(-1.9, 0.6, 0.0));
    world.spawn((Name::new("ball at rest"), still, matte(0.3, 0.55, 0.75)));
    let flying = (Sphere { radius: 0.45 }, Placement::at(-0.6, 1.3, 0.6), Motion { velocity: [2.4, 0.8, 0.0].into() });
    world.spawn((Name::new("flying ball"), flying, matte(0.85, 0.35, 0.2)));
    let upright = DQuat::from_rotation_x(std::f64::consts::FRAC_PI_2);
    let place = Placement { orientation: upright, ..Placement::at(2.1, 1.9, -0.6) };
    let falling = (Disk { radius: 0.5 }, place, Motion { velocity: [0.0, -1.6, 0.0].into() });
    world.spawn((Name::new("falling coin"), falling, matte(0.9, 0.7, 0.2)));
    world.spawn((Name::new("ground"), Plane::default(), Checker { size: 0.5, ..Checker::default() }, Matte::default()));
    let sun = DirectionalLight { irradiance: Rgb::new(2.6, 2.5, 2.3), ..DirectionalLight::default() };
    world.spawn((Name::new("sun"), sun, LookAt { eye: [-1.5, 4.0, 2.5].into(), ..LookAt::default() }));
    world.spawn((Name::new("sky"), Background { colour: Rgb::new(0.35, 0.5, 0.7) }));
}
// ANCHOR_END: scene
