//! What is refused of lenses, shutters and motion.

use super::cases::{Case, Field, child_of, good, put};
use super::{kept, scene_error};
use crate::scenes::Eye;
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::scene::*;

fn lens(world: &mut World, change: impl FnOnce(&mut Lens)) {
    let mut lens = Lens::default();
    change(&mut lens);
    put(world, "main", lens);
}

fn radius(world: &mut World, radius: f64) {
    lens(world, |lens| lens.aperture = Aperture::Radius { radius });
}

fn f_number(world: &mut World, number: f64, focal_length: f64) {
    lens(world, |lens| lens.aperture = Aperture::FNumber { number, focal_length });
}

const PERSPECTIVE: &[Case] = &[
    ("a focus at 0", &["\"main\"", "focus_distance is 0,", "1e-18"], |w| lens(w, |lens| lens.focus_distance = 0.0)),
    ("a focus behind the eye", &["\"main\"", "focus_distance is -2,"], |w| lens(w, |lens| lens.focus_distance = -2.0)),
    ("a focus too far", &["\"main\"", "focus_distance is 1e30,"], |w| lens(w, |lens| lens.focus_distance = 1e30)),
    ("one blade", &["\"main\"", "blades is 1,", "0 for", "3 to 64"], |w| lens(w, |lens| lens.blades = 1)),
    ("two blades", &["\"main\"", "blades is 2,", "0 for", "3 to 64"], |w| lens(w, |lens| lens.blades = 2)),
    ("65 blades", &["\"main\"", "blades is 65,", "3 to 64"], |w| lens(w, |lens| lens.blades = 65)),
    ("a negative radius", &["\"main\"", "aperture radius is -0.5,", "from 0"], |w| radius(w, -0.5)),
    ("a lens turned too often", &["\"main\"", "turn is 720°", "360°"], |w| {
        lens(w, |lens| lens.turn = Degrees(720.0))
    }),
    ("f/0", &["\"main\"", "aperture number is 0,", "f-number"], |w| f_number(w, 0.0, 0.05)),
    ("f/−2", &["\"main\"", "aperture number is -2,", "f-number"], |w| f_number(w, -2.0, 0.05)),
    ("no focal length", &["\"main\"", "aperture focal_length is 0,"], |w| f_number(w, 2.0, 0.0)),
    ("a lens wider than f32 aims", &["\"main\"", "aperture is of radius 1000000", "rad a pixel", "4e-6"], |w| {
        lens(w, |lens| (lens.aperture, lens.focus_distance) = (Aperture::Radius { radius: 1e6 }, 1e-6));
    }),
    ("a shutter that closes before it opens", &["\"main\"", "close is 0.5", "opens at 1"], |w| shutter(w, 1.0, 0.5)),
    ("a shutter that opens too late", &["\"main\"", "open is 1e10", "1e9"], |w| shutter(w, 1e10, 2e10)),
    ("a shutter on a ball", &["\"ball\"", "shutter is given to no camera"], |w| put(w, "ball", Shutter::default())),
    ("a moving lamp", &["light \"lamp\"", "motion is given", "no light"], |w| moves(w, "lamp")),
    ("a moving sun in a moving group", &["light \"sun\"", "motion is given"], |w| {
        let group = w.spawn((Name::new("group"), Placement::default())).id();
        child_of(w, "sun", group);
        moves(w, "group");
    }),
    ("a moving texture", &["shape \"ball\"", "motion is given to one with a texture"], |w| {
        put(w, "ball", Checker::default());
        moves(w, "ball");
    }),
    ("triangles of one glass that move apart", &["\"side 1\"", "motion is", "move alike"], |w| {
        tetrahedron(w, 4, |side| side == 1);
    }),
    ("moving glass that is open", &["\"side 0\"", "material is the glass", "an edge"], |w| tetrahedron(w, 3, |_| true)),
    ("a lens on a ball", &["\"ball\"", "lens is given to no camera", "PerspectiveCamera"], |w| {
        put(w, "ball", Lens::default());
    }),
];

fn shutter(world: &mut World, open: f64, close: f64) {
    put(world, "main", Shutter { open, close });
}

fn moves(world: &mut World, name: &str) {
    velocity(world, name, DVec3::X);
    shutter(world, 0.0, 1.0);
}

/// The first sides of a tetrahedron of glass, of which some move.
fn tetrahedron(world: &mut World, sides: usize, moves: impl Fn(usize) -> bool) {
    let [a, b, c, d] =
        [DVec3::ONE, DVec3::new(1.0, -1.0, -1.0), DVec3::new(-1.0, 1.0, -1.0), DVec3::new(-1.0, -1.0, 1.0)];
    let glass = world.spawn(Glass::default()).id();
    for (side, vertices) in [[a, b, c], [a, d, b], [a, c, d], [b, d, c]].into_iter().take(sides).enumerate() {
        let triangle = Triangle { vertices, ..Triangle::default() };
        let side_name = Name::new(format!("side {side}"));
        let velocity = if moves(side) { DVec3::X } else { DVec3::ZERO };
        world.spawn((side_name, triangle, UsesMaterial(glass), Motion { velocity }));
    }
    shutter(world, 0.0, 1.0);
}

fn velocity(world: &mut World, name: &str, velocity: DVec3) {
    put(world, name, Motion { velocity });
}

const ORTHOGRAPHIC: &[Case] =
    &[("a lens on parallel rays", &["\"main\"", "lens is given to", "PerspectiveCamera"], |w| {
        put(w, "main", Lens::default());
    })];

const NUMBERS: &[Field] = &[
    ("focus_distance", "main", |w, v| lens(w, |lens| lens.focus_distance = v)),
    ("open", "main", |w, v| shutter(w, v, v + 1.0)),
    ("close", "main", |w, v| shutter(w, 0.0, v)),
    ("velocity", "ball", |w, v| velocity(w, "ball", DVec3::new(0.0, v, 0.0))),
    ("velocity", "main", |w, v| velocity(w, "main", DVec3::new(v, 0.0, 0.0))),
    ("turn", "main", |w, v| lens(w, |lens| lens.turn = Degrees(v))),
    ("aperture radius", "main", radius),
    ("aperture number", "main", |w, v| f_number(w, v, 0.05)),
    ("aperture focal_length", "main", |w, v| f_number(w, 2.0, v)),
];

#[test]
fn bad_cameras() {
    let mut lines = Vec::new();
    for (eye, cases) in [(Eye::Perspective, PERSPECTIVE), (Eye::Orthographic, ORTHOGRAPHIC)] {
        for (what, words, spoil) in cases {
            let mut scene = good(eye);
            spoil(&mut scene);
            let message = scene_error(&scene, what);
            for word in *words {
                assert!(message.contains(word), "{what}: no {word} in: {message}");
            }
            lines.push(format!("{what:<34} {message}"));
        }
    }
    for (field, name, set) in NUMBERS {
        for (value, shown) in [(f64::NAN, "NaN"), (f64::INFINITY, "inf"), (f64::NEG_INFINITY, "-inf")] {
            let mut scene = good(Eye::Perspective);
            set(&mut scene, value);
            let what = format!("{field} of \"{name}\" {shown}");
            let message = scene_error(&scene, &what);
            for word in [&format!("\"{name}\": "), &format!("{field} is "), shown] {
                assert!(message.contains(word), "{what}: no {word} in: {message}");
            }
            lines.push(message);
        }
    }
    kept("bad_cameras", &lines);
    eprintln!("bad cameras: {} refused", lines.len());
}
