//! Together in real time: what the camera sees is projected, and a few rays a pixel do the rest.
//! A shell on steps in a corner of two walls, a railing of thin bars, a mirror ball and a matte one, a lamp and the sky.
//! New here: no stage. Paths of three segments and few samples, from hits that were projected.

#[path = "../28_meshes/seashell.rs"]
mod seashell;

use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::models::TriangleMesh;
use pinhole::scene::*;
use pinhole::{Chapter, stages};
use seashell::{MOON, coiled};
use std::process::ExitCode;

fn main() -> ExitCode {
    pinhole::run(chapter())
}

// ANCHOR: chapter
/// The scene, and the stages on offer.
pub fn chapter() -> Chapter {
    Chapter::new("35_real_time", "together in real time", scene)
        .offer(stages::camera_rays())
        .offer(stages::samples())
        .offer(stages::rasterisation())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::transforms())
        .offer(stages::textures())
        .offer(stages::environment())
        .offer(stages::direct_light())
        .offer(stages::area_lights())
        .offer(stages::mis())
        .offer(stages::bounces())
        .offer(stages::path_continuation())
        .offer(stages::specular_reflection())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(32.0), axis: FovAxis::Vertical },
        LookAt { eye: [1.9, 1.75, 4.3].into(), target: [-0.2, 0.72, -0.3].into(), ..LookAt::default() },
        Rasterisation,
        Integrator::Path { max_depth: 3, lights: LightStrategy::Mis, roulette: 0 },
        Sampling { samples: 4, seed: 35, sampler: Sampler::Independent, filter: Filter::Box { radius: 0.5 } },
    ));
    let plaster = Matte { colour: Rgb::new(0.75, 0.7, 0.6) };
    let corner = [
        // Two walls, and two steps between them.
        [[-2.4, 0.0, -1.7], [2.2, 2.3, -1.5]],
        [[-2.6, 0.0, -1.7], [-2.4, 2.3, 0.9]],
        [[-2.4, 0.0, -1.5], [0.3, 0.3, 0.2]],
        [[-2.4, 0.3, -1.5], [-0.5, 0.6, -0.6]],
    ];
    world.spawn((Name::new("corner"), MeshInstance::new(boxes(&corner)), plaster));
    let bars: Vec<_> = (0..12).map(|bar| [0.6 + 0.13 * bar as f32, -0.9]).collect();
    let bars: Vec<_> = bars.iter().map(|[x, z]| [[x - 0.012, 0.0, z - 0.012], [x + 0.012, 1.2, z + 0.012]]).collect();
    world.spawn((Name::new("railing"), MeshInstance::new(boxes(&bars)), Matte { colour: Rgb::new(0.1, 0.16, 0.2) }));
    let tiles = Checker { first: Rgb::new(0.66, 0.58, 0.46), second: Rgb::new(0.3, 0.17, 0.11), ..Checker::default() };
    let ground = boxes(&[[[-9.0, -0.5, -9.0], [9.0, 0.0, 9.0]]]);
    world.spawn((Name::new("ground"), MeshInstance::new(ground), Matte::default(), Checker { size: 0.5, ..tiles }));

    let orientation = axis_angle(DVec3::Y, Degrees(-70.0));
    let place = Placement { orientation, scale: DVec3::splat(0.62), ..Placement::at(-1.2, 1.22, -1.0) };
    let shell = MeshInstance { geometry: coiled(&MOON, 120, 24) };
    world.spawn((Name::new("shell"), shell, place, Matte { colour: Rgb::new(0.85, 0.68, 0.5) }));
    let mirror = Mirror { colour: Rgb::grey(0.85) };
    world.spawn((Name::new("mirror ball"), Sphere { radius: 0.42 }, Placement::at(0.75, 0.42, -0.1), mirror));
    let orange = Matte { colour: Rgb::new(0.8, 0.3, 0.06) };
    world.spawn((Name::new("orange ball"), Sphere { radius: 0.22 }, Placement::at(-0.25, 0.52, -0.2), orange));

    let emissive = Emissive { radiance: Rgb::new(14.0, 11.5, 8.0), ..Emissive::default() };
    world.spawn((Name::new("lamp"), Sphere { radius: 1.0 }, Placement::at(3.8, 3.5, 1.6), emissive));
    world.spawn((Name::new("sky"), Gradient { bottom: Rgb::new(0.2, 0.18, 0.16), top: Rgb::new(0.22, 0.36, 0.62) }));
}

/// Boxes along the axes, each from its least corner to its greatest, as one mesh.
fn boxes(corners: &[[[f32; 3]; 2]]) -> TriangleMesh {
    const FACES: [[u32; 4]; 6] = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let vertex =
        |[low, high]: [[f32; 3]; 2], number: usize| [0, 1, 2].map(|axis| [low, high][number >> axis & 1][axis]);
    let triangles = |first: u32| {
        FACES
            .into_iter()
            .flat_map(move |[a, b, c, d]| [[a, b, c], [a, c, d]].map(|triangle| triangle.map(|corner| first + corner)))
    };
    TriangleMesh {
        positions: corners.iter().flat_map(|&pair| (0..8).map(move |number| vertex(pair, number))).collect(),
        triangles: (0..corners.len() as u32).flat_map(|number| triangles(8 * number)).collect(),
        ..TriangleMesh::default()
    }
}
// ANCHOR_END: scene
