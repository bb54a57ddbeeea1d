//! Triangles into pixels: which samples each triangle covers, and which of several triangles is nearest there.
//! A folding screen, a floor with a rug a hair above it, and a shell; beside them a ball, which has no triangles.
//! Nothing new runs here: every rasterised picture has done this since chapter 32, and this chapter opens it.

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
    Chapter::new("33_rasterisation", "triangles into pixels", scene)
        .offer(stages::camera_rays())
        .offer(stages::rasterisation())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::transforms())
        .offer(stages::textures())
        .offer(stages::environment())
        .offer(stages::direct_light())
        .offer(stages::lights())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    // Seen from here, a unit of the screen is 96 of 480 × 270 pixels, and its straight seams fall on pixel centres.
    let eye = DVec3::new(-0.5 / 96.0, 81.5 / 96.0, 5.415886);
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(24.0), axis: FovAxis::Vertical },
        LookAt { eye, target: eye + DVec3::NEG_Z, ..LookAt::default() },
        Rasterisation,
        Integrator::RayCasting,
    ));
    let tiles = Checker {
        first: Rgb::new(0.62, 0.58, 0.5),
        second: Rgb::new(0.26, 0.22, 0.2),
        by: TextureBy::Uv,
        ..Checker::default()
    };
    let floor = level([-4.0, 4.0], [-3.0, 3.0], 0.0, 2.0);
    world.spawn((Name::new("floor"), MeshInstance::new(floor), Matte::default(), tiles));
    let rug = level([-1.5, 1.3], [-0.4, 1.1], 0.004, 2.0);
    world.spawn((Name::new("rug"), MeshInstance::new(rug), Matte { colour: Rgb::new(0.5, 0.08, 0.07) }));

    let slate = Matte { colour: Rgb::new(0.36, 0.5, 0.56) };
    world.spawn((Name::new("screen"), MeshInstance::new(folded()), Placement::at(0.0, 0.0, -1.2), slate));
    let orientation = axis_angle(DVec3::Y, Degrees(-60.0));
    let place = Placement { orientation, scale: DVec3::splat(0.6), ..Placement::at(-0.7, 0.61, 0.4) };
    let shell = MeshInstance { geometry: coiled(&MOON, 90, 20) };
    world.spawn((Name::new("shell"), shell, place, Matte { colour: Rgb::new(0.84, 0.7, 0.52) }));
    let ball = (Sphere { radius: 0.4 }, Placement::at(0.6, 0.4, 0.5));
    world.spawn((Name::new("ball"), ball, Matte { colour: Rgb::new(0.85, 0.6, 0.15) }));

    let sun = DirectionalLight { irradiance: Rgb::new(2.2, 2.0, 1.7), ..DirectionalLight::default() };
    world.spawn((Name::new("sun"), sun, LookAt { eye: [-2.0, 3.4, 3.0].into(), ..LookAt::default() }));
    let haze = DirectionalLight { irradiance: Rgb::new(0.55, 0.6, 0.7), ..DirectionalLight::default() };
    world.spawn((Name::new("haze"), haze, LookAt { eye: [3.0, 3.0, 4.0].into(), ..LookAt::default() }));
    world.spawn((Name::new("sky"), Gradient { bottom: Rgb::new(0.7, 0.72, 0.74), top: Rgb::new(0.4, 0.5, 0.62) }));
}

/// A level rectangle of two triangles, so many squares of its texture for each unit.
fn level([left, right]: [f32; 2], [back, front]: [f32; 2], y: f32, squares: f32) -> TriangleMesh {
    let corners = [[left, front], [right, front], [right, back], [left, back]];
    TriangleMesh {
        positions: corners.iter().map(|&[x, z]| [x, y, z]).collect(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        uvs: Some(corners.iter().map(|corner| corner.map(|part| part * squares)).collect()),
        ..TriangleMesh::default()
    }
}

/// A screen 3 wide and 1½ high, of squares with edges of ¼ that are cut in two; every second column of vertices is
/// nearer.
fn folded() -> TriangleMesh {
    const ACROSS: u32 = 12;
    const UP: u32 = 6;
    let vertex = |column: u32, line: u32| line * (ACROSS + 1) + column;
    let at = |column: u32, line: u32| [0.25 * column as f32 - 1.5, 0.25 * line as f32, 0.12 * (column % 2) as f32];
    let cells = (0..UP).flat_map(|line| (0..ACROSS).map(move |column| (column, line)));
    TriangleMesh {
        positions: (0..=UP).flat_map(|line| (0..=ACROSS).map(move |column| at(column, line))).collect(),
        triangles: cells
            .flat_map(|(column, line)| {
                let [a, b] = [vertex(column, line), vertex(column + 1, line)];
                let [c, d] = [vertex(column + 1, line + 1), vertex(column, line + 1)];
                [[a, b, c], [a, c, d]]
            })
            .collect(),
        ..TriangleMesh::default()
    }
}
// ANCHOR_END: scene
