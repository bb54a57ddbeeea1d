//! Scenes of all combinations of what a scene may have.

use super::{Eye, Setup, leaning_triangle, lens, lit_by_lights_alone, material, named, set_in_motion};
use bevy_ecs::prelude::*;
use glam::{DQuat, DVec3};
use pinhole::scene::*;

/// What a scene may have beside its camera; each decides about some stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Toggle {
    Light,
    SecondLight,
    Plane,
    Sphere,
    Ellipsoid,
    /// A disk, a rectangle, a cuboid and a triangle.
    Shapes,
    Shadow,
    Orthographic,
    Background,
    View,
    Statistics,
    Layers,
    Sun,
    Spot,
    Phong,
    BlinnPhong,
    Emissive,
    Samples,
    /// A lens, where the camera is a perspective one.
    Lens,
    /// A shutter that stays open while the camera moves, and the ball and the planar shapes where there are any.
    Motion,
    Mirror,
    /// Glass that absorbs.
    Glass,
    Metal,
    RoughGlass,
    Principled,
}

/// All of them.
pub const TOGGLES: &[Toggle] = &[
    Toggle::Light,
    Toggle::SecondLight,
    Toggle::Plane,
    Toggle::Sphere,
    Toggle::Shadow,
    Toggle::Orthographic,
    Toggle::Background,
    Toggle::View,
    Toggle::Statistics,
];

/// Those that are tried alone and in pairs, beside some of [`TOGGLES`], and not in all combinations.
pub const MORE: [Toggle; 16] = [
    Toggle::Ellipsoid,
    Toggle::Shapes,
    Toggle::Layers,
    Toggle::Samples,
    Toggle::Sun,
    Toggle::Spot,
    Toggle::Phong,
    Toggle::BlinnPhong,
    Toggle::Emissive,
    Toggle::Lens,
    Toggle::Motion,
    Toggle::Mirror,
    Toggle::Glass,
    Toggle::Metal,
    Toggle::RoughGlass,
    Toggle::Principled,
];

/// The column that [`Toggle::View`] asks for; only a scene with a shape has it.
pub const VIEWED: &str = "surface";

/// A camera and what is on.
pub fn toggled(on: &[Toggle]) -> World {
    let has = |toggle| on.contains(&toggle);
    let mut world = World::new();
    let eye = if has(Toggle::Orthographic) { Eye::Orthographic } else { Eye::Perspective };
    let setup = Setup { eye, size: [24, 16], ..Setup::default() };
    let look = LookAt { eye: DVec3::new(0.5, 1.5, 4.0), target: DVec3::new(0.0, 0.5, 0.0), up: DVec3::Y };
    setup.camera(&mut world, look);
    let light = |intensity| setup.light(intensity, has(Toggle::Shadow));
    if has(Toggle::Light) {
        world.spawn((Name::new("lamp"), light(40.0), Placement::at(2.0, 3.0, 2.0)));
    }
    if has(Toggle::SecondLight) {
        world.spawn((Name::new("second lamp"), light(25.0), Placement::at(-2.0, 2.0, 3.0)));
    }
    if has(Toggle::Plane) {
        world.spawn((Name::new("ground"), Plane::default(), Matte { colour: Rgb::new(0.5, 0.6, 0.4) }));
    }
    if has(Toggle::Sphere) {
        let ball = (Sphere { radius: 0.75 }, Placement::at(0.0, 0.75, 0.0));
        world.spawn((Name::new("ball"), ball, Matte { colour: Rgb::new(0.8, 0.3, 0.2) }));
    }
    if has(Toggle::Ellipsoid) {
        let scale = DVec3::new(0.5, 1.5, 1.0);
        let egg = (Sphere { radius: 0.5 }, Placement { scale, ..Placement::at(1.2, 0.75, 0.3) });
        world.spawn((Name::new("egg"), egg, Matte { colour: Rgb::new(0.9, 0.8, 0.6) }));
    }
    if has(Toggle::Shapes) {
        let matte = |r, g, b| Matte { colour: Rgb::new(r, g, b) };
        let coin = Placement {
            orientation: DQuat::from_xyzw(0.5, 0.1, 0.1, 0.5).normalize(),
            ..Placement::at(-1.2, 0.9, 0.5)
        };
        world.spawn((Name::new("coin"), Disk { radius: 0.5 }, coin, matte(0.9, 0.7, 0.1)));
        let mat = (Rectangle { width: 1.5, depth: 1.0 }, Placement::at(0.3, 0.05, 1.2));
        world.spawn((Name::new("mat"), mat, matte(0.3, 0.2, 0.7)));
        let brick = (Cuboid { size: DVec3::new(0.6, 0.4, 0.5) }, Placement::at(-0.4, 1.6, 0.0));
        world.spawn((Name::new("brick"), brick, matte(0.6, 0.2, 0.1)));
        let pipe = (Cylinder { radius: 0.2, height: 0.8, capped: true }, Placement::at(0.9, 1.5, 0.2));
        world.spawn((Name::new("pipe"), pipe, matte(0.2, 0.6, 0.3)));
        let hat = (Cone { radius: 0.3, height: 0.6, capped: true }, Placement::at(1.3, 0.4, 0.9));
        world.spawn((Name::new("hat"), hat, matte(0.5, 0.3, 0.6)));
        let ring = (Torus { radius: 0.3, tube: 0.1 }, Placement::at(-0.5, 0.4, 1.2));
        world.spawn((Name::new("ring"), ring, matte(0.7, 0.6, 0.5)));
        let sail = (leaning_triangle(1.0), Placement::at(-1.2, 0.3, 0.4));
        world.spawn((Name::new("sail"), sail, matte(0.4, 0.7, 0.9)));
    }
    if has(Toggle::Sun) {
        let sun = DirectionalLight { irradiance: Rgb::grey(0.8), casts_shadows: has(Toggle::Shadow) };
        world.spawn((Name::new("sun"), sun, LookAt { eye: DVec3::new(-2.0, 3.0, 2.0), ..LookAt::default() }));
    }
    if has(Toggle::Spot) {
        let spot = SpotLight { intensity: Rgb::grey(20.0), casts_shadows: has(Toggle::Shadow), ..SpotLight::default() };
        world.spawn((Name::new("spot"), spot, LookAt { eye: DVec3::new(1.0, 3.0, 1.5), ..LookAt::default() }));
    }
    if has(Toggle::Phong) {
        let ball = (Sphere { radius: 0.5 }, Placement::at(-1.2, 0.5, 0.4));
        world.spawn((Name::new("glossy ball"), ball, Phong { exponent: 8.0, ..Phong::default() }));
    }
    if has(Toggle::BlinnPhong) {
        let ball = (Sphere { radius: 0.5 }, Placement::at(1.0, 0.5, 0.6));
        world.spawn((Name::new("satin ball"), ball, BlinnPhong { exponent: 20.0, ..BlinnPhong::default() }));
    }
    if has(Toggle::Emissive) {
        let ball = (Sphere { radius: 0.3 }, Placement::at(0.3, 1.8, 0.5));
        world.spawn((Name::new("glow"), ball, Emissive { radiance: Rgb::new(0.6, 0.5, 0.2), ..Emissive::default() }));
    }
    if has(Toggle::Mirror) {
        material::ball_of(&mut world, "mirror ball", -0.9, Mirror::default());
    }
    if has(Toggle::Glass) {
        let absorption = Rgb::new(0.2, 0.4, 0.8);
        material::ball_of(&mut world, "glass ball", 0.4, Glass { absorption, ..Glass::default() });
    }
    if has(Toggle::Metal) {
        material::ball_of(&mut world, "metal ball", 1.5, Metal::default());
    }
    if has(Toggle::RoughGlass) {
        material::ball_of(&mut world, "frosted ball", -0.3, RoughGlass::default());
    }
    if has(Toggle::Principled) {
        material::ball_of(&mut world, "principled ball", 0.9, Principled::default());
    }
    if has(Toggle::Background) {
        world.spawn((Name::new("sky"), Background { colour: Rgb::new(0.2, 0.4, 0.7) }));
    }
    let camera = named(&mut world, "camera");
    if has(Toggle::View) {
        world.entity_mut(camera).insert(View { column: VIEWED.into() });
    }
    if has(Toggle::Statistics) {
        world.entity_mut(camera).insert(Statistics);
    }
    if has(Toggle::Layers) {
        world.entity_mut(camera).insert(Layers::all());
    }
    if has(Toggle::Lens) && eye == Eye::Perspective {
        world.entity_mut(camera).insert(lens(1.0));
    }
    if has(Toggle::Motion) {
        set_in_motion(&mut world, &setup);
    }
    if has(Toggle::Samples) {
        world.entity_mut(camera).insert(Sampling { samples: 2, filter: Filter::MITCHELL, ..Sampling::default() });
    }
    lit_by_lights_alone(world)
}

/// All combinations of [`TOGGLES`], the empty one first; then each of [`MORE`] beside none, one or several of them, and
/// all pairs of it.
pub fn combinations() -> Vec<Vec<Toggle>> {
    let chosen = |bits: usize| (0..TOGGLES.len()).filter(|bit| bits >> bit & 1 == 1).map(|bit| TOGGLES[bit]).collect();
    let mut all: Vec<Vec<Toggle>> = (0..1 << TOGGLES.len()).map(chosen).collect();
    let lit = vec![Toggle::Light, Toggle::Plane, Toggle::Sphere, Toggle::Shadow];
    let several = [vec![], lit, TOGGLES.to_vec()];
    let beside: Vec<Vec<Toggle>> = TOGGLES.iter().map(|&toggle| vec![toggle]).chain(several.clone()).collect();
    for (place, &more) in MORE.iter().enumerate() {
        all.extend(beside.iter().map(|on| [on.as_slice(), &[more]].concat()));
        for &other in &MORE[place + 1..] {
            all.extend(several.iter().map(|on| [on.as_slice(), &[more, other]].concat()));
        }
    }
    all
}

/// None, each alone, all pairs.
pub fn singles_and_pairs() -> Vec<Vec<Toggle>> {
    combinations().into_iter().filter(|on| on.len() <= 2).collect()
}
