//! Things placed within things that are placed: turned, stretched and mirrored, together with their normals.
//! Gems of eight triangles; one is shaded as it is cut, the others as if they were round.
//! New here: triangles, and normals that are not the surface's own.

use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::scene::*;
use pinhole::{Chapter, stages};
use std::process::ExitCode;

fn main() -> ExitCode {
    pinhole::run(chapter())
}

// ANCHOR: chapter
/// The scene, and the stages on offer.
pub fn chapter() -> Chapter {
    Chapter::new("14_transforms", "transforms and normals", scene)
        .offer(stages::camera_rays())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::direct_light())
        .offer(stages::transforms())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(36.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.0, 2.8, 7.0].into(), target: [0.0, 0.9, 0.0].into(), ..LookAt::default() },
    ));
    let turned = DQuat::from_xyzw(0.0, 0.28, 0.0, 0.96);
    let leaning = DQuat::from_xyzw(0.1, 0.3, -0.3, 0.9).normalize();
    let stand = |x, scale: [f64; 3], orientation| Placement {
        position: [x, scale[1], 0.0].into(),
        orientation,
        scale: scale.into(),
    };
    gem(world, "cut gem", stand(-2.4, [0.8, 1.2, 0.8], turned), false, None);
    gem(world, "round gem", stand(-0.6, [0.8, 1.2, 0.8], turned), true, None);
    let mirror = Placement { scale: [-1.0, 0.75, 1.0].into(), ..Placement::at(1.7, 0.0, 0.2) };
    let mirror = world.spawn((Name::new("mirrored group"), mirror)).id();
    gem(world, "mirrored gem", stand(0.6, [0.6, 1.2, 0.6], leaning), true, Some(mirror));
    let egg =
        (Sphere { radius: 1.0 }, stand(-0.7, [0.4, 1.1, 0.6], leaning), Matte { colour: Rgb::new(0.8, 0.65, 0.5) });
    world.spawn((Name::new("mirrored egg"), egg, ChildOf(mirror)));
    world.spawn((Name::new("ground"), Plane::default(), Matte { colour: Rgb::grey(0.6) }));
    let light = PointLight { intensity: Rgb::grey(110.0), ..PointLight::default() };
    world.spawn((Name::new("lamp"), light, Placement::at(2.5, 5.0, 4.0)));
    world.spawn((Name::new("night"), Background { colour: Rgb::new(0.008, 0.012, 0.02) }));
}

/// Eight triangles about the group's own origin, a corner on each half of each axis.
fn gem(world: &mut World, name: &str, placement: Placement, round: bool, parent: Option<Entity>) {
    let matte = Matte { colour: if round { Rgb::new(0.35, 0.55, 0.8) } else { Rgb::new(0.85, 0.35, 0.2) } };
    let group = world.spawn((Name::new(name.to_owned()), placement, matte)).id();
    if let Some(parent) = parent {
        world.entity_mut(group).insert(ChildOf(parent));
    }
    for face in 0..8 {
        let half = |axis: u32| if face >> axis & 1 == 0 { 1.0 } else { -1.0 };
        let vertices = [DVec3::X * half(0), DVec3::Y * half(1), DVec3::Z * half(2)];
        let normals = round.then_some(vertices);
        let triangle = (Triangle { vertices, normals, uvs: None }, UsesMaterial(group), ChildOf(group));
        world.spawn((Name::new(format!("{name}, face {face}")), triangle));
    }
}
// ANCHOR_END: scene
