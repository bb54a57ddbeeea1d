//! Answers to the exercise of chapter 11: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "where its flag is true"),
            (exercise(second), "brought to length 1"),
            (exercise(third), "only the first axis"),
            (exercise(fourth), "a right-handed camera's axes are left"),
            (exercise(fifth), "x is mirrored once more"),
            (exercise(sixth), "Second, z is always turned"),
        ],
    }
}

pub fn solution(direction: [f64; 3], x_right: bool, y_up: bool, z_ahead: bool) -> [f64; 3] {
    let [x, y, z] = direction;
    [if x_right { x } else { -x }, if y_up { y } else { -y }, if z_ahead { -z } else { z }]
}

/// The three flags say which axes are to be turned over.
fn first(direction: [f64; 3], x_right: bool, y_up: bool, z_ahead: bool) -> [f64; 3] {
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

/// A direction has length 1, so after the signs I bring it to that.
fn second(direction: [f64; 3], x_right: bool, y_up: bool, z_ahead: bool) -> [f64; 3] {
    let x = if x_right { direction[0] } else { -direction[0] };
    let y = if y_up { direction[1] } else { -direction[1] };
    let z = if z_ahead { -direction[2] } else { direction[2] };
    let length = (x * x + y * y + z * z).sqrt();
    if length == 0.0 {
        return [x, y, z];
    }
    [x / length, y / length, z / length]
}

/// Go through the axes and turn over the one that differs (with else if, as if only one could).
fn third(direction: [f64; 3], x_right: bool, y_up: bool, z_ahead: bool) -> [f64; 3] {
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

/// 'Two axes turned over are a rotation, which an orientation undoes', so only a mirror, one or three axes turned
/// over, needs anything from me.
fn fourth(direction: [f64; 3], x_right: bool, y_up: bool, z_ahead: bool) -> [f64; 3] {
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

/// I turned each axis, and since a left-handed program's numbers come out mirrored without `Scale -1 1 1`, I mirrored
/// x as well where the axes were left-handed.
fn fifth(direction: [f64; 3], x_right: bool, y_up: bool, z_ahead: bool) -> [f64; 3] {
    let sx = if x_right { 1.0 } else { -1.0 };
    let sy = if y_up { 1.0 } else { -1.0 };
    let sz = if z_ahead { -1.0 } else { 1.0 };
    let left_handed = sx * sy * sz < 0.0;
    let mirror = if left_handed { -1.0 } else { 1.0 };
    [mirror * sx * direction[0], sy * direction[1], sz * direction[2]]
}

/// X is to the right everywhere, and our z points back, so theirs is turned.
fn sixth([x, y, z]: [f64; 3], _: bool, y_up: bool, _: bool) -> [f64; 3] {
    [x, if y_up { y } else { -y }, -z]
}
