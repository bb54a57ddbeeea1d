//! One camera, many descriptions: the same picture in the words of other programs and books.
//! The letter of balls shows at once whether a picture is mirrored, upside down, or turned.
//! New here: nothing that runs; what changes is how the camera is written down.

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
    Chapter::new("11_conventions", "the same camera in other books", scene)
        .offer(stages::camera_rays())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::direct_light())
}
// ANCHOR_END: chapter

// ANCHOR: scene
/// Columns and lines of the letter's balls.
const LETTER: [[f64; 2]; 8] =
    [[0.0, 0.0], [0.0, 1.0], [0.0, 2.0], [0.0, 3.0], [0.0, 4.0], [1.0, 4.0], [2.0, 4.0], [1.0, 2.0]];

fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(40.0), axis: FovAxis::Vertical },
        LookAt { eye: [2.5, 2.5, 6.0].into(), target: [0.0, 1.25, 0.0].into(), ..LookAt::default() },
    ));
    let red = Matte { colour: Rgb::new(0.85, 0.3, 0.15) };
    for [column, line] in LETTER {
        let at = Placement::at(-0.5 + 0.52 * column, 0.3 + 0.52 * line, 0.0);
        world.spawn((Name::new("letter"), Sphere { radius: 0.3 }, at, red));
    }
    let blue = Matte { colour: Rgb::new(0.2, 0.45, 0.75) };
    world.spawn((Name::new("behind the camera"), Sphere { radius: 1.5 }, Placement::at(5.0, 1.5, 12.0), blue));
    world.spawn((Name::new("ground"), Plane::default(), Matte { colour: Rgb::grey(0.6) }));
    let light = PointLight { intensity: Rgb::grey(110.0), ..PointLight::default() };
    world.spawn((Name::new("lamp"), light, Placement::at(4.5, 5.0, 5.0)));
    world.spawn((Name::new("dusk"), Background { colour: Rgb::new(0.05, 0.07, 0.11) }));
}
// ANCHOR_END: scene
