//! Answers to the exercise of chapter 14: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "by its own direction"),
            (exercise(second), "Second, the answer is negative"),
            (exercise(third), "side is that of `geometric`"),
            (exercise(fourth), "from behind, too"),
            (exercise(fifth), "cosines at the corners are mixed"),
            (exercise(sixth), "the weights go with the wrong"),
        ],
    }
}

pub fn solution(
    geometric: [f64; 3],
    normals: [[f64; 3]; 3],
    weights: [f64; 3],
    to_eye: [f64; 3],
    to_light: [f64; 3],
) -> f64 {
    if dot(geometric, to_eye) * dot(geometric, to_light) <= 0.0 {
        return 0.0;
    }
    let mixed = [0, 1, 2].map(|axis| (0..3).map(|corner| weights[corner] * normals[corner][axis]).sum());
    // On the light's side of the surface, which is the eye's.
    let turn = dot(geometric, mixed).signum() * dot(geometric, to_light).signum();
    let cosine = turn * dot(mixed, to_light) / (dot(mixed, mixed) * dot(to_light, to_light)).sqrt();
    cosine.max(0.0)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Both normals must be on the eye's side, so I turn each of them to the eye by its own dot product.
fn first(geometric: [f64; 3], normals: [[f64; 3]; 3], weights: [f64; 3], to_eye: [f64; 3], to_light: [f64; 3]) -> f64 {
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let mut g = geometric;
    if dot(g, to_eye) < 0.0 {
        g = g.map(|part| -part);
    }
    let mut n = [0.0f64; 3];
    for i in 0..3 {
        n[i] = weights[0] * normals[0][i] + weights[1] * normals[1][i] + weights[2] * normals[2][i];
    }
    if dot(n, to_eye) < 0.0 {
        n = n.map(|part| -part);
    }
    let light = dot(to_light, to_light).sqrt();
    if dot(g, to_light) > 0.0 { (dot(n, to_light) / (dot(n, n).sqrt() * light)).max(0.0) } else { 0.0 }
}

/// The mean of unit vectors is one, and where the surface is lit its cosine is what it is.
fn second(geometric: [f64; 3], normals: [[f64; 3]; 3], weights: [f64; 3], to_eye: [f64; 3], to_light: [f64; 3]) -> f64 {
    let mixed = [0, 1, 2].map(|axis| (0..3).map(|corner| weights[corner] * normals[corner][axis]).sum::<f64>());
    let faced = geometric.map(|part| if dot(geometric, to_eye) < 0.0 { -part } else { part });
    let turned = mixed.map(|part| if dot(mixed, faced) < 0.0 { -part } else { part });
    if dot(faced, to_light) > 0.0 { dot(turned, to_light) / dot(to_light, to_light).sqrt() } else { 0.0 }
}

/// The geometric normal says which side is up; the shading normal is turned to it, and light from below counts as
/// none.
fn third(geometric: [f64; 3], normals: [[f64; 3]; 3], weights: [f64; 3], to_eye: [f64; 3], to_light: [f64; 3]) -> f64 {
    let _ = to_eye;
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let mut n = [0.0f64; 3];
    for i in 0..3 {
        n[i] = weights[0] * normals[0][i] + weights[1] * normals[1][i] + weights[2] * normals[2][i];
    }
    let length = dot(n, n).sqrt();
    n = n.map(|part| part / length);
    if dot(n, geometric) < 0.0 {
        n = n.map(|part| -part);
    }
    if dot(geometric, to_light) <= 0.0 {
        return 0.0;
    }
    (dot(n, to_light) / dot(to_light, to_light).sqrt()).max(0.0)
}

/// The corners' normals may be on the wrong side, but then only the sign is wrong, so the absolute value does it.
fn fourth(geometric: [f64; 3], normals: [[f64; 3]; 3], weights: [f64; 3], to_eye: [f64; 3], to_light: [f64; 3]) -> f64 {
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let eye_side = dot(geometric, to_eye);
    let light_side = dot(geometric, to_light);
    if eye_side * light_side <= 0.0 {
        return 0.0;
    }
    let mut n = [0.0f64; 3];
    for i in 0..3 {
        n[i] = weights[0] * normals[0][i] + weights[1] * normals[1][i] + weights[2] * normals[2][i];
    }
    let cosine = dot(n, to_light) / (dot(n, n).sqrt() * dot(to_light, to_light).sqrt());
    cosine.abs()
}

/// The weights interpolate whatever the corners have, so I find the cosine at each corner and take their weighted
/// mean.
fn fifth(geometric: [f64; 3], normals: [[f64; 3]; 3], weights: [f64; 3], to_eye: [f64; 3], to_light: [f64; 3]) -> f64 {
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let mut g = geometric;
    if dot(g, to_eye) < 0.0 {
        g = g.map(|part| -part);
    }
    if dot(g, to_light) <= 0.0 {
        return 0.0;
    }
    let light = dot(to_light, to_light).sqrt();
    let mut sum = 0.0f64;
    for k in 0..3 {
        let side = if dot(normals[k], g) < 0.0 { -1.0 } else { 1.0 };
        sum += weights[k] * (side * dot(normals[k], to_light) / light).max(0.0);
    }
    sum
}

/// The barycentric coordinates are u, v and what is left, so I gave u to the first corner's normal instead of the
/// second's, and the rest to the last.
fn sixth(geometric: [f64; 3], normals: [[f64; 3]; 3], weights: [f64; 3], to_eye: [f64; 3], to_light: [f64; 3]) -> f64 {
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let [rest, u, v] = weights;
    let mut n = [0.0_f64; 3];
    for i in 0..3 {
        n[i] = u * normals[0][i] + v * normals[1][i] + rest * normals[2][i];
    }
    let length = dot(n, n).sqrt();
    let light_length = dot(to_light, to_light).sqrt();
    let side = if dot(geometric, to_eye) < 0.0 { -1.0_f64 } else { 1.0_f64 };
    let same = if dot(geometric, n) < 0.0 { -1.0_f64 } else { 1.0_f64 };
    if side * dot(geometric, to_light) <= 0.0 {
        return 0.0;
    }
    (side * same * dot(n, to_light) / (length * light_length)).max(0.0)
}
