//! Both classes of renderers on one scene: projection finds what the camera sees, rays answer every other question.
//! Two shells, one of them behind the camera, a mirror that shows it, a ball of glass and a matte ball.
//! Nothing new runs here: the chapter sets the two side by side, and asks what each costs and what it cannot do.

#[path = "../28_meshes/seashell.rs"]
mod seashell;

use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::models::TriangleMesh;
use pinhole::scene::*;
use pinhole::{Chapter, stages};
use seashell::{MOON, TOWER, coiled};
use std::process::ExitCode;

fn main() -> ExitCode {
    pinhole::run(chapter())
}

// ANCHOR: chapter
/// The scene, and the stages on offer.
pub fn chapter() -> Chapter {
    Chapter::new("34_both", "both on one scene", scene)
        .offer(stages::camera_rays())
        .offer(stages::samples())
        .offer(stages::rasterisation())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::transforms())
        .offer(stages::textures())
        .offer(stages::environment())
        .offer(stages::direct_light())
        .offer(stages::lights())
        .offer(stages::bounces())
        .offer(stages::specular_reflection())
        .offer(stages::glass())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(33.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.3, 1.6, 5.6].into(), target: [0.0, 0.78, 0.0].into(), ..LookAt::default() },
        Rasterisation,
        Sampling { samples: 16, seed: 34, ..Sampling::default() },
        Integrator::Whitted { max_depth: 8 },
    ));
    let tiles = Checker {
        first: Rgb::new(0.6, 0.57, 0.5),
        second: Rgb::new(0.2, 0.24, 0.28),
        by: TextureBy::Uv,
        ..Checker::default()
    };
    let level = turned(DVec3::X, -90.0, [0.0, 0.0, 2.0]);
    world.spawn((Name::new("floor"), MeshInstance::new(board(7.0, 9.0)), level, Matte::default(), tiles));
    let ivory = Matte { colour: Rgb::new(0.85, 0.74, 0.58) };
    let tower = MeshInstance { geometry: coiled(&TOWER, 240, 40) };
    world.spawn((Name::new("shell"), tower, turned(DVec3::Y, -40.0, [-1.3, 1.0, -0.3]), ivory));
    let moon = MeshInstance { geometry: coiled(&MOON, 120, 28) };
    let behind = turned(DVec3::Y, 200.0, [-0.7, 1.0, 7.2]);
    world.spawn((Name::new("shell behind the camera"), moon, behind, Matte { colour: Rgb::new(0.75, 0.2, 0.1) }));
    let silver = Mirror { colour: Rgb::grey(0.85) };
    let leaning = turned(DVec3::Y, -11.0, [1.15, 1.0, -1.0]);
    world.spawn((Name::new("mirror"), MeshInstance::new(board(0.95, 1.0)), leaning, silver));

    let glass = (Sphere { radius: 0.5 }, Placement::at(0.3, 0.5, 1.1), Glass::default());
    world.spawn((Name::new("glass ball"), glass));
    let amber = Matte { colour: Rgb::new(0.85, 0.55, 0.12) };
    world.spawn((Name::new("matte ball"), Sphere { radius: 0.36 }, Placement::at(-0.45, 0.36, 0.3), amber));

    let lamp = PointLight { intensity: Rgb::new(92.0, 84.0, 72.0), casts_shadows: true };
    world.spawn((Name::new("lamp"), lamp, Placement::at(-2.4, 4.4, 3.6)));
    let irradiance = Rgb::new(0.5, 0.56, 0.65);
    let haze = DirectionalLight { irradiance, casts_shadows: false };
    world.spawn((Name::new("haze"), haze, LookAt { eye: [3.0, 3.0, 4.0].into(), ..LookAt::default() }));
    world.spawn((Name::new("sky"), Gradient { bottom: Rgb::new(0.7, 0.72, 0.74), top: Rgb::new(0.25, 0.4, 0.66) }));
}

fn turned(axis: DVec3, degrees: f64, position: [f64; 3]) -> Placement {
    let orientation = axis_angle(axis, Degrees(degrees));
    Placement { orientation, position: position.into(), ..Placement::default() }
}

/// An upright rectangle of two triangles, given by the halves of its sides.
fn board(half_width: f32, half_height: f32) -> TriangleMesh {
    let [x, y] = [half_width, half_height];
    TriangleMesh {
        positions: vec![[-x, -y, 0.0], [x, -y, 0.0], [x, y, 0.0], [-x, y, 0.0]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        uvs: Some(vec![[0.0, 0.0], [2.0 * x, 0.0], [2.0 * x, 2.0 * y], [0.0, 2.0 * y]]),
        ..TriangleMesh::default()
    }
}
// ANCHOR_END: scene
