//! Answers to the exercise of chapter 03: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: Some(exercise(textbook)),
        wrong: [
            (exercise(first), "behind the origin is hit too"),
            (exercise(second), "b has the wrong sign"),
            (exercise(third), "Second, what lies behind"),
            (exercise(fourth), "brought to length 1 and t is left so"),
            (exercise(fifth), "with half of b are mixed"),
            (exercise(sixth), "half the chord is r − |l|"),
        ],
    }
}

pub fn solution(origin: [f64; 3], direction: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let f = [centre[0] - origin[0], centre[1] - origin[1], centre[2] - origin[2]];
    let dd = dot(direction, direction);
    let s = dot(f, direction) / dd;
    let across = [f[0] - s * direction[0], f[1] - s * direction[1], f[2] - s * direction[2]];
    let discriminant = radius * radius - dot(across, across);
    let c = dot(f, f) - radius * radius;
    if discriminant < 0.0 || (c >= 0.0 && s <= 0.0) {
        return None;
    }
    let h = (discriminant / dd).sqrt();
    Some(match (c > 0.0, s >= 0.0) {
        (true, _) => c / (dd * (s + h)),
        (false, true) => s + h,
        (false, false) => c / (dd * (s - h)),
    })
}

/// The formula straight from the page.
fn textbook(origin: [f64; 3], direction: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
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

/// If the near root is behind the eye then the eye is inside, so the far root must be the hit.
fn first(origin: [f64; 3], direction: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
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

/// B is 2 f·R as in every book, and f is C − O as on this page.
fn second(origin: [f64; 3], direction: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
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

/// The sphere is at the origin of its own space, and the first root is where the ray comes in.
fn third(origin: [f64; 3], direction: [f64; 3], _: [f64; 3], radius: f64) -> Option<f64> {
    let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let (a, b, c) = (dot(direction, direction), dot(origin, direction), dot(origin, origin) - radius * radius);
    let discriminant = b * b - a * c;
    (discriminant >= 0.0).then(|| (-b - discriminant.sqrt()) / a)
}

/// R must have length 1, chapter 2 says so, so I bring it to length 1 before I do anything else.
fn fourth(origin: [f64; 3], direction: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
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

/// B without its 2, as programs often have it, and then the formula from school for the discriminant and the roots.
fn fifth(origin: [f64; 3], direction: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
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

/// The ray passes the centre at |l|, so r − |l| of the radius is left, and I took that for half the chord.
fn sixth(origin: [f64; 3], direction: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
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
