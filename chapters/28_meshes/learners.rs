//! Answers that readers of chapter 28 gave who saw its page and nothing else, and words of the remark that each must get.

use super::question::exercise;
use pinhole_lab::exercise::Exercise;

/// The formula straight from the page.
pub fn textbook() -> Exercise {
    exercise(right)
}

/// What each reader thought, and the answer.
pub fn all() -> Vec<(&'static str, Exercise, &'static str)> {
    vec![
        (
            "a vector is turned by x X + y Y + z Z, so I do that with the origin and the direction (the inverse of the turn forgotten), then undo the scale",
            exercise(a),
            "object to world space",
        ),
        (
            "a ray's direction has length 1 everywhere else, so I normalise it in object space too",
            exercise(b),
            "of length 1",
        ),
        (
            "origin and direction are both vectors, and both are treated alike: subtract the position from either",
            exercise(c),
            "moved by the position",
        ),
        (
            "undo the scale first and then the turn, in the order in which they were done",
            exercise(d),
            "undone before the scale",
        ),
        (
            "a direction has no size, so it is only turned; place and scale concern the origin alone",
            exercise(e),
            "not divided by the scale",
        ),
        ("the inverse of Mx + P is M⁻¹x − P, so the position is subtracted last", exercise(f), "subtracted last"),
        (
            "The axes are the columns of the matrix, so I multiplied by it as usual: x times the first axis plus y times the second plus z times the third.",
            exercise(second_a),
            "object to world space",
        ),
        (
            "I undid the scale first and the turn afterwards, the order in which they were applied.",
            exercise(second_b),
            "the turn is to be undone before the",
        ),
        (
            "Turn and scale the ray by the inverse matrix, and at the end take the position away from the origin.",
            exercise(second_c),
            "the position is subtracted last; it",
        ),
    ]
}

fn right(
    origin: [f64; 3],
    direction: [f64; 3],
    position: [f64; 3],
    axes: [[f64; 3]; 3],
    scale: [f64; 3],
) -> [[f64; 3]; 2] {
    let p = [origin[0] - position[0], origin[1] - position[1], origin[2] - position[2]];
    let mut o = [0.0; 3];
    let mut r = [0.0; 3];
    for i in 0..3 {
        let x = axes[i];
        o[i] = (x[0] * p[0] + x[1] * p[1] + x[2] * p[2]) / scale[i];
        r[i] = (x[0] * direction[0] + x[1] * direction[1] + x[2] * direction[2]) / scale[i];
    }
    [o, r]
}

fn a(origin: [f64; 3], direction: [f64; 3], position: [f64; 3], axes: [[f64; 3]; 3], scale: [f64; 3]) -> [[f64; 3]; 2] {
    let p = [origin[0] - position[0], origin[1] - position[1], origin[2] - position[2]];
    let mut o = [0.0; 3];
    let mut r = [0.0; 3];
    for i in 0..3 {
        o[i] = (axes[0][i] * p[0] + axes[1][i] * p[1] + axes[2][i] * p[2]) / scale[i];
        r[i] = (axes[0][i] * direction[0] + axes[1][i] * direction[1] + axes[2][i] * direction[2]) / scale[i];
    }
    [o, r]
}

fn b(origin: [f64; 3], direction: [f64; 3], position: [f64; 3], axes: [[f64; 3]; 3], scale: [f64; 3]) -> [[f64; 3]; 2] {
    let p = [origin[0] - position[0], origin[1] - position[1], origin[2] - position[2]];
    let mut o = [0.0; 3];
    let mut r = [0.0; 3];
    for i in 0..3 {
        let x = axes[i];
        o[i] = (x[0] * p[0] + x[1] * p[1] + x[2] * p[2]) / scale[i];
        r[i] = (x[0] * direction[0] + x[1] * direction[1] + x[2] * direction[2]) / scale[i];
    }
    let l = (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]).sqrt();
    [o, [r[0] / l, r[1] / l, r[2] / l]]
}

fn c(origin: [f64; 3], direction: [f64; 3], position: [f64; 3], axes: [[f64; 3]; 3], scale: [f64; 3]) -> [[f64; 3]; 2] {
    let mut result = [[0.0; 3]; 2];
    for (k, vector) in [origin, direction].iter().enumerate() {
        let p = [vector[0] - position[0], vector[1] - position[1], vector[2] - position[2]];
        for i in 0..3 {
            result[k][i] = (axes[i][0] * p[0] + axes[i][1] * p[1] + axes[i][2] * p[2]) / scale[i];
        }
    }
    result
}

fn d(origin: [f64; 3], direction: [f64; 3], position: [f64; 3], axes: [[f64; 3]; 3], scale: [f64; 3]) -> [[f64; 3]; 2] {
    let p = [
        (origin[0] - position[0]) / scale[0],
        (origin[1] - position[1]) / scale[1],
        (origin[2] - position[2]) / scale[2],
    ];
    let q = [direction[0] / scale[0], direction[1] / scale[1], direction[2] / scale[2]];
    let mut o = [0.0; 3];
    let mut r = [0.0; 3];
    for i in 0..3 {
        o[i] = axes[i][0] * p[0] + axes[i][1] * p[1] + axes[i][2] * p[2];
        r[i] = axes[i][0] * q[0] + axes[i][1] * q[1] + axes[i][2] * q[2];
    }
    [o, r]
}

fn e(origin: [f64; 3], direction: [f64; 3], position: [f64; 3], axes: [[f64; 3]; 3], scale: [f64; 3]) -> [[f64; 3]; 2] {
    let p = [origin[0] - position[0], origin[1] - position[1], origin[2] - position[2]];
    let mut o = [0.0; 3];
    let mut r = [0.0; 3];
    for i in 0..3 {
        let x = axes[i];
        o[i] = (x[0] * p[0] + x[1] * p[1] + x[2] * p[2]) / scale[i];
        r[i] = x[0] * direction[0] + x[1] * direction[1] + x[2] * direction[2];
    }
    [o, r]
}

fn f(origin: [f64; 3], direction: [f64; 3], position: [f64; 3], axes: [[f64; 3]; 3], scale: [f64; 3]) -> [[f64; 3]; 2] {
    let mut o = [0.0; 3];
    let mut r = [0.0; 3];
    for i in 0..3 {
        let x = axes[i];
        o[i] = (x[0] * origin[0] + x[1] * origin[1] + x[2] * origin[2]) / scale[i] - position[i];
        r[i] = (x[0] * direction[0] + x[1] * direction[1] + x[2] * direction[2]) / scale[i];
    }
    [o, r]
}

fn second_a(
    origin: [f64; 3],
    direction: [f64; 3],
    position: [f64; 3],
    axes: [[f64; 3]; 3],
    scale: [f64; 3],
) -> [[f64; 3]; 2] {
    let o = [origin[0] - position[0], origin[1] - position[1], origin[2] - position[2]];
    let mut result = [[0.0; 3]; 2];
    for i in 0..3 {
        let turned_origin = axes[0][i] * o[0] + axes[1][i] * o[1] + axes[2][i] * o[2];
        let turned_direction = axes[0][i] * direction[0] + axes[1][i] * direction[1] + axes[2][i] * direction[2];
        result[0][i] = turned_origin / scale[i];
        result[1][i] = turned_direction / scale[i];
    }
    result
}

fn second_b(
    origin: [f64; 3],
    direction: [f64; 3],
    position: [f64; 3],
    axes: [[f64; 3]; 3],
    scale: [f64; 3],
) -> [[f64; 3]; 2] {
    let mut o = [0.0; 3];
    let mut d = [0.0; 3];
    for i in 0..3 {
        o[i] = (origin[i] - position[i]) / scale[i];
        d[i] = direction[i] / scale[i];
    }
    let mut result = [[0.0; 3]; 2];
    for i in 0..3 {
        result[0][i] = axes[i][0] * o[0] + axes[i][1] * o[1] + axes[i][2] * o[2];
        result[1][i] = axes[i][0] * d[0] + axes[i][1] * d[1] + axes[i][2] * d[2];
    }
    result
}

fn second_c(
    origin: [f64; 3],
    direction: [f64; 3],
    position: [f64; 3],
    axes: [[f64; 3]; 3],
    scale: [f64; 3],
) -> [[f64; 3]; 2] {
    let mut result = [[0.0; 3]; 2];
    for i in 0..3 {
        let axis = axes[i];
        result[0][i] = (axis[0] * origin[0] + axis[1] * origin[1] + axis[2] * origin[2]) / scale[i] - position[i];
        result[1][i] = (axis[0] * direction[0] + axis[1] * direction[1] + axis[2] * direction[2]) / scale[i];
    }
    result
}
