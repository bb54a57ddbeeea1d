//! Chapter 34: where the image shows a sphere, from left to right.

use super::mine::mine;
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{Exercise, Mistakes, Probe, Question, extremes, probes};
use pinhole_lab::measure::ray_aim::Draws;
use pinhole_lab::naive::both::{interval_at_its_depth, sphere_interval};

/// Right, ahead, radius, half.
pub(super) type Input = [f64; 4];

/// What the reader writes.
pub type Yours = fn(f64, f64, f64, f64) -> [f64; 2];

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
        mistakes: Mistakes::<Input, [f64; 2]>::new()
            .say("both ends are taken at the depth of the centre: the outline of a sphere is nearer to the eye")
            .when(|&[right, ahead, radius, half]| cut(interval_at_its_depth(right, ahead, radius), half))
            .say(
                "this is the interval of a box around the sphere, taken at its near side: it is wider than the \
                 sphere",
            )
            .when(|&[right, ahead, radius, half]| cut(in_front(right, ahead, radius), half))
            .when(
                |&[right, ahead, radius, half]| {
                    if ahead <= radius { [-half, half] } else { cut(in_front(right, ahead, radius), half) }
                },
            )
            .say(
                "both ends are taken at the depth of the far side; the outline of a sphere is nearer to the eye \
                 than its centre",
            )
            .when(|&[right, ahead, radius, half]| cut(in_front(right, ahead + 2.0 * radius, radius), half))
            .say(
                "the two ends are as far from the centre's image as if it were straight ahead; to the side a \
                 sphere looks wider, and its centre is not in the middle",
            )
            .when(|&[right, ahead, radius, half]| cut(as_if_ahead(right / ahead, ahead * ahead, radius), half))
            .when(|&[right, ahead, radius, half]| {
                cut(as_if_ahead(right / ahead, right * right + ahead * ahead, radius), half)
            })
            .when(|&[right, ahead, radius, half]| {
                let squared = right * right + ahead * ahead;
                if squared <= radius * radius || ahead <= 0.0 {
                    [-half, half]
                } else {
                    cut(as_if_ahead(right / ahead, squared, radius), half)
                }
            })
            .when(|&[right, ahead, radius, half]| {
                cut(
                    [
                        right / ahead - radius / libm::hypot(right, ahead),
                        right / ahead + radius / libm::hypot(right, ahead),
                    ],
                    half,
                )
            })
            .say("it is divided by the distance to the centre, where an image divides by how far something is ahead")
            .when(|&[right, ahead, radius, half]| {
                cut([right - radius, right + radius].map(|end| end / libm::hypot(right, ahead)), half)
            })
            .say("the sphere is on the wrong side: to the right is positive")
            .when(|&[right, ahead, radius, most]| sphere_interval(-right, ahead, radius, most))
            .say("`right` and `ahead` are exchanged: the tangent is right over ahead")
            .when(|&[right, ahead, radius, most]| sphere_interval(ahead, right, radius, most))
            .say("the ends are swapped: the left one is first")
            .when(|&[right, ahead, radius, half]| {
                let [low, high] = sphere_interval(right, ahead, radius, half);
                [high, low]
            })
            .say("the radius over the distance is the sine of the angle between centre and outline, not its tangent")
            .when(|&[right, ahead, radius, half]| {
                by_angle([right, ahead, radius, half], libm::atan(radius / libm::hypot(right, ahead)), libm::tan)
            })
            .say("the radius over the distance is the sine of the angle, not the angle itself")
            .when(|&[right, ahead, radius, half]| {
                by_angle([right, ahead, radius, half], radius / libm::hypot(right, ahead), libm::tan)
            })
            .say("the radius over the distance is the sine of the angle, not its cosine")
            .when(|&[right, ahead, radius, half]| {
                by_angle([right, ahead, radius, half], libm::acos(radius / libm::hypot(right, ahead)), libm::tan)
            })
            .say(
                "the radius is divided by how far the centre is ahead; the sine of the angle is radius over \
                 distance, √(right² + ahead²)",
            )
            .when(|&[right, ahead, radius, half]| {
                by_angle([right, ahead, radius, half], libm::asin(radius / ahead), libm::tan)
            })
            .when(|&[right, ahead, radius, half]| {
                by_angle([right, ahead, radius, half], libm::atan(radius / ahead), libm::tan)
            })
            .when(|&[right, ahead, radius, half]| {
                if ahead <= radius {
                    [-half, half]
                } else {
                    by_angle([right, ahead, radius, half], libm::asin(radius / ahead), libm::tan)
                }
            })
            .when(|&[right, ahead, radius, half]| {
                if ahead <= radius {
                    [-half, half]
                } else {
                    by_angle([right, ahead, radius, half], libm::atan(radius / ahead), libm::tan)
                }
            })
            .say("the angle between centre and outline is halved or doubled; its sine is radius over distance")
            .when(|&[right, ahead, radius, half]| {
                by_angle([right, ahead, radius, half], 0.5 * libm::asin(radius / libm::hypot(right, ahead)), libm::tan)
            })
            .when(|&[right, ahead, radius, half]| {
                by_angle([right, ahead, radius, half], 2.0 * libm::asin(radius / libm::hypot(right, ahead)), libm::tan)
            })
            .say("those are angles, or their sines; on a plane at distance 1 the ends are at their tangents")
            .when(|&[right, ahead, radius, half]| {
                by_angle([right, ahead, radius, half], libm::asin(radius / libm::hypot(right, ahead)), |angle| angle)
            })
            .when(|&[right, ahead, radius, half]| {
                by_angle([right, ahead, radius, half], libm::asin(radius / libm::hypot(right, ahead)), libm::sin)
            })
            .say("the centre's distance is taken for the tangents' length, which is √(right² + ahead² − radius²)")
            .when(|&[right, ahead, radius, half]| cut(turned(right, ahead, radius, libm::hypot(right, ahead)), half))
            .say("beside the image one end is left outside: each end must be cut off at both edges")
            .when(|&[right, ahead, radius, half]| {
                let [low, high] = sphere_interval(right, ahead, radius, 1e9);
                [low.max(-half), high.min(half)]
            })
            .say("an end beyond the image's edge is left there; it must be cut off at the edge")
            .when(|&[right, ahead, radius, _]| sphere_interval(right, ahead, radius, 1e9))
            .say("the ends are divided by half; they lie between −half and half")
            .when(|&[right, ahead, radius, most]| sphere_interval(right, ahead, radius, most).map(|end| end / most))
            .say(
                "a tangent that is not in front of the eye is divided all the same: the interval then goes on to \
                 the image's edge",
            )
            .when(|&[right, ahead, radius, half]| cut(divided(right, ahead, radius), half))
            .when(|&[right, ahead, radius, half]| cut(nan_inside(right, ahead, radius), half))
            .say(
                "the whole image is taken as soon as the sphere reaches beside the eye; only the end on that side \
                 goes on to the edge",
            )
            .when(
                |&[right, ahead, radius, half]| {
                    if ahead <= radius { [-half, half] } else { sphere_interval(right, ahead, radius, half) }
                },
            )
            .say("with its centre behind the eye the sphere still reaches in front of it, on one side")
            .when(
                |&[right, ahead, radius, half]| {
                    if ahead <= 0.0 { [-half, half] } else { sphere_interval(right, ahead, radius, half) }
                },
            )
            .say("the eye may be inside the disk: there is no tangent then, and the interval is the whole image")
            .when(|&[right, ahead, radius, half]| {
                if right * right + ahead * ahead <= radius * radius {
                    [f64::NAN; 2]
                } else {
                    sphere_interval(right, ahead, radius, half)
                }
            }),
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

/// About the centre's image, with the tangent of the angle at a centre of this distance squared.
fn as_if_ahead(centre: f64, squared: f64, radius: f64) -> [f64; 2] {
    let beside = radius / (squared - radius * radius).max(1e-12).sqrt();
    [centre - beside, centre + beside]
}

/// So many radians to both sides of the centre.
fn by_angle([right, ahead, radius, half]: Input, beside: f64, end: fn(f64) -> f64) -> [f64; 2] {
    if libm::hypot(right, ahead) <= radius {
        return [-half, half];
    }
    [-1.0, 1.0].map(|side| {
        let angle = libm::atan2(right, ahead) + side * beside;
        if angle.abs() < std::f64::consts::FRAC_PI_2 { end(angle).clamp(-half, half) } else { side * half }
    })
}

fn divided(right: f64, ahead: f64, radius: f64) -> [f64; 2] {
    let tangent = (right * right + ahead * ahead - radius * radius).max(0.0).sqrt();
    turned(right, ahead, radius, tangent).map(|end| if end.is_nan() { 0.0 } else { end })
}

fn nan_inside(right: f64, ahead: f64, radius: f64) -> [f64; 2] {
    turned(right, ahead, radius, (right * right + ahead * ahead - radius * radius).sqrt())
}

/// The direction to the centre, turned by the angle whose tangent is radius over this length.
fn turned(right: f64, ahead: f64, radius: f64, tangent: f64) -> [f64; 2] {
    [-1.0, 1.0].map(|side| (right * tangent + side * ahead * radius) / (ahead * tangent - side * right * radius))
}

fn asked() -> Vec<Probe<Input>> {
    let mut asked: Vec<_> = probes("straight ahead", [[0.0, 5.0, 3.0, 1.0], [0.0, 10.0, 0.5, 0.5]]).collect();
    asked.extend(probes("to the side", [[3.0, 4.0, 3.0, 4.0], [-3.0, 4.0, 3.0, 4.0], [1.0, 6.0, 0.75, 0.5]]));
    asked.extend(probes("across an edge of the image", [[2.0, 4.0, 1.0, 0.5], [-2.0, 4.0, 1.0, 0.5]]));
    asked.extend(probes("beside the image", [[5.0, 4.0, 1.0, 0.5], [-5.0, 4.0, 1.0, 0.5]]));
    let (in_front, beside): (Vec<Input>, Vec<Input>) =
        (0..300).map(drawn).partition(|&[_, ahead, radius, _]| ahead > radius);
    asked.extend(probes("anywhere in front of the eye", in_front));
    // Where an angle is beyond 90°, its tangent says nothing; where the eye is inside, there is no angle.
    asked.extend(extremes(
        "as near as it is large, so that it reaches behind the eye",
        [[1.5, 0.5, 1.0, 2.0], [-1.5, 0.5, 1.0, 2.0], [3.0, 1.0, 2.0, 1.0]],
    ));
    asked.extend(extremes("its centre is behind the eye", [[2.0, -0.5, 1.5, 3.0], [-1.2, -0.3, 1.0, 3.0]]));
    // Seen from above the eye is inside the disk; the sphere may be higher or lower than the eye.
    asked.extend(extremes("the eye is above it", [[0.5, 0.5, 1.0, 1.0], [0.0, -0.25, 1.0, 0.75]]));
    asked.extend(extremes("anywhere, reaching behind the eye", beside));
    asked
}

/// A sphere that is not wholly behind the eye.
fn drawn(index: u64) -> Input {
    let mut draws = Draws::new(3401, index);
    let (radius, half) = (draws.between(0.1, 2.0), draws.between(0.2, 2.0));
    [draws.between(-4.0, 4.0), draws.between(-radius, 8.0), radius, half]
}
