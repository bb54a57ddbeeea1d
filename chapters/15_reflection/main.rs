//! What does a surface make of the light that falls on it? Three models side by side: matte, Phong, Blinn–Phong.
//! Three kinds of light shine on them, directional, spot and point, and one ball is emissive.
//! New here: highlights, surfaces that emit, and lights other than points.

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
    Chapter::new("15_reflection", "reflection models for direct light", scene)
        .offer(stages::camera_rays())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::direct_light())
        .offer(stages::lights())
        .offer(stages::highlights())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(34.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.0, 1.9, 6.4].into(), target: [0.0, 0.85, 0.0].into(), ..LookAt::default() },
        Integrator::RayCasting,
    ));
    let (colour, specular) = (Rgb::new(0.55, 0.16, 0.1), Rgb::grey(0.3));
    let ball = |x| (Sphere { radius: 0.9 }, Placement::at(x, 0.9, 0.0));
    world.spawn((Name::new("matte ball"), ball(-2.0), Matte { colour }));
    world.spawn((Name::new("phong ball"), ball(0.0), Phong { colour, specular, exponent: 20.0 }));
    world.spawn((Name::new("blinn-phong ball"), ball(2.0), BlinnPhong { colour, specular, exponent: 80.0 }));
    let glow = Emissive { radiance: Rgb::new(0.9, 0.7, 0.3), ..Emissive::default() };
    world.spawn((Name::new("glowing ball"), Sphere { radius: 0.22 }, Placement::at(-0.75, 0.22, 1.6), glow));
    let floor = Phong { colour: Rgb::grey(0.35), specular: Rgb::grey(0.2), exponent: 400.0 };
    world.spawn((Name::new("floor"), Plane::default(), floor));

    let lamp = PointLight { intensity: Rgb::grey(26.0), ..PointLight::default() };
    world.spawn((Name::new("lamp"), lamp, Placement::at(-3.6, 4.4, 3.6)));
    let sun = DirectionalLight { irradiance: Rgb::new(0.5, 0.6, 0.8), ..DirectionalLight::default() };
    let high = LookAt { eye: [5.0, 6.0, 1.5].into(), target: [0.0, 0.0, 0.0].into(), ..LookAt::default() };
    world.spawn((Name::new("sun"), sun, high));
    let spot = SpotLight {
        intensity: Rgb::new(34.0, 30.0, 22.0),
        inner_angle: Degrees(26.0),
        outer_angle: Degrees(34.0),
        casts_shadows: true,
    };
    let above = LookAt { eye: [1.2, 4.2, 3.4].into(), target: [1.0, 0.2, 0.4].into(), ..LookAt::default() };
    world.spawn((Name::new("spot"), spot, above));
    world.spawn((Name::new("night"), Background { colour: Rgb::new(0.008, 0.012, 0.02) }));
}
// ANCHOR_END: scene
