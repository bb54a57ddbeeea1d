//! Scenes with textures, and with something more than one colour behind everything.

use super::{Eye, Setup, lit_by_lights_alone};
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::scene::*;

/// What a textured scene may have; each decides about some stage, column or table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TextureToggle {
    Checker,
    Stripes,
    Image,
    Uv,
    Filter,
    Gradient,
    Environment,
}

impl TextureToggle {
    /// All of them.
    pub const ALL: [Self; 7] =
        [Self::Checker, Self::Stripes, Self::Image, Self::Uv, Self::Filter, Self::Gradient, Self::Environment];
}

/// A lit floor and two balls with what is on.
pub fn textured_by(on: &[TextureToggle]) -> World {
    let has = |toggle| on.contains(&toggle);
    let setup = Setup { size: [24, 16], ..Setup::default() };
    let mut world = World::new();
    let look = LookAt { eye: DVec3::new(0.5, 1.5, 4.0), target: DVec3::new(0.0, 0.5, 0.0), up: DVec3::Y };
    setup.camera(&mut world, look);
    let by = if has(TextureToggle::Uv) { TextureBy::Uv } else { TextureBy::Space };
    let filter = has(TextureToggle::Filter);
    for (name, texture, place) in [
        ("floor", TextureToggle::Checker, Placement::default()),
        ("ball", TextureToggle::Stripes, Placement::at(-0.8, 0.5, 0.0)),
        ("globe", TextureToggle::Image, Placement::at(0.8, 0.5, 0.0)),
    ] {
        if !has(texture) {
            continue;
        }
        let mut entity = world.spawn((Name::new(name), Matte::default(), place));
        match texture {
            TextureToggle::Checker => entity.insert((Plane::default(), Checker { by, filter, ..Checker::default() })),
            TextureToggle::Stripes => {
                entity.insert((Sphere { radius: 0.5 }, Stripes { by, filter, size: 0.1, ..Stripes::default() }))
            }
            _ => {
                let file = "chapters/16_textures/card.png".into();
                entity.insert((Sphere { radius: 0.5 }, ImageTexture { file, by, filter, ..ImageTexture::default() }))
            }
        };
    }
    behind(&mut world, has(TextureToggle::Gradient), has(TextureToggle::Environment));
    lit_by_lights_alone(world)
}

fn behind(world: &mut World, gradient: bool, environment: bool) {
    if gradient {
        world.spawn((Name::new("sky"), Gradient { bottom: Rgb::new(0.6, 0.5, 0.3), ..Gradient::default() }));
    }
    if environment {
        let file = "chapters/16_textures/evening.hdr".into();
        world.spawn((Name::new("evening"), Environment { file, turn: Degrees(30.0), scale: 2.0 }));
    }
}

/// A lit scene with every kind of texture, by uv and by space; a gradient behind it for one camera, an environment for the
/// other.
///
/// All places lie on the grid of [`full`](super::full), and nothing but the view is turned.
pub fn textured(setup: Setup) -> World {
    let mut world = World::new();
    let look = LookAt { eye: setup.point(0.23, 1.03, 4.9), target: setup.point(0.01, 0.77, 0.02), up: DVec3::Y };
    setup.camera(&mut world, look);
    let at = |x, y, z| Placement { position: setup.point(x, y, z), ..Placement::default() };
    let length = |by: TextureBy, size: f64| if by == TextureBy::Space { size * setup.scale } else { size };
    let file = || "chapters/16_textures/card.png".to_string();
    let checker = |by, size| Checker { by, size: length(by, size), ..Checker::default() };
    let stripes =
        |by, size| Stripes { by, size: length(by, size), across: DVec3::new(1.0, 2.0, 0.5), ..Stripes::default() };
    let image = |by, size| ImageTexture { file: file(), by, size: length(by, size), ..ImageTexture::default() };
    let (uv, space) = (TextureBy::Uv, TextureBy::Space);
    let sphere = |radius: f64| Sphere { radius: radius * setup.scale };
    world.spawn((Name::new("ground"), Plane::default(), at(0.0, 0.017, 0.0), Matte::default(), checker(space, 0.3)));
    world.spawn((Name::new("left"), sphere(0.5), at(-1.27, 0.5, 0.53), Matte::default(), stripes(space, 0.1)));
    world.spawn((Name::new("middle"), sphere(0.5), at(0.03, 0.5, 0.09), Matte::default(), image(uv, 0.5)));
    let egg = Placement { scale: DVec3::new(0.5, -1.5, 1.0), ..at(1.1, 0.75, 0.31) };
    world.spawn((Name::new("egg"), sphere(0.5), egg, Matte::default(), checker(uv, 0.125)));
    let cloth = world.spawn((Name::new("cloth"), Matte::default(), image(space, 0.4))).id();
    world.spawn((Name::new("high"), sphere(0.25), at(-0.5, 1.5, 0.3), UsesMaterial(cloth)));
    world.spawn((Name::new("plain"), sphere(0.25), at(0.6, 1.5, 0.3), Matte { colour: Rgb::new(0.9, 0.3, 0.2) }));
    world.spawn((Name::new("lamp"), setup.light(60.0, true), at(2.51, 4.02, 3.03)));
    world.spawn((Name::new("fill"), setup.light(15.0, false), at(-2.91, 2.01, 2.02)));
    behind(&mut world, setup.eye == Eye::Perspective, setup.eye == Eye::Orthographic);
    lit_by_lights_alone(world)
}
