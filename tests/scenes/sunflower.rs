//! Seventy-three spheres on a plane under two lamps, one ray a pixel: what the first chapters' stages are measured by.
//! Each small sphere stands a golden angle further round than the last, as seeds do in a sunflower.

use bevy_ecs::prelude::*;
use pinhole::scene::*;
use pinhole::{Chapter, stages};

/// The scene, and the stages of direct light on offer.
pub fn sunflower() -> Chapter {
    Chapter::new("sunflower", "spheres on a plane, in light and shadow", scene)
        .offer(stages::camera_rays())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::direct_light())
}

/// π (3 − √5): the angle that never lets two seeds stand behind one another.
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(28.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.0, 4.6, 13.0].into(), target: [0.0, 0.75, -0.4].into(), ..LookAt::default() },
        Resolution { width: 960, height: 540 },
    ));
    world.spawn((
        Name::new("pearl"),
        Sphere { radius: 1.5 },
        Placement::at(0.0, 1.5, 0.0),
        Matte { colour: Rgb::new(0.8, 0.78, 0.74) },
    ));
    for seed in 0..72 {
        let (turn, ring) = (f64::from(seed) * GOLDEN_ANGLE, 2.0 + 0.062 * f64::from(seed));
        let (radius, outward) = (0.2 + 0.0035 * f64::from(seed), f64::from(seed) / 71.0);
        world.spawn((
            Name::new(format!("seed {seed}")),
            Sphere { radius },
            Placement::at(ring * libm::cos(turn), radius, ring * libm::sin(turn)),
            Matte { colour: Rgb::new(0.8 - 0.7 * outward, 0.2 + 0.2 * outward, 0.1 + 0.3 * outward) },
        ));
    }
    world.spawn((Name::new("ground"), Plane::default(), Matte { colour: Rgb::new(0.52, 0.5, 0.47) }));
    for (name, at, intensity) in [
        ("lamp", Placement::at(-6.5, 8.5, 5.5), Rgb::new(400.0, 345.0, 280.0)),
        ("sky light", Placement::at(9.0, 7.0, -3.0), Rgb::new(60.0, 90.0, 145.0)),
    ] {
        world.spawn((Name::new(name), PointLight { intensity, ..PointLight::default() }, at));
    }
    world.spawn((Name::new("dusk"), Background { colour: Rgb::new(0.016, 0.021, 0.034) }));
}
