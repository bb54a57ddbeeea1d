//! Every refusal: one sentence that names the entity, the field, the value and what is accepted; never a panic.

#[path = "../chapters/mod.rs"]
mod chapters;
mod scenes;

use bevy_ecs::prelude::*;
use exr::prelude::{FlatSamples, read_first_flat_layer_from_file};
use glam::{DQuat, DVec3};
use pinhole::film::{Curve, Film, FilmTile, Rejected, byte_from_linear, png_bytes, write_exr, write_png};
use pinhole::plan::PlanError;
use pinhole::rays::Tile;
use pinhole::render::prepare;
use pinhole::scene::*;
use pinhole::{Error, command, look};
use scenes::{Eye, Setup, full, named, offer};
use std::fmt::Display;
use std::fs;

/// A scene with one of each kind, all well.
fn good(eye: Eye) -> World {
    let mut world = World::new();
    let resolution = Resolution { width: 16, height: 9 };
    let mut camera = world.spawn((Name::new("main"), resolution, Placement::at(0.0, 1.0, 5.0)));
    match eye {
        Eye::Perspective => camera.insert(PerspectiveCamera::default()),
        Eye::Orthographic => camera.insert(OrthographicCamera::default()),
    };
    world.spawn((Name::new("ball"), Sphere::default(), Matte::default(), Placement::at(0.0, 1.0, 0.0)));
    world.spawn((Name::new("floor"), Plane::default(), Matte::default()));
    world.spawn((Name::new("lamp"), PointLight::default(), Placement::at(2.0, 4.0, 2.0)));
    world.spawn((Name::new("sky"), Background { colour: Rgb::grey(0.5) }));
    world
}

fn look_at(world: &mut World, look: LookAt) {
    let camera = named(world, "main");
    world.entity_mut(camera).insert((Placement::default(), look));
}

fn edit<C: Component<Mutability = bevy_ecs::component::Mutable>>(
    world: &mut World,
    name: &str,
    change: impl FnOnce(&mut C),
) {
    let entity = named(world, name);
    change(&mut world.get_mut::<C>(entity).expect("the entity has the component"));
}

fn put(world: &mut World, name: &str, bundle: impl Bundle) {
    let entity = named(world, name);
    world.entity_mut(entity).insert(bundle);
}

fn child_of(world: &mut World, child: &str, parent: Entity) {
    put(world, child, ChildOf(parent));
}

/// What is wrong, in words; the words that the refusal must hold; how to make it so.
type Case = (&'static str, &'static [&'static str], fn(&mut World));

const CAMERAS: &[Case] = &[
    ("no camera", &["camera", "missing", "PerspectiveCamera"], |w| {
        let camera = named(w, "main");
        w.despawn(camera);
    }),
    ("the only camera disabled", &["camera", "missing"], |w| put(w, "main", Disabled)),
    ("two cameras", &["camera", "\"main\"", "\"second\""], |w| {
        w.spawn((Name::new("second"), PerspectiveCamera::default()));
    }),
    ("two cameras, one unnamed", &["camera", "\"main\"", "(unnamed, entity "], |w| {
        w.spawn(OrthographicCamera::default());
    }),
    ("both kinds on one", &["camera", "PerspectiveCamera and an OrthographicCamera", "\"main\""], |w| {
        put(w, "main", OrthographicCamera::default())
    }),
    ("fov 0", &["\"main\"", "fov", "0°"], |w| edit::<PerspectiveCamera>(w, "main", |c| c.fov = Degrees(0.0))),
    ("fov 180", &["\"main\"", "fov", "180°"], |w| edit::<PerspectiveCamera>(w, "main", |c| c.fov = Degrees(180.0))),
    ("fov −5", &["\"main\"", "fov", "-5°"], |w| edit::<PerspectiveCamera>(w, "main", |c| c.fov = Degrees(-5.0))),
    ("fov 1e300", &["\"main\"", "fov", "1e300°"], |w| {
        edit::<PerspectiveCamera>(w, "main", |c| c.fov = Degrees(1e300));
    }),
    ("fov 1e-4 over 1024 px", &["\"main\"", "fov", "0.0001°", "1024", "rad"], |w| {
        put(w, "main", Resolution { width: 1024, height: 1024 });
        edit::<PerspectiveCamera>(w, "main", |c| c.fov = Degrees(1e-4));
    }),
    ("resolution 0 × 5", &["\"main\"", "resolution", "0 × 5"], |w| {
        put(w, "main", Resolution { width: 0, height: 5 });
    }),
    ("resolution 5 × 0", &["\"main\"", "resolution", "5 × 0"], |w| {
        put(w, "main", Resolution { width: 5, height: 0 });
    }),
    ("resolution 70000 × 1", &["\"main\"", "resolution", "70000 × 1"], |w| {
        put(w, "main", Resolution { width: 70_000, height: 1 });
    }),
    ("resolution 65536 × 65536", &["\"main\"", "resolution", "65536 × 65536"], |w| {
        put(w, "main", Resolution { width: 65_536, height: 65_536 });
    }),
    ("eye at target", &["\"main\"", "target", "(1, 2, 3)"], |w| {
        look_at(w, LookAt { eye: DVec3::new(1.0, 2.0, 3.0), target: DVec3::new(1.0, 2.0, 3.0), up: DVec3::Y });
    }),
    ("up along the view", &["\"main\"", "up", "(0, 1, 0)"], |w| {
        look_at(w, LookAt { eye: DVec3::new(0.0, 5.0, 0.0), target: DVec3::ZERO, up: DVec3::Y });
    }),
    ("up against the view", &["\"main\"", "up", "(0, 0, -3)"], |w| {
        look_at(w, LookAt { eye: DVec3::ZERO, target: DVec3::Z, up: DVec3::new(0.0, 0.0, -3.0) });
    }),
    ("up of length 0", &["\"main\"", "up", "(0, 0, 0)"], |w| {
        look_at(w, LookAt { up: DVec3::ZERO, ..LookAt::default() })
    }),
    ("LookAt and a set position", &["\"main\"", "position", "(1, 0, 0)", "LookAt"], |w| {
        put(w, "main", (LookAt::default(), Placement::at(1.0, 0.0, 0.0)));
    }),
    ("LookAt and a set orientation", &["\"main\"", "orientation", "(0, 1, 0, 0)", "LookAt"], |w| {
        let orientation = DQuat::from_xyzw(0.0, 1.0, 0.0, 0.0);
        put(w, "main", (LookAt::default(), Placement { orientation, ..Placement::default() }));
    }),
    ("a scaled camera", &["\"main\"", "scale", "(2, 2, 2)"], |w| {
        edit::<Placement>(w, "main", |p| p.scale = DVec3::splat(2.0));
    }),
    ("a mirrored camera", &["\"main\"", "scale", "mirrored"], |w| {
        edit::<Placement>(w, "main", |p| p.scale = DVec3::new(-1.0, 1.0, 1.0));
    }),
    ("a camera scaled by its parent", &["\"main\"", "scale", "(1, 3, 1)"], |w| {
        let scale = DVec3::new(1.0, 3.0, 1.0);
        let parent = w.spawn(Placement { scale, ..Placement::default() }).id();
        child_of(w, "main", parent);
    }),
    ("a camera mirrored by its parent", &["\"main\"", "scale", "mirrored"], |w| {
        let parent = w.spawn(Placement { scale: DVec3::splat(-1.0), ..Placement::default() }).id();
        child_of(w, "main", parent);
    }),
    ("two views", &["view", "\"main\"", "\"floor\""], |w| {
        put(w, "main", View { column: "hit".into() });
        put(w, "floor", View { column: "ndc".into() });
    }),
];

const SHAPES: &[Case] = &[
    ("orientation not unit", &["\"ball\"", "orientation", "(0, 0, 0, 2)", "length 1"], |w| {
        edit::<Placement>(w, "ball", |p| p.orientation = DQuat::from_xyzw(0.0, 0.0, 0.0, 2.0));
    }),
    ("scale 0", &["\"floor\"", "scale", "(1, 0, 1)"], |w| {
        edit::<Placement>(w, "floor", |p| p.scale = DVec3::new(1.0, 0.0, 1.0));
    }),
    ("scale so small that it vanishes", &["\"floor\"", "placement"], |w| {
        edit::<Placement>(w, "floor", |p| p.scale = DVec3::splat(1e-200));
    }),
    ("position out of reach", &["\"ball\"", "position", "1e300"], |w| {
        edit::<Placement>(w, "ball", |p| p.position = DVec3::splat(1e300));
    }),
    ("a parent that is its own child", &["\"ball\"", "parent", "circle through \"ball\""], |w| {
        let (ball, floor) = (named(w, "ball"), named(w, "floor"));
        child_of(w, "ball", floor);
        child_of(w, "floor", ball);
    }),
    ("ancestors in a circle", &["\"ball\"", "parent", "circle through \"group\""], |w| {
        let group = w.spawn((Name::new("group"), Placement::default())).id();
        let second = w.spawn((Placement::default(), ChildOf(group))).id();
        w.entity_mut(group).insert(ChildOf(second));
        child_of(w, "ball", group);
    }),
    ("a parent with scale 0", &["\"ball\"", "parent", "\"group\"", "scale", "(1, 0, 1)"], |w| {
        let scale = DVec3::new(1.0, 0.0, 1.0);
        let group = w.spawn((Name::new("group"), Placement { scale, ..Placement::default() })).id();
        child_of(w, "ball", group);
    }),
    ("scales that vanish together", &["\"floor\"", "placement"], |w| {
        let mut parent = w.spawn(Placement::default()).id();
        for _ in 0..8 {
            let place = Placement { scale: DVec3::splat(1e-17), ..Placement::default() };
            parent = w.spawn((place, ChildOf(parent))).id();
        }
        child_of(w, "floor", parent);
    }),
    ("radius 0", &["\"ball\"", "radius", "is 0,"], |w| edit::<Sphere>(w, "ball", |s| s.radius = 0.0)),
    ("radius −1", &["\"ball\"", "radius", "is -1,"], |w| edit::<Sphere>(w, "ball", |s| s.radius = -1.0)),
    ("radius 1e300", &["\"ball\"", "radius", "is 1e300,"], |w| edit::<Sphere>(w, "ball", |s| s.radius = 1e300)),
    ("radius too small", &["\"ball\"", "radius", "is 1e-40,"], |w| edit::<Sphere>(w, "ball", |s| s.radius = 1e-40)),
    ("radius −1, scaled", &["\"ball\"", "radius", "is -1,"], |w| {
        edit::<Sphere>(w, "ball", |s| s.radius = -1.0);
        edit::<Placement>(w, "ball", |p| p.scale = DVec3::splat(2.0));
    }),
    ("radius out of reach by its scale", &["\"ball\"", "radius", "is 1e17 scaled by 1000,"], |w| {
        edit::<Sphere>(w, "ball", |s| s.radius = 1e17);
        edit::<Placement>(w, "ball", |p| p.scale = DVec3::splat(1e3));
    }),
    ("an uneven sphere", &["\"ball\"", "scale", "(1, 2, 1)"], |w| {
        edit::<Placement>(w, "ball", |p| p.scale = DVec3::new(1.0, 2.0, 1.0));
    }),
    ("normal 0", &["\"floor\"", "normal", "(0, 0, 0)"], |w| edit::<Plane>(w, "floor", |p| p.normal = DVec3::ZERO)),
    ("two shapes on one entity", &["\"ball\"", "Sphere and Plane"], |w| put(w, "ball", Plane::default())),
    ("an unnamed sphere", &["(unnamed, entity ", "radius", "-2"], |w| {
        w.spawn((Sphere { radius: -2.0 }, Matte::default()));
    }),
];

const MATTER: &[Case] = &[
    ("no material", &["\"ball\"", "material", "missing", "Matte"], |w| {
        let ball = named(w, "ball");
        w.entity_mut(ball).remove::<Matte>();
    }),
    ("two materials", &["\"ball\"", "material", "twice", "\"floor\""], |w| {
        let floor = named(w, "floor");
        put(w, "ball", UsesMaterial(floor));
    }),
    ("a material that is none", &["\"ball\"", "material", "\"lamp\"", "Matte"], |w| {
        let (ball, lamp) = (named(w, "ball"), named(w, "lamp"));
        w.entity_mut(ball).remove::<Matte>().insert(UsesMaterial(lamp));
    }),
    ("a material that is disabled", &["\"ball\"", "material", "\"gold\"", "disabled"], |w| {
        let gold = w.spawn((Name::new("gold"), Matte::default(), Disabled)).id();
        let ball = named(w, "ball");
        w.entity_mut(ball).remove::<Matte>().insert(UsesMaterial(gold));
    }),
    ("colour 1.5", &["\"ball\"", "colour", "(1.5, 0, 0)"], |w| {
        edit::<Matte>(w, "ball", |m| m.colour = Rgb::new(1.5, 0.0, 0.0));
    }),
    ("colour −0.1", &["\"ball\"", "colour", "(0, -0.1, 0)"], |w| {
        edit::<Matte>(w, "ball", |m| m.colour = Rgb::new(0.0, -0.1, 0.0));
    }),
    ("intensity −1", &["\"lamp\"", "intensity", "(0, 0, -1)"], |w| {
        edit::<PointLight>(w, "lamp", |l| l.intensity = Rgb::new(0.0, 0.0, -1.0));
    }),
    ("intensity 1e300", &["\"lamp\"", "intensity", "1e300"], |w| {
        edit::<PointLight>(w, "lamp", |l| l.intensity = Rgb::grey(1e300));
    }),
    ("background −1", &["\"sky\"", "colour", "(-1, 0, 0)"], |w| {
        edit::<Background>(w, "sky", |b| b.colour = Rgb::new(-1.0, 0.0, 0.0));
    }),
    ("two backgrounds", &["background", "\"sky\"", "(unnamed, entity "], |w| {
        w.spawn(Background::default());
    }),
    ("a spare colour of 2", &["\"spare\"", "colour", "(2, 2, 2)"], |w| {
        w.spawn((Name::new("spare"), Matte { colour: Rgb::grey(2.0) }));
    }),
];

const ORTHOGRAPHIC: &[Case] = &[
    ("view_height 0", &["\"main\"", "view_height", "is 0,"], |w| {
        edit::<OrthographicCamera>(w, "main", |c| c.view_height = 0.0);
    }),
    ("view_height −1", &["\"main\"", "view_height", "is -1,"], |w| {
        edit::<OrthographicCamera>(w, "main", |c| c.view_height = -1.0);
    }),
];

/// A field of a component, the entity, how to set it.
type Field = (&'static str, &'static str, fn(&mut World, f64));

/// Every number that an author writes.
const FIELDS: &[Field] = &[
    ("fov", "main", |w, v| edit::<PerspectiveCamera>(w, "main", |c| c.fov = Degrees(v))),
    ("eye", "main", |w, v| look_at(w, LookAt { eye: DVec3::new(v, 0.0, 1.0), ..LookAt::default() })),
    ("eye", "main", |w, v| look_at(w, LookAt { eye: DVec3::new(0.0, v, 1.0), ..LookAt::default() })),
    ("eye", "main", |w, v| look_at(w, LookAt { eye: DVec3::new(0.0, 1.0, v), ..LookAt::default() })),
    ("target", "main", |w, v| look_at(w, LookAt { target: DVec3::new(v, 0.0, 1.0), ..LookAt::default() })),
    ("target", "main", |w, v| look_at(w, LookAt { target: DVec3::new(0.0, v, 1.0), ..LookAt::default() })),
    ("target", "main", |w, v| look_at(w, LookAt { target: DVec3::new(0.0, 1.0, v), ..LookAt::default() })),
    ("up", "main", |w, v| look_at(w, LookAt { up: DVec3::new(v, 1.0, 0.0), ..LookAt::default() })),
    ("up", "main", |w, v| look_at(w, LookAt { up: DVec3::new(0.0, v, 0.0), ..LookAt::default() })),
    ("up", "main", |w, v| look_at(w, LookAt { up: DVec3::new(0.0, 1.0, v), ..LookAt::default() })),
    ("position", "main", |w, v| edit::<Placement>(w, "main", |p| p.position.x = v)),
    ("orientation", "main", |w, v| edit::<Placement>(w, "main", |p| p.orientation.x = v)),
    ("orientation", "main", |w, v| edit::<Placement>(w, "main", |p| p.orientation.y = v)),
    ("orientation", "main", |w, v| edit::<Placement>(w, "main", |p| p.orientation.z = v)),
    ("orientation", "main", |w, v| edit::<Placement>(w, "main", |p| p.orientation.w = v)),
    ("scale", "main", |w, v| edit::<Placement>(w, "main", |p| p.scale.x = v)),
    ("position", "ball", |w, v| edit::<Placement>(w, "ball", |p| p.position.x = v)),
    ("position", "ball", |w, v| edit::<Placement>(w, "ball", |p| p.position.y = v)),
    ("position", "ball", |w, v| edit::<Placement>(w, "ball", |p| p.position.z = v)),
    ("scale", "ball", |w, v| edit::<Placement>(w, "ball", |p| p.scale.x = v)),
    ("scale", "ball", |w, v| edit::<Placement>(w, "ball", |p| p.scale.y = v)),
    ("scale", "ball", |w, v| edit::<Placement>(w, "ball", |p| p.scale.z = v)),
    ("radius", "ball", |w, v| edit::<Sphere>(w, "ball", |s| s.radius = v)),
    ("colour", "ball", |w, v| edit::<Matte>(w, "ball", |m| m.colour.r = v)),
    ("colour", "ball", |w, v| edit::<Matte>(w, "ball", |m| m.colour.g = v)),
    ("colour", "ball", |w, v| edit::<Matte>(w, "ball", |m| m.colour.b = v)),
    ("position", "floor", |w, v| edit::<Placement>(w, "floor", |p| p.position.y = v)),
    ("orientation", "floor", |w, v| edit::<Placement>(w, "floor", |p| p.orientation.w = v)),
    ("normal", "floor", |w, v| edit::<Plane>(w, "floor", |p| p.normal.x = v)),
    ("normal", "floor", |w, v| edit::<Plane>(w, "floor", |p| p.normal.y = v)),
    ("normal", "floor", |w, v| edit::<Plane>(w, "floor", |p| p.normal.z = v)),
    ("position", "lamp", |w, v| edit::<Placement>(w, "lamp", |p| p.position.z = v)),
    ("orientation", "lamp", |w, v| edit::<Placement>(w, "lamp", |p| p.orientation.w = v)),
    ("intensity", "lamp", |w, v| edit::<PointLight>(w, "lamp", |l| l.intensity.r = v)),
    ("intensity", "lamp", |w, v| edit::<PointLight>(w, "lamp", |l| l.intensity.g = v)),
    ("intensity", "lamp", |w, v| edit::<PointLight>(w, "lamp", |l| l.intensity.b = v)),
    ("colour", "sky", |w, v| edit::<Background>(w, "sky", |b| b.colour.r = v)),
    ("colour", "sky", |w, v| edit::<Background>(w, "sky", |b| b.colour.g = v)),
    ("colour", "sky", |w, v| edit::<Background>(w, "sky", |b| b.colour.b = v)),
];

/// What preparing a scene is refused with.
fn refusal(scene: &World, what: &str) -> String {
    match prepare(scene, &offer()) {
        Err(error) => sentence(&error, what),
        Ok(_) => panic!("{what} is not refused"),
    }
}

/// A message, which must be one sentence on one line, without a full stop and without a number nobody can read.
fn sentence(error: &dyn Display, what: &str) -> String {
    let message = error.to_string();
    assert!(!message.contains('\n'), "{what}: more than one line: {message}");
    assert!(!message.contains(". ") && !message.ends_with('.'), "{what}: more than one sentence: {message}");
    assert!(message.chars().count() <= 400, "{what}: {} letters: {message}", message.chars().count());
    assert!(!message.contains("000000000000"), "{what}: a number without an exponent: {message}");
    message
}

fn kept(name: &str, lines: &[String]) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(name, lines.join("\n")));
}

#[test]
fn bad_scenes() {
    let mut lines = Vec::new();
    let groups = [
        (Eye::Perspective, CAMERAS),
        (Eye::Perspective, SHAPES),
        (Eye::Perspective, MATTER),
        (Eye::Orthographic, ORTHOGRAPHIC),
    ];
    for (eye, cases) in groups {
        prepare(&good(eye), &offer()).map(|_| ()).expect("the good scene is good");
        for (what, words, spoil) in cases {
            let mut scene = good(eye);
            spoil(&mut scene);
            let message = refusal(&scene, what);
            for word in *words {
                assert!(message.contains(word), "{what}: no {word} in: {message}");
            }
            lines.push(format!("{what:<34} {message}"));
        }
    }
    kept("bad_scenes", &lines);
    eprintln!("bad scenes: {} refused", lines.len());
}

#[test]
fn bad_numbers() {
    let mut lines = Vec::new();
    let height: Field = ("view_height", "main", |w, v| edit::<OrthographicCamera>(w, "main", |c| c.view_height = v));
    let fields = FIELDS.iter().map(|field| (Eye::Perspective, field)).chain([(Eye::Orthographic, &height)]);
    for (eye, (field, name, set)) in fields {
        for (value, shown) in [(f64::NAN, "NaN"), (f64::INFINITY, "inf"), (f64::NEG_INFINITY, "-inf")] {
            let mut scene = good(eye);
            set(&mut scene, value);
            let what = format!("{field} of \"{name}\" {shown}");
            let message = refusal(&scene, &what);
            for word in [&format!("\"{name}\": "), &format!("{field} is "), shown] {
                assert!(message.contains(word), "{what}: no {word} in: {message}");
            }
            lines.push(message);
        }
    }
    kept("bad_numbers", &lines);
    eprintln!("bad numbers: {} fields × NaN, ∞, −∞, all refused by name", lines.len() / 3);
}

/// Refusing must not go so far as to refuse what works.
#[test]
fn scenes_at_the_edge_are_accepted() {
    type Edge = (&'static str, fn(&mut World));
    let edges: [Edge; 14] = [
        ("fov 179.99", |w| edit::<PerspectiveCamera>(w, "main", |c| c.fov = Degrees(179.99))),
        ("fov 0.01", |w| edit::<PerspectiveCamera>(w, "main", |c| c.fov = Degrees(0.01))),
        ("1 × 1", |w| put(w, "main", Resolution { width: 1, height: 1 })),
        ("a turned parent of the camera", |w| {
            let orientation = DQuat::from_xyzw(0.5, 0.5, 0.5, 0.5);
            let parent = w.spawn(Placement { orientation, ..Placement::default() }).id();
            child_of(w, "main", parent);
        }),
        ("a far camera", |w| edit::<Placement>(w, "main", |p| p.position = DVec3::splat(1e17))),
        ("radius 1e17", |w| edit::<Sphere>(w, "ball", |s| s.radius = 1e17)),
        ("radius 1e-17", |w| edit::<Sphere>(w, "ball", |s| s.radius = 1e-17)),
        ("a mirrored sphere", |w| edit::<Placement>(w, "ball", |p| p.scale = DVec3::new(-2.0, 2.0, 2.0))),
        ("a plane stretched unevenly", |w| edit::<Placement>(w, "floor", |p| p.scale = DVec3::new(1.0, 2.0, 3.0))),
        ("a long normal", |w| edit::<Plane>(w, "floor", |p| p.normal = DVec3::new(0.0, 1e300, 1e299))),
        ("black and white", |w| edit::<Matte>(w, "ball", |m| m.colour = Rgb::new(0.0, 1.0, 0.0))),
        ("a light of no light", |w| edit::<PointLight>(w, "lamp", |l| l.intensity = Rgb::BLACK)),
        ("up almost along the view", |w| {
            look_at(w, LookAt { eye: DVec3::new(1e-6, 5.0, 0.0), target: DVec3::ZERO, up: DVec3::Y });
        }),
        ("a long up", |w| look_at(w, LookAt { up: DVec3::new(0.0, 1e300, 0.0), ..LookAt::default() })),
    ];
    for (what, change) in edges {
        let mut scene = good(Eye::Perspective);
        change(&mut scene);
        let film = scenes::film(&scene);
        assert_eq!(film.rejected, 0, "{what}: rejected samples");
    }
    eprintln!("edges: {} scenes accepted, no sample rejected", edges.len());
}

#[test]
fn bad_views_and_pixels() {
    let mut lines = Vec::new();
    let view = |word: &str| {
        let mut scene = good(Eye::Perspective);
        put(&mut scene, "main", View { column: word.into() });
        scene
    };
    let scene = view("colour");
    assert!(matches!(prepare(&scene, &offer()), Err(Error::Plan(PlanError::NoSuchView { .. }))));
    lines.push(refusal(&scene, "an unknown column"));
    for (word, gone) in [("surface", ["ball", "floor"].as_slice()), ("shadow", &["lamp"]), ("light", &["lamp"])] {
        let mut scene = view(word);
        for name in gone {
            put(&mut scene, name, Disabled);
        }
        let message = refusal(&scene, word);
        for name in gone {
            assert!(message.contains(name), "{word}: {name} is disabled, but: {message}");
        }
        lines.push(message);
    }
    for [x, y] in [[16, 0], [0, 9], [u32::MAX, u32::MAX]] {
        let traced = look::trace(&good(Eye::Perspective), &offer(), TracePixel { x, y });
        let message = sentence(&traced.expect_err("outside"), "a pixel outside");
        assert!(message.contains(&format!("{x},{y}")) && message.contains("15,8"), "{message}");
        lines.push(message);
    }
    look::trace(&good(Eye::Perspective), &offer(), TracePixel { x: 15, y: 8 }).expect("the last pixel");
    kept("bad_views", &lines);
    eprintln!("bad views and pixels: {} refused", lines.len());
}

fn typed(words: &[&str]) -> pinhole::Result<String> {
    let words: Vec<String> = words.iter().map(|word| word.to_string()).collect();
    let mut out = Vec::new();
    command::run(&chapters::all(), &words, &mut out)?;
    Ok(String::from_utf8(out).expect("text"))
}

#[test]
fn bad_command_lines() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("file");
    fs::write(&file, "in the way").expect("written");
    fs::create_dir(folder.path().join("folder.png")).expect("made");
    let path = |name: &str| folder.path().join(name).display().to_string();
    let small = ["--size", "8x8", "-q", "-o"];
    let output = |name: &str| [["render", "cover"].as_slice(), &small, &[&path(name)]].concat().join("\u{1f}");
    let lines: Vec<(String, &[&str])> = vec![
        ("render pinhol".into(), &["pinhol", "05_pinhole", "list"]),
        ("render 99".into(), &["99", "list"]),
        ("plan covr".into(), &["covr", "the nearest is cover"]),
        ("trace 04_orthografic --pixel 1,1".into(), &["04_orthographic"]),
        ("rendr cover".into(), &["rendr", "render"]),
        ("nonsense".into(), &["nonsense", "list", "trace"]),
        ("render".into(), &["CHAPTER", "--help"]),
        ("render cover --size 960".into(), &["960", "--size", "960x540"]),
        ("render cover --size 960x".into(), &["960x", "--size", "960x540"]),
        ("render cover --size -1x5".into(), &["-1x5", "--size"]),
        ("render cover --size 1.5x5".into(), &["1.5x5", "--size"]),
        ("render cover --size 0x5".into(), &["0 × 5", "resolution"]),
        ("render cover --size 99999999999x5".into(), &["99999999999x5", "--size"]),
        ("trace cover --pixel 5".into(), &["5", "--pixel", "48,27"]),
        ("trace cover --pixel a,b".into(), &["a,b", "--pixel"]),
        ("trace cover".into(), &["--pixel"]),
        ("trace cover --size 8x8 --pixel 8,8".into(), &["8,8", "7,7"]),
        ("render cover --threads 0".into(), &["0", "--threads", "1"]),
        ("render cover --threads -3".into(), &["-3", "--threads", "1"]),
        ("render cover --threads many".into(), &["many", "--threads", "1 to 1024"]),
        ("render cover --view colours --size 8x8".into(), &["colours", "raster"]),
        ("render cover --stats --quiet".into(), &["--stats", "--quiet"]),
        ("render cover --sizes 8x8".into(), &["--sizes", "--size"]),
        (output("picture.jpg"), &["picture.jpg", ".png", ".exr"]),
        (output("picture"), &["picture", ".png", ".exr"]),
        (output("file/picture.png"), &["cannot write", "file/picture.png"]),
        (output("file/below/picture.exr"), &["cannot write", "file/below/picture.exr"]),
        (output("folder.png"), &["cannot write", "folder.png", "folder of that name"]),
    ];
    let mut messages = Vec::new();
    for (line, expected) in &lines {
        let words: Vec<&str> = line.split([' ', '\u{1f}']).collect();
        let shown = words.join(" ").replace(&path(""), "FOLDER/");
        let error = typed(&words).err().unwrap_or_else(|| panic!("`{shown}` is not refused"));
        let message = sentence(&error, &shown);
        for word in *expected {
            assert!(message.contains(word), "`{shown}`: no {word} in: {message}");
        }
        let mut message = message.replace(&path(""), "FOLDER/");
        if let (Error::Write { source, .. }, false) = (&error, shown.contains("folder.png")) {
            message = message.replace(&source.to_string(), "(what the system says)");
        }
        messages.push(format!("`{shown}`: {message}"));
    }
    let left: Vec<String> = names_in(folder.path());
    assert_eq!(left, ["file", "folder.png"], "a refused command leaves nothing");
    assert!(names_in(&folder.path().join("folder.png")).is_empty());
    assert_eq!(fs::read_to_string(&file).expect("still there"), "in the way");
    kept("bad_command_lines", &messages);
    eprintln!("bad command lines: {} refused, nothing written", messages.len());
}

fn names_in(folder: &std::path::Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a readable folder");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// A place that cannot be written to is found out before the picture is made, not after.
#[test]
fn a_bad_place_is_refused_before_the_render() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("file");
    fs::write(&file, "").expect("written");
    let place = file.join("picture.png").display().to_string();
    // The view is refused too, but only when the render begins.
    let error = typed(&["render", "cover", "-q", "--view", "nonsense", "-o", &place]).expect_err("refused");
    assert!(matches!(error, Error::Write { .. }), "{error}");
    let good = folder.path().join("good.png").display().to_string();
    typed(&["render", "cover", "-q", "--view", "nonsense", "-o", &good]).expect_err("refused");
    assert_eq!(names_in(folder.path()), ["file"], "trying a place leaves nothing there");
}

#[test]
fn samples_that_are_no_light_are_counted_and_kept_out() {
    let tile = Tile { x: 32, y: 64, width: 4, height: 3 };
    let mut film = FilmTile::new(tile);
    let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, -f32::MIN_POSITIVE];
    let mut expected = Vec::new();
    for row in 0..tile.rows() {
        film.add(row, [0.25, 0.5, 1.0]);
        for (turn, value) in bad.into_iter().enumerate() {
            let mut radiance = [0.125; 3];
            radiance[(row + turn) % 3] = value;
            expected.push(Rejected { pixel: tile.pixel_of(row), sample: 1, radiance });
            film.add(row, radiance);
        }
        film.add(row, [0.75, 0.5, 0.0]);
        film.add(row, [-0.0, f32::MAX, 1e-45]);
    }
    let rows = tile.rows();
    assert_eq!(film.rejected, (bad.len() * rows) as u64);
    assert!(!film.first_rejected.is_empty());
    for (found, expected) in film.first_rejected.iter().zip(&expected) {
        assert_eq!((found.pixel, found.sample), (expected.pixel, expected.sample));
        assert_eq!(found.radiance.map(f32::to_bits), expected.radiance.map(f32::to_bits), "as it came");
    }
    for row in 0..rows {
        assert_eq!(film.count[row], 3);
        let sums = [1.0, 1.0 + f64::from(f32::MAX), 1.0 + f64::from(1e-45_f32)];
        assert_eq!([film.r[row], film.g[row], film.b[row]], sums, "only what is light is summed");
    }
    let film = Film { width: 4, height: 3, tile_side: 4, tiles: vec![film] };
    assert_eq!(film.rejected().0, (bad.len() * rows) as u64);
    assert_eq!(film.rejected().1[0].pixel, [32, 64], "by the pixel of the image, not of the tile");
    eprintln!("rejected: {} samples of {} kinds in {rows} pixels", bad.len() * rows, bad.len());
}

#[test]
fn many_ones_have_the_mean_one() {
    const SAMPLES: u32 = 1 << 26;
    let mut film = FilmTile::new(Tile { x: 0, y: 0, width: 1, height: 1 });
    for _ in 0..SAMPLES {
        film.add(0, [1.0; 3]);
    }
    assert_eq!((film.r[0], film.count[0], film.mean(0)), (f64::from(SAMPLES), SAMPLES, [1.0; 3]));
    eprintln!("sums: 2^26 × 1.0 has the mean 1.0; in f32 the sum would stop at 2^24");
}

#[test]
fn files_read_back_as_the_film() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for size in [[97, 31], [1, 1], [33, 65]] {
        let scene = full(Setup { size, ..Setup::default() });
        let film = pinhole::render::render(&scene, &offer(), &scenes::one_world(), &()).expect("renders").film;
        let [width, height] = size;
        for curve in [Curve::Srgb, Curve::Straight] {
            let path = folder.path().join("picture.png");
            write_png(&film, curve, &path).expect("written");
            assert_eq!(fs::read(&path).expect("read"), png_bytes(&film, curve).expect("encoded"));
            let image = image::open(&path).expect("a PNG");
            assert_eq!(image.color(), image::ColorType::Rgb8);
            let image = image.into_rgb8();
            assert_eq!(image.dimensions(), (width, height));
            for (x, y, pixel) in image.enumerate_pixels() {
                assert_eq!(pixel.0, film.mean(x, y).map(|part| byte_from_linear(part, curve)), "{x},{y}");
            }
        }
        let path = folder.path().join("picture.exr");
        write_exr(&film, &path).expect("written");
        let layer = read_first_flat_layer_from_file(&path).expect("an EXR").layer_data;
        assert_eq!((layer.size.x(), layer.size.y()), (width as usize, height as usize));
        let names: Vec<String> = layer.channel_data.list.iter().map(|channel| channel.name.to_string()).collect();
        assert_eq!(names, ["B", "G", "R"], "as the format orders them");
        for (channel, part) in layer.channel_data.list.iter().zip([2, 1, 0]) {
            let FlatSamples::F32(values) = &channel.sample_data else { panic!("{} is not f32", channel.name) };
            for (at, value) in values.iter().enumerate() {
                let (x, y) = (at as u32 % width, at as u32 / width);
                assert_eq!(value.to_bits(), film.mean(x, y)[part].to_bits(), "{} of {x},{y}", channel.name);
            }
        }
    }
    eprintln!("files: 3 sizes, PNG by two curves and EXR, every pixel equal to the film");
}
