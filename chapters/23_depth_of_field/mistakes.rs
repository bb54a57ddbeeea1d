//! Typical wrong solutions of chapter 23, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::lens_direction;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(lens_direction)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|s, t, _, f| lens_direction(s, t, [0.0; 2], f)), "the pinhole's"),
        (exercise(a_sphere_in_focus), "along the ray"),
        (exercise(|s, t, l, _| lens_direction(s, t, l, 1.0)), "distance 1"),
        (exercise(|s, t, [x, y], f| lens_direction(s, t, [-x, -y], f)), "is added"),
        (exercise(|s, _, l, f| lens_direction(s, 1.0, l, f)), "tangent is left out"),
        (exercise(not_of_length_1), "length 1"),
    ]
}

fn a_sphere_in_focus(screen: [f64; 2], tangent: f64, lens: [f64; 2], focus: f64) -> [f64; 3] {
    let longer = (1.0 + tangent * tangent * (screen[0] * screen[0] + screen[1] * screen[1])).sqrt();
    lens_direction(screen, tangent, lens, focus / longer)
}

fn not_of_length_1(screen: [f64; 2], tangent: f64, lens: [f64; 2], focus: f64) -> [f64; 3] {
    [screen[0] * tangent * focus - lens[0], screen[1] * tangent * focus - lens[1], -focus]
}
