//! Textures and backgrounds that are refused.

use super::cases::{Case, Field, edit, good, put};
use crate::scenes::{Eye, named};
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::scene::*;

/// A scene with one of each texture, all well.
pub fn good_textures() -> World {
    let mut world = good(Eye::Perspective);
    put(&mut world, "ball", ImageTexture { file: "chapters/16_textures/card.png".into(), ..ImageTexture::default() });
    put(&mut world, "floor", Checker::default());
    world.spawn((Name::new("wall"), Plane { normal: DVec3::Z }, Matte::default(), Stripes::default()));
    world
}

fn behind(world: &mut World, bundle: impl Bundle) {
    let sky = named(world, "sky");
    world.entity_mut(sky).remove::<Background>().insert(bundle);
}

fn environment(file: &str) -> Environment {
    Environment { file: file.into(), ..Environment::default() }
}

/// Makes the ball of a principled material with a map.
fn worn(world: &mut World, map: MetallicRoughnessMap) {
    let ball = named(world, "ball");
    world.entity_mut(ball).remove::<Matte>().insert((Principled::default(), map));
}

const EVENING: &str = "chapters/16_textures/evening.hdr";

pub const TEXTURES: &[Case] = &[
    ("a checker without a material", &["checker \"cloth\"", "material", "Matte"], |w| {
        w.spawn((Name::new("cloth"), Checker::default()));
    }),
    ("a checker on a lamp", &["checker \"lamp\"", "material"], |w| put(w, "lamp", Checker::default())),
    ("a checker on glass", &["checker \"pane\"", "material is glass", "diffuse reflection", "a Matte"], |w| {
        w.spawn((Name::new("pane"), Glass::default(), Checker::default()));
    }),
    ("stripes on a mirror", &["stripes \"silver\"", "material is mirror", "a Matte"], |w| {
        w.spawn((Name::new("silver"), Mirror::default(), Stripes::default()));
    }),
    ("a checker on metal", &["checker \"gold\"", "material is metal", "a Matte"], |w| {
        w.spawn((Name::new("gold"), Metal::default(), Checker::default()));
    }),
    ("two textures on one", &["\"floor\"", "texture", "checker and as stripes", "one texture only"], |w| {
        put(w, "floor", Stripes::default());
    }),
    ("a checker's size 0", &["checker \"floor\"", "size", "0"], |w| edit::<Checker>(w, "floor", |c| c.size = 0.0)),
    ("a checker's size −1", &["checker \"floor\"", "size", "-1"], |w| edit::<Checker>(w, "floor", |c| c.size = -1.0)),
    ("a checker that gives back more", &["checker \"floor\"", "first", "(2, 0, 0)"], |w| {
        edit::<Checker>(w, "floor", |c| c.first = Rgb::new(2.0, 0.0, 0.0));
    }),
    (
        "a checker that leaves its highlight no room",
        &["checker \"floor\"", "first", "(0.8, 0.8, 0.8)", "specular colour (0.3"],
        |w| {
            let floor = named(w, "floor");
            let shiny = Phong { colour: Rgb::grey(0.1), specular: Rgb::grey(0.3), exponent: 20.0 };
            w.entity_mut(floor).remove::<Matte>().insert(shiny);
        },
    ),
    (
        "an image brighter than its highlight allows",
        &["image texture \"ball\"", "card.png", "specular colour (0, 0.9"],
        |w| {
            let ball = named(w, "ball");
            let shiny = BlinnPhong { colour: Rgb::grey(0.0), specular: Rgb::new(0.0, 0.9, 0.0), exponent: 20.0 };
            w.entity_mut(ball).remove::<Matte>().insert(shiny);
        },
    ),
    ("stripes of negative light", &["stripes \"wall\"", "second", "(0, -1, 0)"], |w| {
        edit::<Stripes>(w, "wall", |s| s.second = Rgb::new(0.0, -1.0, 0.0));
    }),
    ("stripes across nothing", &["stripes \"wall\"", "across", "(0, 0, 0)"], |w| {
        edit::<Stripes>(w, "wall", |s| s.across = DVec3::ZERO);
    }),
    ("stripes by uv across z", &["stripes \"wall\"", "across", "(0, 0, 1)", "u and v"], |w| {
        edit::<Stripes>(w, "wall", |s| (s.across, s.by) = (DVec3::Z, TextureBy::Uv));
    }),
    ("an image's size 0", &["image texture \"ball\"", "size"], |w| edit::<ImageTexture>(w, "ball", |i| i.size = 0.0)),
    ("an image without a file", &["image texture \"ball\"", "file is \"\"", ".png"], |w| {
        put(w, "ball", ImageTexture::default());
    }),
    ("an image that is not there", &["\"ball\"", "file is \"nowhere.png\"", "there is no file nowhere.png"], |w| {
        edit::<ImageTexture>(w, "ball", |i| i.file = "nowhere.png".into());
    }),
    (
        "an image of another kind",
        &["\"ball\"", "file is \"Cargo.toml\"", ".png, .jpg, .tga, .bmp, .hdr or .exr"],
        |w| {
            edit::<ImageTexture>(w, "ball", |i| i.file = "Cargo.toml".into());
        },
    ),
    ("a file with a long name", &["\"ball\"", "file is \"long/", "there is no file long/", "…"], |w| {
        edit::<ImageTexture>(w, "ball", |i| i.file = format!("{}card.png", "long/".repeat(200)));
    }),
    ("a normal map without a material", &["normal map \"cloth\"", "material", "Matte"], |w| {
        w.spawn((Name::new("cloth"), NormalMap::default()));
    }),
    (
        "a normal map without a file",
        &["normal map \"ball\"", "file is \"\"", ".png, .jpg, .tga, .bmp, .hdr or .exr"],
        |w| {
            put(w, "ball", NormalMap::default());
        },
    ),
    ("a normal map that is not there", &["normal map \"pane\"", "there is no file nowhere.png"], |w| {
        w.spawn((
            Name::new("pane"),
            Glass::default(),
            NormalMap { file: "nowhere.png".into(), ..NormalMap::default() },
        ));
    }),
    ("a normal map of size 0", &["normal map \"ball\"", "size"], |w| {
        put(w, "ball", NormalMap { size: 0.0, ..NormalMap::default() });
    }),
    ("a map of roughness without a material", &["metallic–roughness map \"cloth\"", "missing", "Principled"], |w| {
        w.spawn((Name::new("cloth"), MetallicRoughnessMap::default()));
    }),
    ("a map of roughness on matte", &["metallic–roughness map \"floor\"", "is matte", "a Principled"], |w| {
        put(w, "floor", MetallicRoughnessMap::default());
    }),
    ("a map of roughness without a file", &["metallic–roughness map \"ball\"", "file is \"\"", ".png, .jpg"], |w| {
        worn(w, MetallicRoughnessMap::default());
    }),
    ("a map of roughness that is not there", &["\"ball\"", "there is no file nowhere.png"], |w| {
        worn(w, MetallicRoughnessMap { file: "nowhere.png".into(), ..MetallicRoughnessMap::default() });
    }),
    ("a map of roughness of size 0", &["metallic–roughness map \"ball\"", "size is 0"], |w| {
        worn(w, MetallicRoughnessMap { size: 0.0, ..MetallicRoughnessMap::default() });
    }),
    ("an emission map beside no emission", &["emission map \"ball\"", "emission is missing", "an Emissive"], |w| {
        put(w, "ball", EmissionMap::default());
    }),
    ("an emission map that is not there", &["emission map \"glow\"", "there is no file nowhere.png"], |w| {
        put(w, "glow", EmissionMap { file: "nowhere.png".into(), ..EmissionMap::default() });
    }),
    ("an emission map of size −1", &["emission map \"glow\"", "size is -1"], |w| {
        put(w, "glow", EmissionMap { size: -1.0, ..EmissionMap::default() });
    }),
    ("an emission map too bright for f32", &["emission map \"glow\"", "brightest texel", "3.4e38"], |w| {
        edit::<Emissive>(w, "glow", |e| e.radiance = Rgb::grey(3e38));
        put(w, "glow", EmissionMap { file: EVENING.into(), ..EmissionMap::default() });
    }),
    ("an opacity of 1.5", &["opacity \"floor\"", "opacity is 1.5", "from 0 to 1"], |w| {
        put(w, "floor", Opacity { opacity: 1.5, ..Opacity::default() });
    }),
    ("a cutoff of −1", &["opacity \"floor\"", "cutoff is -1", "at least 0"], |w| {
        put(w, "floor", Opacity { cutoff: -1.0, ..Opacity::default() });
    }),
    ("an opacity of nothing", &["opacity \"mist\"", "missing", "a Matte"], |w| {
        w.spawn((Name::new("mist"), Opacity::default()));
    }),
    ("an opacity of glass", &["opacity \"pane\"", "is glass", "a Matte"], |w| {
        w.spawn((Name::new("pane"), Sphere::default(), Glass::default(), Opacity::default()));
    }),
    ("single-sided glass", &["single sided \"pane\"", "is glass", "a Matte"], |w| {
        w.spawn((Name::new("pane"), Sphere::default(), Glass::default(), SingleSided {}));
    }),
    ("an opacity map that is not there", &["opacity map \"floor\"", "there is no file nowhere.png"], |w| {
        put(w, "floor", OpacityMap { file: "nowhere.png".into(), ..OpacityMap::default() });
    }),
    ("an opacity of what moves", &["\"satin\"", "given to a shape that moves", "must be opaque"], |w| {
        put(w, "satin", (Opacity { opacity: 0.5, ..Opacity::default() }, Motion { velocity: DVec3::X }));
        put(w, "main", Shutter::default());
    }),
    ("a gradient and a background", &["the scene", "a Background by \"sky\" and a Gradient by \"dusk\""], |w| {
        w.spawn((Name::new("dusk"), Gradient::default()));
    }),
    ("two gradients", &["gradient", "\"sky\" and (unnamed, entity "], |w| {
        behind(w, Gradient::default());
        w.spawn(Gradient::default());
    }),
    ("a gradient of negative light", &["gradient \"sky\"", "top", "(0, 0, -1)"], |w| {
        behind(w, Gradient { top: Rgb::new(0.0, 0.0, -1.0), ..Gradient::default() });
    }),
    ("an environment and a background", &["the scene", "\"sky\"", "an Environment by \"dusk\""], |w| {
        w.spawn((Name::new("dusk"), environment(EVENING)));
    }),
    ("an environment without a file", &["environment \"sky\"", "file is \"\"", ".hdr or .exr"], |w| {
        behind(w, environment(""));
    }),
    ("an environment's scale −1", &["environment \"sky\"", "scale", "-1"], |w| {
        behind(w, Environment { scale: -1.0, ..environment(EVENING) });
    }),
    ("an environment too bright for f32", &["environment \"sky\"", "scale", "1e300"], |w| {
        behind(w, Environment { scale: 1e300, ..environment(EVENING) });
    }),
    ("an environment turned by NaN", &["environment \"sky\"", "turn", "NaN°"], |w| {
        behind(w, Environment { turn: Degrees(f64::NAN), ..environment(EVENING) });
    }),
];

pub const TEXTURE_FIELDS: &[Field] = &[
    ("first", "floor", |w, v| edit::<Checker>(w, "floor", |c| c.first.r = v)),
    ("second", "floor", |w, v| edit::<Checker>(w, "floor", |c| c.second.g = v)),
    ("size", "floor", |w, v| edit::<Checker>(w, "floor", |c| c.size = v)),
    ("first", "wall", |w, v| edit::<Stripes>(w, "wall", |s| s.first.b = v)),
    ("second", "wall", |w, v| edit::<Stripes>(w, "wall", |s| s.second.r = v)),
    ("size", "wall", |w, v| edit::<Stripes>(w, "wall", |s| s.size = v)),
    ("across", "wall", |w, v| edit::<Stripes>(w, "wall", |s| s.across.y = v)),
    ("size", "ball", |w, v| edit::<ImageTexture>(w, "ball", |i| i.size = v)),
    ("size", "ball", |w, v| put(w, "ball", NormalMap { size: v, ..NormalMap::default() })),
    ("scale", "ball", |w, v| put(w, "ball", NormalMap { scale: v, ..NormalMap::default() })),
    ("size", "ball", |w, v| worn(w, MetallicRoughnessMap { size: v, ..MetallicRoughnessMap::default() })),
    ("size", "glow", |w, v| put(w, "glow", EmissionMap { size: v, ..EmissionMap::default() })),
    ("opacity", "floor", |w, v| put(w, "floor", Opacity { opacity: v, ..Opacity::default() })),
    ("cutoff", "floor", |w, v| put(w, "floor", Opacity { cutoff: v, ..Opacity::default() })),
    ("size", "floor", |w, v| put(w, "floor", OpacityMap { size: v, file: EVENING.into(), ..OpacityMap::default() })),
    ("bottom", "sky", |w, v| behind(w, Gradient { bottom: Rgb::grey(v), ..Gradient::default() })),
    ("top", "sky", |w, v| behind(w, Gradient { top: Rgb::grey(v), ..Gradient::default() })),
    ("scale", "sky", |w, v| behind(w, Environment { scale: v, ..environment(EVENING) })),
    ("turn", "sky", |w, v| behind(w, Environment { turn: Degrees(v), ..environment(EVENING) })),
];
