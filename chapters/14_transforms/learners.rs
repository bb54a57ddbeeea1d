//! Answers that readers of chapter 14 gave who saw its page and nothing else, and words of the remark that each must get.

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
            "both normals must be on the eye's side, so I turn each of them to the eye by its own dot product",
            exercise(a),
            "by its own direction",
        ),
        (
            "the weights are together 1 and the normals have length 1, so their mean has length 1 too",
            exercise(b),
            "mixed normal is not brought to length 1",
        ),
        (
            "the geometric normal says which side is up; the shading normal is turned to it, and light from below counts as none",
            exercise(c),
            "side is that of `geometric`",
        ),
        (
            "the geometry only says on which side the eye is; the light's angle is a question for the shading normal alone",
            exercise(d),
            "light comes from below the surface",
        ),
        (
            "the corners' normals may be on the wrong side, but then only the sign is wrong, so the absolute value does it",
            exercise(e),
            "from behind, too",
        ),
        (
            "the weights interpolate whatever the corners have, so I find the cosine at each corner and take their weighted mean",
            exercise(f),
            "cosines at the corners are mixed",
        ),
        (
            "Light counts only if both normals see it, so I took the smaller of the two cosines.",
            exercise(second_a),
            "the smaller of the two cosines is taken",
        ),
        (
            "The barycentric coordinates are u, v and what is left, so I gave u to the first corner's normal instead of the second's, and the rest to the last.",
            exercise(second_b),
            "the weights go with the wrong",
        ),
        (
            "The corners' normals may be on either side, so their sign means nothing, and I took the absolute value of the shading normal's cosine once the geometric normal had seen the light.",
            exercise(second_c),
            "light falls on the mixed normal",
        ),
    ]
}

fn right(geometric: [f64; 3], normals: [[f64; 3]; 3], weights: [f64; 3], to_eye: [f64; 3], to_light: [f64; 3]) -> f64 {
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
    let length = dot(n, n).sqrt();
    n = n.map(|part| part / length);
    if dot(n, g) < 0.0 {
        n = n.map(|part| -part);
    }
    if dot(g, to_light) <= 0.0 {
        return 0.0;
    }
    (dot(n, to_light) / dot(to_light, to_light).sqrt()).max(0.0)
}

fn a(geometric: [f64; 3], normals: [[f64; 3]; 3], weights: [f64; 3], to_eye: [f64; 3], to_light: [f64; 3]) -> f64 {
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

fn b(geometric: [f64; 3], normals: [[f64; 3]; 3], weights: [f64; 3], to_eye: [f64; 3], to_light: [f64; 3]) -> f64 {
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let side = if dot(geometric, to_eye) < 0.0 { -1.0 } else { 1.0 };
    let g = geometric.map(|part| side * part);
    let mut n = [0.0f64; 3];
    for k in 0..3 {
        for i in 0..3 {
            n[i] += weights[k] * normals[k][i];
        }
    }
    if dot(n, g) < 0.0 {
        n = n.map(|part| -part);
    }
    if dot(g, to_light) <= 0.0 {
        return 0.0;
    }
    (dot(n, to_light) / dot(to_light, to_light).sqrt()).max(0.0)
}

fn c(geometric: [f64; 3], normals: [[f64; 3]; 3], weights: [f64; 3], to_eye: [f64; 3], to_light: [f64; 3]) -> f64 {
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

fn d(geometric: [f64; 3], normals: [[f64; 3]; 3], weights: [f64; 3], to_eye: [f64; 3], to_light: [f64; 3]) -> f64 {
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
    if dot(n, g) < 0.0 {
        n = n.map(|part| -part);
    }
    let cosine = dot(n, to_light) / (dot(n, n) * dot(to_light, to_light)).sqrt();
    if cosine > 0.0 { cosine } else { 0.0 }
}

fn e(geometric: [f64; 3], normals: [[f64; 3]; 3], weights: [f64; 3], to_eye: [f64; 3], to_light: [f64; 3]) -> f64 {
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

fn f(geometric: [f64; 3], normals: [[f64; 3]; 3], weights: [f64; 3], to_eye: [f64; 3], to_light: [f64; 3]) -> f64 {
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

fn second_a(
    geometric: [f64; 3],
    normals: [[f64; 3]; 3],
    weights: [f64; 3],
    to_eye: [f64; 3],
    to_light: [f64; 3],
) -> f64 {
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let mut n = [0.0_f64; 3];
    for k in 0..3 {
        for i in 0..3 {
            n[i] += weights[k] * normals[k][i];
        }
    }
    let length = dot(n, n).sqrt();
    let light_length = dot(to_light, to_light).sqrt();
    let side = if dot(geometric, to_eye) < 0.0 { -1.0_f64 } else { 1.0_f64 };
    let same = if dot(geometric, n) < 0.0 { -1.0_f64 } else { 1.0_f64 };
    let geometric_cosine = side * dot(geometric, to_light) / light_length;
    let shading_cosine = side * same * dot(n, to_light) / (length * light_length);
    geometric_cosine.min(shading_cosine).max(0.0)
}

fn second_b(
    geometric: [f64; 3],
    normals: [[f64; 3]; 3],
    weights: [f64; 3],
    to_eye: [f64; 3],
    to_light: [f64; 3],
) -> f64 {
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

fn second_c(
    geometric: [f64; 3],
    normals: [[f64; 3]; 3],
    weights: [f64; 3],
    to_eye: [f64; 3],
    to_light: [f64; 3],
) -> f64 {
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let mut n = [0.0_f64; 3];
    for k in 0..3 {
        for i in 0..3 {
            n[i] += weights[k] * normals[k][i];
        }
    }
    let length = dot(n, n).sqrt();
    let light_length = dot(to_light, to_light).sqrt();
    if dot(geometric, to_eye) * dot(geometric, to_light) <= 0.0 {
        return 0.0;
    }
    (dot(n, to_light) / (length * light_length)).abs()
}
