//! How does a surface get more than one colour, and what is the colour of a pixel that covers a thousand of them?
//! A checkered floor to the horizon, stripes through a block, an image on a ball and on a panel, an evening sky all round.
//! New here: what a pixel covers of a surface, the mean of a texture over it, and light from an image of all directions.

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
    Chapter::new("16_textures", "textures and environment", scene)
        .offer(stages::camera_rays())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::direct_light())
        .offer(stages::lights())
        .offer(stages::environment())
        .offer(stages::textures())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(38.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.3, 1.5, 6.0].into(), target: [0.0, 1.0, 0.0].into(), ..LookAt::default() },
    ));
    let checker = Checker { first: Rgb::new(0.85, 0.8, 0.7), second: Rgb::new(0.12, 0.13, 0.2), ..Checker::default() };
    world.spawn((Name::new("floor"), Plane::default(), Matte::default(), checker));

    let card = || ImageTexture { file: "card.png".into(), ..ImageTexture::default() };
    let ball = (Sphere { radius: 0.9 }, Placement::at(-0.3, 0.9, 0.4));
    world.spawn((Name::new("ball"), ball, Matte::default(), card()));
    let upright = DQuat::from_xyzw(0.685, 0.175, -0.175, 0.685).normalize();
    let panel = Placement { orientation: upright, ..Placement::at(-2.4, 0.9, -0.6) };
    world.spawn((Name::new("panel"), Rectangle { width: 1.8, depth: 1.8 }, panel, Matte::default(), card()));

    let stripes = Stripes {
        first: Rgb::grey(0.85),
        second: Rgb::new(0.6, 0.12, 0.08),
        size: 0.1,
        across: [1.0, 2.0, 1.0].into(),
        ..Stripes::default()
    };
    let block =
        Placement { orientation: DQuat::from_xyzw(0.0, 0.3, 0.0, 0.95).normalize(), ..Placement::at(2.1, 0.6, 0.0) };
    world.spawn((Name::new("block"), Cuboid { size: [1.2, 1.2, 1.2].into() }, block, Matte::default(), stripes));

    let evening = Environment { file: "evening.hdr".into(), turn: Degrees(-50.0), scale: 1.0 };
    world.spawn((Name::new("evening"), evening));
    let sun = DirectionalLight { irradiance: Rgb::new(2.6, 1.8, 1.1), ..DirectionalLight::default() };
    let from = LookAt { eye: [0.973, 0.4, 0.3].into(), target: [0.0; 3].into(), ..LookAt::default() };
    world.spawn((Name::new("sun"), sun, from));
    let sky = PointLight { intensity: Rgb::new(26.0, 30.0, 38.0), casts_shadows: false };
    world.spawn((Name::new("sky light"), sky, Placement::at(-3.0, 5.0, 5.0)));

    // Compiled in, so that the program may be run from any folder and copied anywhere.
    let files: &[(&str, &[u8])] = &[
        ("card.png", include_bytes!("card.png")),
        ("evening.hdr", include_bytes!("evening.hdr")),
        ("studs.hdr", include_bytes!("studs.hdr")),
    ];
    world.insert_resource(EmbeddedFiles(files));
    world.insert_resource(SceneFolder(concat!(env!("CARGO_MANIFEST_DIR"), "/16_textures").into()));
}
// ANCHOR_END: scene
