//! Depth of field: an opening in place of the pinhole, so that what lies at one distance is sharp and all else is blurred.
//! A row of balls runs into the distance, and far behind them small lights show the opening's shape.
//! New here: the `Lens` on the camera, and the stages "Sample the lens" and "Generate camera rays: thin lens".

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
    Chapter::new("23_depth_of_field", "depth of field", scene)
        .offer(stages::camera_rays())
        .offer(stages::samples())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::textures())
        .offer(stages::direct_light())
        .offer(stages::lights())
        .offer(stages::lens())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    let lens =
        Lens { aperture: Aperture::Radius { radius: 0.12 }, focus_distance: 6.0, blades: 6, turn: Degrees(15.0) };
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(32.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.0, 1.3, 6.0].into(), target: [0.0, 0.9, 0.0].into(), ..LookAt::default() },
        lens,
        Integrator::RayCasting,
        Sampling { samples: 64, seed: 23, ..Sampling::default() },
    ));
    for (name, x, z, colour) in [
        ("nearest ball", -1.1, 2.6, Rgb::new(0.85, 0.3, 0.2)),
        ("near ball", -0.7, 1.3, Rgb::new(0.9, 0.6, 0.2)),
        ("ball in focus", 0.0, 0.0, Rgb::new(0.8, 0.75, 0.3)),
        ("far ball", 1.2, -2.5, Rgb::new(0.3, 0.65, 0.4)),
        ("farthest ball", 3.2, -6.5, Rgb::new(0.25, 0.45, 0.8)),
    ] {
        world.spawn((Name::new(name), Sphere { radius: 0.5 }, Placement::at(x, 0.5, z), Matte { colour }));
    }
    for lamp in 0..9 {
        let (x, y) = (1.9 * f64::from(lamp) - 8.6, 2.2 + 0.9 * f64::from(lamp % 3));
        let (green, blue) = (2.4 - 0.2 * f64::from(lamp), 1.0 + 0.2 * f64::from(lamp));
        let glow = Emissive { radiance: Rgb::new(3.0, green, blue), ..Emissive::default() };
        world.spawn((Name::new(format!("lamp {lamp}")), Sphere { radius: 0.12 }, Placement::at(x, y, -14.0), glow));
    }
    world.spawn((Name::new("ground"), Plane::default(), Checker { size: 0.5, ..Checker::default() }, Matte::default()));
    let sun = DirectionalLight { irradiance: Rgb::new(2.2, 2.0, 1.8), ..DirectionalLight::default() };
    world.spawn((Name::new("sun"), sun, LookAt { eye: [-2.0, 3.0, 3.0].into(), ..LookAt::default() }));
    world.spawn((Name::new("dusk"), Background { colour: Rgb::new(0.03, 0.04, 0.07) }));
}
// ANCHOR_END: scene
