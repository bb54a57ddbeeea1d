//! Where does the bright spot behind a ball of glass come from? From a light so small that hardly a ray hits it.
//! The ball focuses its light on the floor, and half a ring of mirror focuses it into a curve.
//! New here: light tracing, paths that start on the light and are connected to the camera.

use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::scene::*;
use pinhole::{Chapter, stages};
use std::f64::consts::PI;
use std::process::ExitCode;

fn main() -> ExitCode {
    pinhole::run(chapter())
}

// ANCHOR: chapter
/// The scene, and the stages on offer.
pub fn chapter() -> Chapter {
    Chapter::new("27_caustics", "caustics", scene)
        .offer(stages::camera_rays())
        .offer(stages::samples())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::transforms())
        .offer(stages::direct_light())
        .offer(stages::area_lights())
        .offer(stages::bounces())
        .offer(stages::path_continuation())
        .offer(stages::specular_reflection())
        .offer(stages::glass())
        .offer(stages::mis())
        .offer(stages::light_tracing())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(34.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.2, 2.7, 4.0].into(), target: [0.1, 0.15, 0.0].into(), ..LookAt::default() },
        Sampling { samples: 64, seed: 27, ..Sampling::default() },
        LightTracing::default(),
    ));
    let floor = Matte { colour: Rgb::new(0.75, 0.72, 0.66) };
    world.spawn((Name::new("floor"), Plane::default(), Placement::at(0.0, 0.0, 0.0), floor));
    let ball = Placement::at(-0.85, 0.6, 0.1);
    world.spawn((Name::new("ball"), Sphere { radius: 0.6 }, ball, Glass::default()));

    // Half a ring, open towards the light: planar parts, smooth by their corners' normals.
    let gold = world.spawn((Name::new("gold"), Mirror { colour: Rgb::new(0.95, 0.75, 0.35) })).id();
    let edge = |part: u32, height: f64| {
        let angle = PI * (f64::from(part) / 24.0 - 0.82);
        let out = DVec3::new(libm::cos(angle), 0.0, libm::sin(angle));
        (DVec3::new(1.0, height, 0.1) + 0.75 * out, -out)
    };
    for part in 0..24 {
        let corners = [edge(part, 0.0), edge(part + 1, 0.0), edge(part + 1, 0.35), edge(part, 0.35)];
        for pick in [[0, 1, 2], [0, 2, 3]] {
            let (vertices, normals) = (pick.map(|at| corners[at].0), Some(pick.map(|at| corners[at].1)));
            world.spawn((Triangle { vertices, normals, uvs: None }, UsesMaterial(gold)));
        }
    }
    let emissive = Emissive { radiance: Rgb::new(1900.0, 1750.0, 1500.0), sides: Sides::Front };
    world.spawn((Name::new("lamp"), Sphere { radius: 0.05 }, Placement::at(-2.2, 2.0, 1.7), emissive));
    world.spawn((Name::new("dusk"), Background { colour: Rgb::new(0.05, 0.06, 0.09) }));
}
// ANCHOR_END: scene
