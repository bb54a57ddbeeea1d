//! Chapters that the figures' own tests draw.

use super::{Drawing, Figure};
use bevy_ecs::prelude::*;
use pinhole::scene::{
    Checker, Degrees, LookAt, Matte, Name, PerspectiveCamera, Placement, Plane, PointLight, Rgb, Sphere,
};
use pinhole::{Chapter, Result, stages};

/// A chapter with this scene.
pub fn chapter(scene: fn(&mut World)) -> Chapter {
    Chapter::new("trial", "a trial", scene).offer(stages::all())
}

/// A figure of such a chapter.
pub fn figure(draw: fn(&Chapter, &Figure) -> Result<Drawing>) -> Figure {
    Figure { name: "trial", chapter: "trial", about: "a trial", draw }
}

/// Spheres on the ground before a perspective camera.
pub fn central(world: &mut World) {
    let look = LookAt { eye: [0.0, 1.6, 5.0].into(), target: [0.0, 0.8, 0.0].into(), ..LookAt::default() };
    world.spawn((PerspectiveCamera { fov: Degrees(40.0), ..PerspectiveCamera::default() }, look));
    things(world);
    let light = PointLight { intensity: Rgb::grey(120.0), ..PointLight::default() };
    world.spawn((Name::new("lamp"), light, Placement::at(3.0, 5.0, 3.5)));
}

/// The same on a checkered floor.
pub fn checkered(world: &mut World) {
    central(world);
    world.spawn((Plane::default(), Placement::at(0.0, 0.1, 0.0), Matte::default(), Checker::default()));
}

fn things(world: &mut World) {
    let (red, gold) = (Rgb::new(0.85, 0.35, 0.2), Rgb::new(0.9, 0.75, 0.3));
    world.spawn((Sphere { radius: 0.8 }, Placement::at(-1.0, 0.8, 0.5), Matte { colour: red }));
    world.spawn((Sphere { radius: 0.7 }, Placement::at(0.5, 0.7, -1.5), Matte { colour: gold }));
    let egg = Placement { scale: [0.6, 1.0, 0.4].into(), ..Placement::at(0.9, 0.3, 1.4) };
    world.spawn((Sphere { radius: 0.3 }, egg, Matte { colour: gold }));
    world.spawn((Plane::default(), Matte { colour: Rgb::grey(0.6) }));
}
