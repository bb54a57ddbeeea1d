//! Boxes around meshes: a ray that misses the box misses everything in it.
//! A moon shell in one box, and a tower in a box for each whorl; both stand on blocks that fill their boxes.
//! Nothing new runs here: every mesh has had its boxes since chapter 28, and this chapter makes them visible.

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
    Chapter::new("29_boxes", "the box", scene)
        .offer(stages::camera_rays())
        .offer(stages::samples())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::transforms())
        .offer(stages::environment())
        .offer(stages::direct_light())
        .offer(stages::lights())
        .offer(stages::bounces())
        .offer(stages::path_continuation())
}
// ANCHOR_END: chapter

/// Rings of the tower, vertices of each, and its whorls.
const RINGS: u32 = 200;
const AROUND: u32 = 16;
const WHORLS: u32 = 7;

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(25.0), axis: FovAxis::Vertical },
        LookAt { eye: [-1.0, 2.1, 5.4].into(), target: [0.0, 0.84, 0.0].into(), ..LookAt::default() },
        Sampling { samples: 32, seed: 29, ..Sampling::default() },
    ));
    let brass = world.spawn((Name::new("brass"), Matte { colour: Rgb::new(0.55, 0.36, 0.12) })).id();

    let (moon, place) = (coiled(&MOON, 100, 24), stand(-0.72, 1.1, 0.6));
    frame(world, brass, &placed(&moon, &place));
    world.spawn((
        Name::new("moon"),
        MeshInstance { geometry: moon },
        place,
        Matte { colour: Rgb::new(0.82, 0.74, 0.64) },
    ));

    let (tower, place) = (coiled(&TOWER, RINGS, AROUND), stand(0.8, 1.14, 0.6));
    let vertices = placed(&tower, &place);
    // The mouth and the wall inside go with the last whorl.
    let ring = |whorl: u32| if whorl < WHORLS { whorl * RINGS * 2 / (2 * WHORLS + 1) } else { RINGS };
    for whorl in 0..WHORLS {
        let [first, last] = [ring(whorl), ring(whorl + 1) + 1].map(|ring| (ring * (AROUND + 1)) as usize);
        frame(world, brass, &vertices[first..last]);
    }
    world.spawn((
        Name::new("tower"),
        MeshInstance { geometry: tower },
        place,
        Matte { colour: Rgb::new(0.8, 0.5, 0.33) },
    ));

    let block = MeshInstance::new(cube());
    for (number, x, y, z) in blocks() {
        let place = Placement { scale: [0.5, 0.25, 0.5].into(), ..Placement::at(x, y, z) };
        let tone = 0.42 + 0.06 * f64::from(number * 5 % 7);
        let slate = Matte { colour: Rgb::new(0.8 * tone, 0.9 * tone, tone) };
        world.spawn((Name::new(format!("block {number}")), block.clone(), place, slate));
    }
    world.spawn((Name::new("ground"), Plane::default(), Matte { colour: Rgb::new(0.5, 0.46, 0.4) }));
    let sun = DirectionalLight { irradiance: Rgb::new(2.6, 2.2, 1.7), ..DirectionalLight::default() };
    world.spawn((Name::new("sun"), sun, LookAt { eye: [-3.0, 4.0, 3.0].into(), ..LookAt::default() }));
    world.spawn((Name::new("sky"), Gradient { bottom: Rgb::new(0.9, 0.8, 0.7), top: Rgb::new(0.3, 0.45, 0.75) }));
}
// ANCHOR_END: scene

/// A shell upright with its middle at this place, its mouth towards the camera.
fn stand(x: f64, y: f64, size: f64) -> Placement {
    Placement {
        orientation: axis_angle(DVec3::Y, Degrees(-60.0)),
        scale: DVec3::splat(size),
        ..Placement::at(x, y, 0.0)
    }
}

/// The vertices of a mesh in world space.
fn placed(mesh: &MeshGeometry, place: &Placement) -> Vec<DVec3> {
    let placed = |at: &[f32; 3]| place.position + place.orientation * (place.scale * DVec3::from(at.map(f64::from)));
    mesh.positions.iter().map(placed).collect()
}

/// The twelve edges of the box around points, as rods.
fn frame(world: &mut World, material: Entity, points: &[DVec3]) {
    const THICK: f64 = 0.012;
    let low = points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let high = points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    for (axis, corner) in (0..3).flat_map(|axis| (0..4).map(move |corner| (axis, corner))) {
        let (mut position, mut size) = (0.5 * (low + high), DVec3::splat(THICK));
        size[axis] += high[axis] - low[axis];
        for (bit, across) in [(axis + 1) % 3, (axis + 2) % 3].into_iter().enumerate() {
            position[across] = if corner >> bit & 1 == 0 { low[across] } else { high[across] };
        }
        let place = Placement { position, ..Placement::default() };
        world.spawn((Cuboid { size }, place, UsesMaterial(material)));
    }
}

/// The numbers and the middles of the blocks: six beside one another, two deep, in two layers.
fn blocks() -> impl Iterator<Item = (u32, f64, f64, f64)> {
    (0..24).map(|number| {
        let [column, row, layer] = [number % 6, number / 6 % 2, number / 12].map(f64::from);
        (number, 0.5 * column - 1.25, 0.25 * layer + 0.125, 0.5 * row - 0.25)
    })
}

/// A cube with edges of length 1 about the origin, of twelve triangles.
fn cube() -> TriangleMesh {
    let corner = |at: u32| [at & 1, at >> 1 & 1, at >> 2].map(|side| side as f32 - 0.5);
    let sides = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    TriangleMesh {
        positions: (0..8).map(corner).collect(),
        triangles: sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect(),
        ..TriangleMesh::default()
    }
}
