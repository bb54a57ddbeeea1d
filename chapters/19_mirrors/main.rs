//! Where does light go on that hits a mirror, and where from metal that is not quite smooth?
//! Three balls of the same metal, smooth, brushed and rough, show each other, the floor and the sky.
//! New here: paths go on from what they hit, bounce after bounce; some of them in random directions.

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
    Chapter::new("19_mirrors", "mirrors and rough metal", scene)
        .offer(stages::camera_rays())
        .offer(stages::samples())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::textures())
        .offer(stages::environment())
        .offer(stages::direct_light())
        .offer(stages::bounces())
        .offer(stages::path_continuation())
        .offer(stages::specular_reflection())
        .offer(stages::glossy_reflection())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(32.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.0, 1.7, 6.6].into(), target: [0.0, 0.8, 0.0].into(), ..LookAt::default() },
        Sampling { samples: 64, ..Sampling::default() },
    ));
    let colour = Rgb::new(0.95, 0.75, 0.45);
    let ball = |x| (Sphere { radius: 0.9 }, Placement::at(x, 0.9, 0.0));
    world.spawn((Name::new("smooth ball"), ball(-2.0), Mirror { colour }));
    world.spawn((Name::new("brushed ball"), ball(0.0), Metal { colour, roughness: 0.1, ..Metal::default() }));
    world.spawn((Name::new("rough ball"), ball(2.0), Metal { colour, roughness: 0.4, ..Metal::default() }));
    let tiles = Checker { first: Rgb::new(0.5, 0.48, 0.44), second: Rgb::new(0.12, 0.16, 0.2), ..Checker::default() };
    world.spawn((Name::new("floor"), Plane::default(), Matte::default(), tiles));

    let lamp = PointLight { intensity: Rgb::grey(60.0), ..PointLight::default() };
    world.spawn((Name::new("lamp"), lamp, Placement::at(-3.0, 5.0, 4.0)));
    world.spawn((Name::new("sky"), Gradient::default()));
}
// ANCHOR_END: scene
