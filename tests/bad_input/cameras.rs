//! What a camera carries that is refused: lenses.

use super::cases::{Case, Field, good, put};
use super::{kept, refusal};
use crate::scenes::Eye;
use bevy_ecs::prelude::*;
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
    ("a lens on a ball", &["\"ball\"", "lens is given to no camera", "PerspectiveCamera"], |w| {
        put(w, "ball", Lens::default());
    }),
];

const ORTHOGRAPHIC: &[Case] =
    &[("a lens on parallel rays", &["\"main\"", "lens is given to", "PerspectiveCamera"], |w| {
        put(w, "main", Lens::default());
    })];

const NUMBERS: &[Field] = &[
    ("focus_distance", "main", |w, v| lens(w, |lens| lens.focus_distance = v)),
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
            let message = refusal(&scene, what);
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
            let message = refusal(&scene, &what);
            for word in [&format!("\"{name}\": "), &format!("{field} is "), shown] {
                assert!(message.contains(word), "{what}: no {word} in: {message}");
            }
            lines.push(message);
        }
    }
    kept("bad_cameras", &lines);
    eprintln!("bad cameras: {} refused", lines.len());
}
