//! Answers that readers of chapter 09 gave who saw its page and nothing else, and words of the remark that each must get.

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
            "a normal goes by the inverse instead of the matrix, so I multiply by the inverse",
            exercise(a),
            "inverse is not transposed",
        ),
        (
            "the page says Mᵀ n' = n, so the normal is multiplied by the transpose: a dot product with each column",
            exercise(b),
            "multiplied by the transpose",
        ),
        (
            "the determinant only changes the length, and that is made 1 anyway, so I leave it out",
            exercise(c),
            "sign of the determinant",
        ),
        (
            "a normal is divided by the scale instead of multiplied, and the scale along an axis is the length of its column",
            exercise(d),
            "length of each column",
        ),
        (
            "the inverse transpose is made of the cross products of the columns that are left: y × z, x × z, x × y",
            exercise(e),
            "in the wrong order",
        ),
        (
            "a mirror can turn the normal inward, so I compare it with the old normal, which points outward, and turn it to that side",
            exercise(f),
            "side of the old one",
        ),
        (
            "I mapped two tangents and took their cross product, and so that it points outward I turned it to the side of the normal that I was given.",
            exercise(second_a),
            "the normal is turned to the side of",
        ),
        (
            "A normal is turned like a direction but divided by the scale instead of multiplied; the scales are the lengths of the columns, so each column is divided by its squared length.",
            exercise(second_b),
            "the normal is divided by the length",
        ),
        (
            "The page says that Mᵀ goes with the normal, and I read 'Mᵀ n′ = n' as n′ = Mᵀ n.",
            exercise(second_c),
            "the normal is multiplied by the",
        ),
    ]
}

fn right(columns: [[f64; 3]; 3], normal: [f64; 3]) -> [f64; 3] {
    fn cross(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
        [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
    }
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let [x, y, z] = columns;
    let det = dot(x, cross(y, z));
    let (u, v, w) = (cross(y, z), cross(z, x), cross(x, y));
    let mut n = [0.0f64; 3];
    for i in 0..3 {
        n[i] = (u[i] * normal[0] + v[i] * normal[1] + w[i] * normal[2]) / det;
    }
    let length = dot(n, n).sqrt();
    n.map(|part| part / length)
}

fn a(columns: [[f64; 3]; 3], normal: [f64; 3]) -> [f64; 3] {
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

fn b(columns: [[f64; 3]; 3], normal: [f64; 3]) -> [f64; 3] {
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let n = [dot(columns[0], normal), dot(columns[1], normal), dot(columns[2], normal)];
    let length = dot(n, n).sqrt();
    [n[0] / length, n[1] / length, n[2] / length]
}

fn c(columns: [[f64; 3]; 3], normal: [f64; 3]) -> [f64; 3] {
    fn cross(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
        [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
    }
    let [x, y, z] = columns;
    let (u, v, w) = (cross(y, z), cross(z, x), cross(x, y));
    let mut n = [0.0f64; 3];
    for i in 0..3 {
        n[i] = u[i] * normal[0] + v[i] * normal[1] + w[i] * normal[2];
    }
    let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
    n.map(|part| part / length)
}

fn d(columns: [[f64; 3]; 3], normal: [f64; 3]) -> [f64; 3] {
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

fn e(columns: [[f64; 3]; 3], normal: [f64; 3]) -> [f64; 3] {
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

fn f(columns: [[f64; 3]; 3], normal: [f64; 3]) -> [f64; 3] {
    fn cross(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
        [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
    }
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let [x, y, z] = columns;
    let (u, v, w) = (cross(y, z), cross(z, x), cross(x, y));
    let mut n = [0.0f64; 3];
    for i in 0..3 {
        n[i] = u[i] * normal[0] + v[i] * normal[1] + w[i] * normal[2];
    }
    let length = dot(n, n).sqrt();
    let n = n.map(|part| part / length);
    if dot(n, normal) < 0.0 { n.map(|part| -part) } else { n }
}

fn second_a(columns: [[f64; 3]; 3], normal: [f64; 3]) -> [f64; 3] {
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

fn second_b(columns: [[f64; 3]; 3], normal: [f64; 3]) -> [f64; 3] {
    let mut n = [0.0_f64; 3];
    for k in 0..3 {
        let column = columns[k];
        let square = column[0] * column[0] + column[1] * column[1] + column[2] * column[2];
        for i in 0..3 {
            n[i] += normal[k] * column[i] / square;
        }
    }
    let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
    [n[0] / length, n[1] / length, n[2] / length]
}

fn second_c(columns: [[f64; 3]; 3], normal: [f64; 3]) -> [f64; 3] {
    let mut n = [0.0_f64; 3];
    for k in 0..3 {
        let column = columns[k];
        n[k] = column[0] * normal[0] + column[1] * normal[1] + column[2] * normal[2];
    }
    let length: f64 = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
    [n[0] / length, n[1] / length, n[2] / length]
}
