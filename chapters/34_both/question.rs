//! Chapter 34: where the image shows a sphere, from left to right.

use super::mine::mine;
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, probes};
use pinhole_lab::measure::ray_aim::Draws;
use pinhole_lab::naive::both::{interval_at_its_depth, sphere_interval};

/// Right, ahead, radius, half.
pub(super) type Input = [f64; 4];

/// What the reader writes.
pub type Yours = fn(f64, f64, f64, f64) -> [f64; 2];

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::sphere_interval)
}

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    let written = move |&[right, ahead, radius, half]: &Input| yours(right, ahead, radius, half);
    Exercise::rendered("sphere_interval", question, written, mine)
}

fn question() -> Question<Input, [f64; 2]> {
    Question {
        pinhole_has: ("src/lab/naive/both.rs", "sphere_interval"),
        probes: asked(),
        tell: |[right, ahead, radius, half]| {
            format!("right {right:?}, ahead {ahead:?}, radius {radius:?}, half {half:?}")
        },
        right: |&[right, ahead, radius, edge]| sphere_interval(right, ahead, radius, edge),
        apart: |yours, right| absolute(yours, right),
        allowed: 1e-9,
        measured: "of each end",
        mistakes: vec![
            Mistake::new(
                "both ends are taken at the depth of the centre: the outline of a sphere is nearer to the eye",
                |&[right, ahead, radius, half]| cut(interval_at_its_depth(right, ahead, radius), half),
            ),
            Mistake::new(
                "this is the interval of a box around the sphere, taken at its near side: it is wider than the sphere",
                |&[right, ahead, radius, half]| cut(in_front(right, ahead, radius), half),
            ),
            Mistake::new(
                "the two ends are as far from the centre's image as if it were straight ahead; to the side a sphere \
                 looks wider, and its centre is not in the middle",
                |&[right, ahead, radius, half]| cut(as_if_ahead(right, ahead, radius), half),
            ),
            Mistake::new(
                "the sphere is on the wrong side: to the right is positive",
                |&[right, ahead, radius, edge]| sphere_interval(-right, ahead, radius, edge),
            ),
            Mistake::new(
                "the radius over the distance is the sine of the angle between centre and outline, not its tangent",
                |&[right, ahead, radius, half]| by_the_tangent(right, ahead, radius, half),
            ),
            Mistake::new(
                "a tangent that is not in front of the eye is divided all the same: the interval then goes on to the \
                 image's edge",
                |&[right, ahead, radius, half]| cut(divided(right, ahead, radius), half),
            ),
            Mistake::new("what is beyond the image's edge must be cut off there", |&[right, ahead, radius, _]| {
                sphere_interval(right, ahead, radius, 1e9)
            }),
        ],
        hints: &[
            "look from above: the sphere is a disk, and the ends are where the two tangents from the eye cross the image \
             plane; if the eye is inside the disk, every x may see the sphere",
            "the tangents are √(right² + ahead² − radius²) long; between a tangent and the line to the centre there is \
             an angle with the sine radius / √(right² + ahead²)",
            "turn (right, ahead) by that angle, either to the right or to the left, and divide x by z; where z ≤ 0 the \
             interval goes on to that edge, and everything is cut off at ±half",
        ],
    }
}

fn cut(ends: [f64; 2], half: f64) -> [f64; 2] {
    ends.map(|end| end.clamp(-half, half))
}

fn in_front(right: f64, ahead: f64, radius: f64) -> [f64; 2] {
    let near = (ahead - radius).max(1e-9);
    [(right - radius) / near, (right + radius) / near]
}

fn as_if_ahead(right: f64, ahead: f64, radius: f64) -> [f64; 2] {
    let beside = radius / (ahead * ahead - radius * radius).max(1e-12).sqrt();
    [right / ahead - beside, right / ahead + beside]
}

fn by_the_tangent(right: f64, ahead: f64, radius: f64, half: f64) -> [f64; 2] {
    let (distance, to_centre) = (libm::hypot(right, ahead), libm::atan2(right, ahead));
    if distance <= radius {
        return [-half, half];
    }
    let beside = libm::atan(radius / distance);
    [-1.0, 1.0].map(|side| {
        let angle = to_centre + side * beside;
        if angle.abs() < std::f64::consts::FRAC_PI_2 { libm::tan(angle).clamp(-half, half) } else { side * half }
    })
}

fn divided(right: f64, ahead: f64, radius: f64) -> [f64; 2] {
    let tangent = (right * right + ahead * ahead - radius * radius).max(0.0).sqrt();
    [-1.0, 1.0]
        .map(|side| (right * tangent + side * ahead * radius) / (ahead * tangent - side * right * radius))
        .map(|end| if end.is_nan() { 0.0 } else { end })
}

fn asked() -> Vec<Probe<Input>> {
    let mut asked: Vec<_> = probes("straight ahead", [[0.0, 5.0, 3.0, 1.0], [0.0, 10.0, 0.5, 0.5]]).collect();
    asked.extend(probes("to the side", [[3.0, 4.0, 3.0, 4.0], [-3.0, 4.0, 3.0, 4.0], [1.0, 6.0, 0.75, 0.5]]));
    asked.extend(probes("across an edge of the image", [[2.0, 4.0, 1.0, 0.5], [-2.0, 4.0, 1.0, 0.5]]));
    asked.extend(probes("beside the image", [[5.0, 4.0, 1.0, 0.5], [-5.0, 4.0, 1.0, 0.5]]));
    asked.extend(probes(
        "as near as it is large, so that it reaches behind the eye",
        [[1.5, 0.5, 1.0, 2.0], [-1.5, 0.5, 1.0, 2.0], [3.0, 1.0, 2.0, 1.0]],
    ));
    asked.extend(probes("its centre is behind the eye", [[2.0, -0.5, 1.5, 3.0], [-1.2, -0.3, 1.0, 3.0]]));
    // Seen from above the eye is inside the disk; the sphere may be higher or lower than the eye.
    asked.extend(probes("the eye is above it", [[0.5, 0.5, 1.0, 1.0], [0.0, -0.25, 1.0, 0.75]]));
    asked.extend(probes("anywhere", (0..300).map(drawn)));
    asked
}

/// A sphere that is not wholly behind the eye.
fn drawn(index: u64) -> Input {
    let mut draws = Draws::new(3401, index);
    let (radius, half) = (draws.between(0.1, 2.0), draws.between(0.2, 2.0));
    [draws.between(-4.0, 4.0), draws.between(-radius, 8.0), radius, half]
}
