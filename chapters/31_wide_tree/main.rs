//! One form twice: as a mesh of triangles, and strung of pearls, which are spheres.
//! Both go through trees whose nodes have eight children, so that one ray is tested against eight boxes at once.
//! New here: wide nodes, the instructions that a machine has, and packets of rays.

#[path = "../28_meshes/seashell.rs"]
mod seashell;

use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::scene::*;
use pinhole::{Chapter, stages};
use seashell::seashell;
use std::process::ExitCode;

fn main() -> ExitCode {
    pinhole::run(chapter())
}

// ANCHOR: chapter
/// The scene, and the stages on offer.
pub fn chapter() -> Chapter {
    Chapter::new("31_wide_tree", "the wide tree", scene)
        .offer(stages::camera_rays())
        .offer(stages::samples())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::transforms())
        .offer(stages::direct_light())
        .offer(stages::lights())
        .offer(stages::environment())
        .offer(stages::bounces())
        .offer(stages::path_continuation())
        .offer(stages::glossy_reflection())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(30.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.0, 1.7, 6.4].into(), target: [0.0, 0.85, 0.0].into(), ..LookAt::default() },
        Sampling { samples: 16, seed: 31, ..Sampling::default() },
        Integrator::Path { max_depth: 3, lights: LightStrategy::Light, roulette: 0 },
    ));
    world.spawn((Name::new("ground"), Plane::default(), Matte { colour: Rgb::new(0.16, 0.2, 0.26) }));
    let sun = DirectionalLight { irradiance: Rgb::new(2.9, 2.5, 2.0), ..DirectionalLight::default() };
    world.spawn((Name::new("sun"), sun, LookAt { eye: [-2.4, 3.2, 2.8].into(), ..LookAt::default() }));
    world.spawn((Name::new("sky"), Gradient { bottom: Rgb::new(0.5, 0.45, 0.45), top: Rgb::new(0.3, 0.42, 0.65) }));

    let orientation = axis_angle(DVec3::Y, Degrees(-35.0));
    let place = Placement { orientation, ..Placement::at(-1.05, 1.0, 0.0) };
    let matte = Matte { colour: Rgb::new(0.85, 0.6, 0.45) };
    world.spawn((Name::new("shell of triangles"), MeshInstance { geometry: seashell(220, 36) }, place, matte));

    // The same form of fewer vertices: each becomes a pearl as wide as it is far to the next one round the tube.
    let (around, strung) = (18, seashell(130, 18));
    let metal = Metal { colour: Rgb::new(0.9, 0.82, 0.78), roughness: 0.35, ..Metal::default() };
    let nacre = world.spawn((Name::new("nacre"), metal)).id();
    for (ring, vertices) in strung.positions.chunks_exact(around + 1).enumerate() {
        for (number, pair) in vertices.windows(2).enumerate() {
            let [at, next] = [pair[0], pair[1]].map(|position| DVec3::from(position.map(f64::from)));
            let (sphere, name) = (Sphere { radius: 0.5 * at.distance(next) }, format!("pearl {ring}.{number}"));
            let position = orientation * at + DVec3::new(1.05, 1.0, 0.0);
            world.spawn((Name::new(name), sphere, Placement { position, ..Placement::default() }, UsesMaterial(nacre)));
        }
    }
}
// ANCHOR_END: scene
