//! Answers that readers of chapter 03 gave who saw its page and nothing else, and words of the remark that each must get.

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
            "if the near root is behind the eye then the eye is inside, so the far root must be the hit",
            exercise(a),
            "behind the origin is hit too",
        ),
        ("b is 2 f·R as in every book, and f is C − O as on this page", exercise(b), "b has the wrong sign"),
        ("c is the square of f less the radius", exercise(c), "radius is not squared"),
        (
            "s is f·R over R·R, and half the chord is Pythagoras: the root of r² less |l|², so t = s ∓ h",
            exercise(d),
            "half the chord is added to t as a length",
        ),
        (
            "R must have length 1, chapter 2 says so, so I bring it to length 1 before I do anything else",
            exercise(e),
            "brought to length 1 and t is left so",
        ),
        (
            "b without its 2, as programs often have it, and then the formula from school for the discriminant and the roots",
            exercise(f),
            "with half of b are mixed",
        ),
        (
            "I took b without its factor 2 'as programs often do', and kept b² − 4ac and 2a from school.",
            exercise(second_a),
            "the formula with b and that with",
        ),
        (
            "A ray's direction has length 1 (chapter 2), so I brought it to length 1 first; then t is a distance.",
            exercise(second_b),
            "the direction is brought to length",
        ),
        (
            "The ray passes the centre at |l|, so r − |l| of the radius is left, and I took that for half the chord.",
            exercise(second_c),
            "half the chord is r − |l|",
        ),
    ]
}

fn right(origin: [f64; 3], direction: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let f = [centre[0] - origin[0], centre[1] - origin[1], centre[2] - origin[2]];
    let a = dot(direction, direction);
    let b = -2.0 * dot(f, direction);
    let c = dot(f, f) - radius * radius;
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    let near = (-b - root) / (2.0 * a);
    let far = (-b + root) / (2.0 * a);
    if near > 0.0 {
        Some(near)
    } else if far > 0.0 {
        Some(far)
    } else {
        None
    }
}

fn a(origin: [f64; 3], direction: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let f = [centre[0] - origin[0], centre[1] - origin[1], centre[2] - origin[2]];
    let a = dot(direction, direction);
    let b = -2.0 * dot(f, direction);
    let c = dot(f, f) - radius * radius;
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    let near = (-b - root) / (2.0 * a);
    if near > 0.0 {
        return Some(near);
    }
    Some((-b + root) / (2.0 * a))
}

fn b(origin: [f64; 3], direction: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let f = [centre[0] - origin[0], centre[1] - origin[1], centre[2] - origin[2]];
    let a = dot(direction, direction);
    let b = 2.0 * dot(f, direction);
    let c = dot(f, f) - radius * radius;
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return None;
    }
    let near = (-b - discriminant.sqrt()) / (2.0 * a);
    let far = (-b + discriminant.sqrt()) / (2.0 * a);
    [near, far].into_iter().find(|&t| t > 0.0)
}

fn c(origin: [f64; 3], direction: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let f = [centre[0] - origin[0], centre[1] - origin[1], centre[2] - origin[2]];
    let a = dot(direction, direction);
    let b = -2.0 * dot(f, direction);
    let c = dot(f, f) - radius;
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return None;
    }
    let near = (-b - discriminant.sqrt()) / (2.0 * a);
    let far = (-b + discriminant.sqrt()) / (2.0 * a);
    [near, far].into_iter().find(|&t| t > 0.0)
}

fn d(origin: [f64; 3], direction: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let f = [centre[0] - origin[0], centre[1] - origin[1], centre[2] - origin[2]];
    let s = dot(f, direction) / dot(direction, direction);
    let l = [f[0] - s * direction[0], f[1] - s * direction[1], f[2] - s * direction[2]];
    let rest = radius * radius - dot(l, l);
    if rest < 0.0 {
        return None;
    }
    let h = rest.sqrt();
    if s - h > 0.0 {
        Some(s - h)
    } else if s + h > 0.0 {
        Some(s + h)
    } else {
        None
    }
}

fn e(origin: [f64; 3], direction: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let length = dot(direction, direction).sqrt();
    let r = direction.map(|part| part / length);
    let f = [centre[0] - origin[0], centre[1] - origin[1], centre[2] - origin[2]];
    let s = dot(f, r);
    let l = [f[0] - s * r[0], f[1] - s * r[1], f[2] - s * r[2]];
    let rest = radius * radius - dot(l, l);
    if rest < 0.0 {
        return None;
    }
    let h = rest.sqrt();
    if s - h > 0.0 {
        Some(s - h)
    } else if s + h > 0.0 {
        Some(s + h)
    } else {
        None
    }
}

fn f(origin: [f64; 3], direction: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let from_centre = [origin[0] - centre[0], origin[1] - centre[1], origin[2] - centre[2]];
    let a = dot(direction, direction);
    let b = dot(from_centre, direction);
    let c = dot(from_centre, from_centre) - radius * radius;
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return None;
    }
    let near = (-b - discriminant.sqrt()) / (2.0 * a);
    let far = (-b + discriminant.sqrt()) / (2.0 * a);
    [near, far].into_iter().find(|&t| t > 0.0)
}

fn second_a(origin: [f64; 3], direction: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let f = [centre[0] - origin[0], centre[1] - origin[1], centre[2] - origin[2]];
    let qa = dot(direction, direction);
    let qb = -dot(f, direction);
    let qc = dot(f, f) - radius * radius;
    let discriminant = qb * qb - 4.0 * qa * qc;
    if discriminant < 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    let near = (-qb - root) / (2.0 * qa);
    let far = (-qb + root) / (2.0 * qa);
    if near > 0.0 {
        Some(near)
    } else if far > 0.0 {
        Some(far)
    } else {
        None
    }
}

fn second_b(origin: [f64; 3], direction: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let length = dot(direction, direction).sqrt();
    let r = [direction[0] / length, direction[1] / length, direction[2] / length];
    let f = [centre[0] - origin[0], centre[1] - origin[1], centre[2] - origin[2]];
    let s = dot(f, r);
    let l = [f[0] - s * r[0], f[1] - s * r[1], f[2] - s * r[2]];
    let square = radius * radius - dot(l, l);
    if square < 0.0 {
        return None;
    }
    let h = square.sqrt();
    if s - h > 0.0 {
        Some(s - h)
    } else if s + h > 0.0 {
        Some(s + h)
    } else {
        None
    }
}

fn second_c(origin: [f64; 3], direction: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let rr = dot(direction, direction);
    let f = [centre[0] - origin[0], centre[1] - origin[1], centre[2] - origin[2]];
    let s = dot(f, direction) / rr;
    let l = [f[0] - s * direction[0], f[1] - s * direction[1], f[2] - s * direction[2]];
    let across = dot(l, l).sqrt();
    if across > radius {
        return None;
    }
    let h = (radius - across) / rr.sqrt();
    if s - h > 0.0 {
        Some(s - h)
    } else if s + h > 0.0 {
        Some(s + h)
    } else {
        None
    }
}
