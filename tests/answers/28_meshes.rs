//! Answers to the exercise of chapter 28: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "object to world space"),
            (exercise(second), "of length 1"),
            (exercise(third), "moved by the position"),
            (exercise(fourth), "subtracted last"),
            (exercise(fifth), "the turn is to be undone before the"),
            (exercise(sixth), "Second, the direction is of length 1"),
        ],
    }
}

pub fn solution(
    origin: [f64; 3],
    direction: [f64; 3],
    position: [f64; 3],
    axes: [[f64; 3]; 3],
    scale: [f64; 3],
) -> [[f64; 3]; 2] {
    let from_position = [0, 1, 2].map(|part| origin[part] - position[part]);
    // How far a vector goes along each axis, in units of the object's own length there. The direction is not normalised.
    [from_position, direction].map(|vector| [0, 1, 2].map(|axis| dot(axes[axis], vector) / scale[axis]))
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A vector is turned by x X + y Y + z Z, so I do that with the origin and the direction (the inverse of the turn
/// forgotten), then undo the scale.
fn first(
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
        o[i] = (axes[0][i] * p[0] + axes[1][i] * p[1] + axes[2][i] * p[2]) / scale[i];
        r[i] = (axes[0][i] * direction[0] + axes[1][i] * direction[1] + axes[2][i] * direction[2]) / scale[i];
    }
    [o, r]
}

/// A ray's direction has length 1 everywhere else, so I normalise it in object space too.
fn second(
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
    let l = (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]).sqrt();
    [o, [r[0] / l, r[1] / l, r[2] / l]]
}

/// Origin and direction are both vectors, and both are treated alike: subtract the position from either.
fn third(
    origin: [f64; 3],
    direction: [f64; 3],
    position: [f64; 3],
    axes: [[f64; 3]; 3],
    scale: [f64; 3],
) -> [[f64; 3]; 2] {
    let mut result = [[0.0; 3]; 2];
    for (k, vector) in [origin, direction].iter().enumerate() {
        let p = [vector[0] - position[0], vector[1] - position[1], vector[2] - position[2]];
        for i in 0..3 {
            result[k][i] = (axes[i][0] * p[0] + axes[i][1] * p[1] + axes[i][2] * p[2]) / scale[i];
        }
    }
    result
}

/// The inverse of Mx + P is M⁻¹x − P, so the position is subtracted last.
fn fourth(
    origin: [f64; 3],
    direction: [f64; 3],
    position: [f64; 3],
    axes: [[f64; 3]; 3],
    scale: [f64; 3],
) -> [[f64; 3]; 2] {
    let mut o = [0.0; 3];
    let mut r = [0.0; 3];
    for i in 0..3 {
        let x = axes[i];
        o[i] = (x[0] * origin[0] + x[1] * origin[1] + x[2] * origin[2]) / scale[i] - position[i];
        r[i] = (x[0] * direction[0] + x[1] * direction[1] + x[2] * direction[2]) / scale[i];
    }
    [o, r]
}

/// I undid the scale first and the turn afterwards, the order in which they were applied.
fn fifth(
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

/// What the mesh was moved by is added, and a direction has length 1.
fn sixth(
    origin: [f64; 3],
    direction: [f64; 3],
    position: [f64; 3],
    axes: [[f64; 3]; 3],
    scale: [f64; 3],
) -> [[f64; 3]; 2] {
    let part = |v: [f64; 3], axis: usize| v.iter().zip(axes[axis]).map(|(v, a)| v * a).sum::<f64>() / scale[axis];
    let start = [0, 1, 2].map(|axis| origin[axis] + position[axis]);
    let [start, along] = [start, direction].map(|v| [0, 1, 2].map(|axis| part(v, axis)));
    let length = along.iter().map(|part| part * part).sum::<f64>().sqrt();
    [start, along.map(|part| part / length)]
}
