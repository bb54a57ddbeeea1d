//! Answers that readers of chapter 11 gave who saw its page and nothing else, and words of the remark that each must get.

use super::question::exercise;
use pinhole_lab::exercise::Exercise;

/// The formula straight from the page.
pub fn textbook() -> Exercise {
    exercise(right)
}

/// What each reader thought, and the answer.
pub fn all() -> Vec<(&'static str, Exercise, &'static str)> {
    vec![
        ("the three flags say which axes are to be turned over", exercise(a), "where its flag is true"),
        (
            "two axes turned over are only a rotation, so nothing is to be done unless the hand differs, and then one axis, x, is mirrored",
            exercise(b),
            "mended by its x alone",
        ),
        (
            "where y is not up, z is, as in Blender, so y and z have to change places with one sign",
            exercise(c),
            "y and z change places",
        ),
        (
            "a camera that looks along +z is turned by half a turn about y, which changes x as well as z",
            exercise(d),
            "given half a turn",
        ),
        ("a direction has length 1, so after the signs I bring it to that", exercise(e), "brought to length 1"),
        (
            "go through the axes and turn over the one that differs (with else if, as if only one could)",
            exercise(f),
            "only the first axis",
        ),
        (
            "'Two axes turned over are a rotation, which an orientation undoes', so only a mirror, one or three axes turned over, needs anything from me.",
            exercise(second_a),
            "a right-handed camera's axes are left",
        ),
        (
            "I turned each axis, and since a left-handed program's numbers come out mirrored without `Scale -1 1 1`, I mirrored x as well where the axes were left-handed.",
            exercise(second_b),
            "x is mirrored once more",
        ),
        (
            "I asked for one difference after the other and wrote `else if`, so that only the first that is found is mended.",
            exercise(second_c),
            "only the first axis that differs is",
        ),
    ]
}

fn right(direction: [f64; 3], x_right: bool, y_up: bool, z_ahead: bool) -> [f64; 3] {
    let [x, y, z] = direction;
    [if x_right { x } else { -x }, if y_up { y } else { -y }, if z_ahead { -z } else { z }]
}

fn a(direction: [f64; 3], x_right: bool, y_up: bool, z_ahead: bool) -> [f64; 3] {
    let mut d = direction;
    if x_right {
        d[0] = -d[0];
    }
    if y_up {
        d[1] = -d[1];
    }
    if z_ahead {
        d[2] = -d[2];
    }
    d
}

fn b(direction: [f64; 3], x_right: bool, y_up: bool, z_ahead: bool) -> [f64; 3] {
    let mut turned = 0;
    if !x_right {
        turned += 1;
    }
    if !y_up {
        turned += 1;
    }
    if z_ahead {
        turned += 1;
    }
    if turned % 2 == 1 { [-direction[0], direction[1], direction[2]] } else { direction }
}

fn c(direction: [f64; 3], x_right: bool, y_up: bool, z_ahead: bool) -> [f64; 3] {
    let mut x = direction[0];
    let mut y = direction[1];
    let mut z = direction[2];
    if !x_right {
        x = -x;
    }
    if z_ahead {
        z = -z;
    }
    if !y_up {
        (y, z) = (z, -y);
    }
    [x, y, z]
}

fn d(direction: [f64; 3], x_right: bool, y_up: bool, z_ahead: bool) -> [f64; 3] {
    let [mut x, mut y, mut z] = direction;
    if !x_right {
        x = -x;
    }
    if !y_up {
        y = -y;
    }
    if z_ahead {
        x = -x;
        z = -z;
    }
    [x, y, z]
}

fn e(direction: [f64; 3], x_right: bool, y_up: bool, z_ahead: bool) -> [f64; 3] {
    let x = if x_right { direction[0] } else { -direction[0] };
    let y = if y_up { direction[1] } else { -direction[1] };
    let z = if z_ahead { -direction[2] } else { direction[2] };
    let length = (x * x + y * y + z * z).sqrt();
    if length == 0.0 {
        return [x, y, z];
    }
    [x / length, y / length, z / length]
}

fn f(direction: [f64; 3], x_right: bool, y_up: bool, z_ahead: bool) -> [f64; 3] {
    let [x, y, z] = direction;
    if !x_right {
        [-x, y, z]
    } else if !y_up {
        [x, -y, z]
    } else if z_ahead {
        [x, y, -z]
    } else {
        [x, y, z]
    }
}

fn second_a(direction: [f64; 3], x_right: bool, y_up: bool, z_ahead: bool) -> [f64; 3] {
    let turned = [!x_right, !y_up, z_ahead];
    let count = turned.iter().filter(|over| **over).count();
    if count % 2 == 0 {
        return direction;
    }
    let mut answer = direction;
    for k in 0..3 {
        if turned[k] {
            answer[k] = -answer[k];
        }
    }
    answer
}

fn second_b(direction: [f64; 3], x_right: bool, y_up: bool, z_ahead: bool) -> [f64; 3] {
    let sx = if x_right { 1.0 } else { -1.0 };
    let sy = if y_up { 1.0 } else { -1.0 };
    let sz = if z_ahead { -1.0 } else { 1.0 };
    let left_handed = sx * sy * sz < 0.0;
    let mirror = if left_handed { -1.0 } else { 1.0 };
    [mirror * sx * direction[0], sy * direction[1], sz * direction[2]]
}

fn second_c(direction: [f64; 3], x_right: bool, y_up: bool, z_ahead: bool) -> [f64; 3] {
    let [x, y, z] = direction;
    if !x_right {
        [-x, y, z]
    } else if !y_up {
        [x, -y, z]
    } else if z_ahead {
        [x, y, -z]
    } else {
        [x, y, z]
    }
}
