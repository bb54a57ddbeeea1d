//! From the world to the raster: a mesh is projected onto the image, instead of rays being sent out to look for it.
//! A shell on a pier that reaches behind the camera; beside it a mirror ball and the sea, which are not made of triangles.
//! New here: rasterisation finds what the camera sees, and rays do the rest.

#[path = "../28_meshes/seashell.rs"]
mod seashell;

use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::models::TriangleMesh;
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
    Chapter::new("32_projection", "from the world to the raster", scene)
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
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(36.0), axis: FovAxis::Vertical },
        LookAt { eye: [1.1, 1.5, 4.1].into(), target: [0.1, 0.78, 0.0].into(), ..LookAt::default() },
        Rasterisation,
        Sampling { samples: 16, seed: 32, ..Sampling::default() },
        Integrator::Whitted { max_depth: 3 },
    ));
    let place = Placement { orientation: axis_angle(DVec3::Y, Degrees(-40.0)), ..Placement::at(-0.75, 1.0, 0.0) };
    let ivory = Matte { colour: Rgb::new(0.84, 0.72, 0.56) };
    world.spawn((Name::new("shell"), MeshInstance { geometry: seashell(72, 12) }, place, ivory));
    let boards = Checker {
        first: Rgb::new(0.5, 0.4, 0.3),
        second: Rgb::new(0.33, 0.25, 0.19),
        by: TextureBy::Uv,
        ..Checker::default()
    };
    world.spawn((Name::new("pier"), MeshInstance::new(pier()), Matte::default(), boards));

    let ball = (Sphere { radius: 0.5 }, Placement::at(0.85, 0.5, -0.3));
    world.spawn((Name::new("ball"), ball, Mirror { colour: Rgb::grey(0.9) }));
    world.spawn((
        Name::new("sea"),
        Plane::default(),
        Placement::at(0.0, -0.4, 0.0),
        Matte { colour: Rgb::new(0.08, 0.2, 0.26) },
    ));
    let sun = DirectionalLight { irradiance: Rgb::new(2.7, 2.3, 1.8), ..DirectionalLight::default() };
    world.spawn((Name::new("sun"), sun, LookAt { eye: [-2.5, 3.0, 3.4].into(), ..LookAt::default() }));
    let haze = DirectionalLight { irradiance: Rgb::new(0.5, 0.6, 0.75), ..DirectionalLight::default() };
    world.spawn((Name::new("haze"), haze, LookAt { eye: [3.0, 4.0, 2.0].into(), ..LookAt::default() }));
    world.spawn((Name::new("sky"), Gradient { bottom: Rgb::new(0.75, 0.78, 0.8), top: Rgb::new(0.2, 0.38, 0.7) }));
}

/// Two triangles, 4 wide and 40 long, of which nearly 8 are behind the camera.
fn pier() -> TriangleMesh {
    TriangleMesh {
        positions: vec![[-2.0, 0.0, 12.0], [2.0, 0.0, 12.0], [2.0, 0.0, -28.0], [-2.0, 0.0, -28.0]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        uvs: Some(vec![[0.0, 80.0], [4.0, 80.0], [4.0, 0.0], [0.0, 0.0]]),
        ..TriangleMesh::default()
    }
}
// ANCHOR_END: scene
