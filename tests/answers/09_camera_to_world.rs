//! Answers to the exercise of chapter 09: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "inverse is not transposed"),
            (exercise(second), "multiplied by the transpose"),
            (exercise(third), "length of each column"),
            (exercise(fourth), "in the wrong order"),
            (exercise(fifth), "the normal is turned to the side of"),
            (exercise(sixth), "Second, the normal is not of length 1"),
        ],
    }
}

pub fn solution(columns: [[f64; 3]; 3], normal: [f64; 3]) -> [f64; 3] {
    let [a, b, c] = columns;
    let (bc, ca, ab) = (cross(b, c), cross(c, a), cross(a, b));
    let sign = (a[0] * bc[0] + a[1] * bc[1] + a[2] * bc[2]).signum();
    let n = [0, 1, 2].map(|i| sign * (normal[0] * bc[i] + normal[1] * ca[i] + normal[2] * ab[i]));
    let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
    n.map(|part| part / length)
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// A normal goes by the inverse instead of the matrix, so I multiply by the inverse.
fn first(columns: [[f64; 3]; 3], normal: [f64; 3]) -> [f64; 3] {
    fn cross(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
        [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
    }
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let [x, y, z] = columns;
    let det = dot(x, cross(y, z));
    // The rows of the inverse are the cross products over the determinant.
    let n = [dot(cross(y, z), normal) / det, dot(cross(z, x), normal) / det, dot(cross(x, y), normal) / det];
    let length = dot(n, n).sqrt();
    n.map(|part| part / length)
}

/// The page says Mᵀ n' = n, so the normal is multiplied by the transpose: a dot product with each column.
fn second(columns: [[f64; 3]; 3], normal: [f64; 3]) -> [f64; 3] {
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let n = [dot(columns[0], normal), dot(columns[1], normal), dot(columns[2], normal)];
    let length = dot(n, n).sqrt();
    [n[0] / length, n[1] / length, n[2] / length]
}

/// A normal is divided by the scale instead of multiplied, and the scale along an axis is the length of its column.
fn third(columns: [[f64; 3]; 3], normal: [f64; 3]) -> [f64; 3] {
    let mut n = [0.0f64; 3];
    for j in 0..3 {
        let c = columns[j];
        let scale_squared = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
        for i in 0..3 {
            // c / scale is the turned axis; divide once more by the scale.
            n[i] += normal[j] * c[i] / scale_squared;
        }
    }
    let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
    n.map(|part| part / length)
}

/// The inverse transpose is made of the cross products of the columns that are left: y × z, x × z, x × y.
fn fourth(columns: [[f64; 3]; 3], normal: [f64; 3]) -> [f64; 3] {
    fn cross(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
        [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
    }
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let [x, y, z] = columns;
    let det = dot(x, cross(y, z));
    let (u, v, w) = (cross(y, z), cross(x, z), cross(x, y));
    let mut n = [0.0f64; 3];
    for i in 0..3 {
        n[i] = (u[i] * normal[0] + v[i] * normal[1] + w[i] * normal[2]) / det;
    }
    let length = dot(n, n).sqrt();
    n.map(|part| part / length)
}

/// I mapped two tangents and took their cross product, and so that it points outward I turned it to the side of the
/// normal that I was given.
fn fifth(columns: [[f64; 3]; 3], normal: [f64; 3]) -> [f64; 3] {
    fn cross(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
        [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
    }
    fn map(m: [[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
        [
            m[0][0] * v[0] + m[1][0] * v[1] + m[2][0] * v[2],
            m[0][1] * v[0] + m[1][1] * v[1] + m[2][1] * v[2],
            m[0][2] * v[0] + m[1][2] * v[1] + m[2][2] * v[2],
        ]
    }
    let other = if normal[0].abs() < 0.8 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
    let first = cross(normal, other);
    let second = cross(normal, first);
    let n = cross(map(columns, first), map(columns, second));
    let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
    let side = n[0] * normal[0] + n[1] * normal[1] + n[2] * normal[2];
    let sign = if side < 0.0 { -1.0_f64 } else { 1.0_f64 };
    [sign * n[0] / length, sign * n[1] / length, sign * n[2] / length]
}

/// A normal is a direction, so it is mapped as one.
fn sixth(columns: [[f64; 3]; 3], normal: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|row| (0..3).map(|column| columns[column][row] * normal[column]).sum())
}
