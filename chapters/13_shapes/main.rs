//! A scene of many kinds: a ball, a floor, a table top, a board, boxes, a pyramid of triangles; which one does a ray hit?
//! Each kind in turn keeps the closest hit; where two are equally near, the lower shape number wins.
//! New here: the disk, the rectangle and the cuboid, and how the surface of each is computed.

use bevy_ecs::prelude::*;
use pinhole::scene::*;
use pinhole::{Chapter, intersect, stages};
use std::f64::consts::FRAC_1_SQRT_2;
use std::process::ExitCode;

fn main() -> ExitCode {
    pinhole::run(chapter())
}

// ANCHOR: chapter
/// The scene, and the stages on offer.
pub fn chapter() -> Chapter {
    Chapter::new("13_shapes", "shapes and the nearest of many", scene)
        .offer(stages::camera_rays())
        .offer(intersect::start_stage())
        .offer(intersect::sphere_stage())
        .offer(intersect::plane_stage())
        .offer(intersect::disk_stage())
        .offer(intersect::rectangle_stage())
        .offer(intersect::cuboid_stage())
        .offer(intersect::triangle_stage())
        .offer(intersect::classify_stage())
        .offer(intersect::sphere_surface_stage())
        .offer(intersect::plane_surface_stage())
        .offer(intersect::disk_surface_stage())
        .offer(intersect::rectangle_surface_stage())
        .offer(intersect::cuboid_surface_stage())
        .offer(intersect::triangle_surface_stage())
        .offer(stages::direct_light())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(38.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.4, 2.375, 6.2].into(), target: [0.0, 0.85, 0.0].into(), ..LookAt::default() },
    ));
    let matte = |r, g, b| Matte { colour: Rgb::new(r, g, b) };
    let wood = world.spawn((Name::new("wood"), matte(0.62, 0.42, 0.25))).id();
    world.spawn((Name::new("floor"), Plane::default(), matte(0.6, 0.6, 0.6)));
    // Quaternions: a quarter turn about x, and a twelfth about y.
    let upright = DQuat::from_xyzw(FRAC_1_SQRT_2, 0.0, 0.0, FRAC_1_SQRT_2);
    let aside = DQuat::from_xyzw(0.0, 0.258819045, 0.0, 0.965925826);
    let board = Placement { orientation: upright, ..Placement::at(-0.3, 1.1, -2.2) };
    world.spawn((Name::new("board"), Rectangle { width: 4.4, depth: 1.8 }, board, matte(0.25, 0.45, 0.5)));
    let crate_at = Placement { orientation: aside, ..Placement::at(-1.6, 0.6, 0.2) };
    world.spawn((Name::new("crate"), Cuboid { size: [1.4, 1.2, 1.0].into() }, crate_at, matte(0.75, 0.3, 0.2)));
    world.spawn((Name::new("ball"), Sphere { radius: 0.45 }, Placement::at(-1.6, 1.65, 0.2), matte(0.85, 0.7, 0.3)));
    // The foot ends in the very plane of the table top.
    world.spawn((Name::new("table top"), Disk { radius: 1.0 }, Placement::at(1.2, 0.875, 0.0), UsesMaterial(wood)));
    let foot = Cuboid { size: [0.14, 0.875, 0.14].into() };
    world.spawn((Name::new("foot"), foot, Placement::at(1.2, 0.4375, 0.0), UsesMaterial(wood)));
    let top = [1.45, 1.5, -0.4].into();
    let foot = [[1.1, 0.875, -0.15], [1.85, 0.875, -0.15], [1.5, 0.875, -0.8]];
    for side in 0..3 {
        let vertices = [top, foot[side].into(), foot[(side + 1) % 3].into()];
        world.spawn((Name::new("pyramid"), Triangle { vertices, ..Triangle::default() }, matte(0.5, 0.35, 0.65)));
    }
    let light = PointLight { intensity: Rgb::grey(80.0), ..PointLight::default() };
    world.spawn((Name::new("lamp"), light, Placement::at(2.6, 4.6, 3.4)));
    world.spawn((Name::new("evening"), Background { colour: Rgb::new(0.02, 0.03, 0.05) }));
}
// ANCHOR_END: scene
