//! How does a prism make a rainbow of white light? By bending each wavelength by another angle.
//! A lamp shines through a slit; what comes through draws a white line on the table, and then a fan of colours.
//! New here: dispersion, a glass whose index depends on the wavelength, and paths of one wavelength each.

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
    Chapter::new("38_dispersion", "colours that part", scene)
        .offer(stages::camera_rays())
        .offer(stages::samples())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::direct_light())
        .offer(stages::lights())
        .offer(stages::bounces())
        .offer(stages::path_continuation())
        .offer(stages::glass())
        .offer(stages::light_tracing())
        .offer(stages::dispersion())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(34.0), axis: FovAxis::Vertical },
        LookAt { eye: [-1.35, 3.3, 2.85].into(), target: [0.15, 0.0, 0.25].into(), ..LookAt::default() },
        Sampling { samples: 64, seed: 38, ..Sampling::default() },
        LightTracing { paths: 2.0 },
    ));
    world.spawn((Name::new("table"), Plane::default(), Matte { colour: Rgb::grey(0.75) }));

    // A wall with a slit lets a blade of light through.
    let wall = Matte { colour: Rgb::grey(0.05) };
    for (name, side) in [("wall on the left", -1.0), ("wall on the right", 1.0)] {
        let place = Placement::at(-2.2, 1.4, 1.515 * side);
        world.spawn((Name::new(name), Cuboid { size: DVec3::new(0.05, 3.0, 3.0) }, place, wall));
    }
    let lamp = SpotLight {
        intensity: Rgb::grey(150.0),
        inner_angle: Degrees(40.0),
        outer_angle: Degrees(50.0),
        ..SpotLight::default()
    };
    let look = LookAt { eye: [-3.2, 0.9, 0.0].into(), target: [0.0, 0.25, 0.0].into(), ..LookAt::default() };
    world.spawn((Name::new("lamp"), lamp, look));

    // A prism that stands on end, turned so that the blade crosses it symmetrically.
    let glass = world.spawn((Name::new("glass"), Glass::default(), Dispersion::Sf11)).id();
    let corner = |side: u32, height: f64| {
        let (sin, cos) = libm::sincos(Degrees(63.5 - 120.0 * f64::from(side)).radians());
        DVec3::new(0.32 * cos - 0.057, height, 0.32 * sin + 0.086)
    };
    let [low, high] = [0.01, 0.5];
    let mut faces = vec![[0, 1, 2].map(|side| corner(side, high)), [2, 1, 0].map(|side| corner(side, low))];
    for side in 0..3 {
        let [a, b] = [side, side + 1].map(|side| [low, high].map(|height| corner(side, height)));
        faces.extend([[a[0], b[0], b[1]], [a[0], b[1], a[1]]]);
    }
    for vertices in faces {
        world.spawn((Triangle { vertices, ..Triangle::default() }, UsesMaterial(glass)));
    }
    world.spawn((Name::new("dusk"), Background { colour: Rgb::new(0.04, 0.04, 0.05) }));
}
// ANCHOR_END: scene
