//! Chapter 34: where the image shows a sphere, from left to right.

use bevy_ecs::prelude::*;
use glam::DVec2;
use pinhole::extract::SphereTable;
use pinhole::intersect::Hits;
use pinhole::plan::{Column, Shared};
use pinhole::rasterise::{Projection, box_stage};
use pinhole::rays::WorldRays;
use pinhole::shapes::{PlacedSphere, Shape};
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{Ask, Exercise, Mistakes, Probe, Question, Setting, StandIn, extremes, probes};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::naive::both::{interval_at_its_depth, sphere_interval};
use std::sync::{Arc, OnceLock};

/// Right, ahead, radius, half.
type Input = [f64; 4];

/// What the reader writes.
pub type Yours = fn(f64, f64, f64, f64) -> [f64; 2];

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    let written = move |&[right, ahead, radius, half]: &Input| yours(right, ahead, radius, half);
    Exercise::rendered("sphere_interval", question, written, mine).and_in("balls all about the eye", |_| ())
}

fn question() -> Question<Input, [f64; 2]> {
    Question {
        pinhole_has: ("src/lab/naive/both.rs", "sphere_interval"),
        probes: asked(),
        tell: |[right, ahead, radius, half]| {
            format!("right {right:?}, ahead {ahead:?}, radius {radius:?}, half {half:?}")
        },
        right,
        apart: |yours, right| absolute(yours, right),
        allowed: 1e-9,
        measured: "of each end",
        mistakes: mistakes(),
        hints: &[
            "look from above: the sphere is a disk, and the ends are where the two tangents from the eye cross the image \
             plane; if the eye is inside the disk, every x may see the sphere",
            "the tangents are √(right² + ahead² − radius²) long; between a tangent and the line to the centre there is \
             an angle with the sine radius / √(right² + ahead²)",
            "each tangent is the line to the centre, turned by that angle: where does it cross the plane, and what \
             if it never does?",
        ],
    }
}

fn mistakes() -> Mistakes<Input, [f64; 2]> {
    Mistakes::<Input, [f64; 2]>::new()
        .say("the ends are in NDC; they are to stay on the image plane, from −half to half")
        .when(|i| right(i).map(|end| (end / i[3] + 1.0) / 2.0))
        .say("the ends are multiplied by `ahead`; the image plane is at distance 1")
        .when(|i| cut(i, right(i).map(|end| end * i[1])))
        .say("both ends are taken at the depth of the centre: the outline of a sphere is nearer to the eye")
        .when(|i| cut(i, interval_at_its_depth(i[0], i[1], i[2])))
        .say("this is the interval of a box around the sphere, taken at its near side: it is wider than the sphere")
        .when(|i| cut(i, in_front(i, i[1] - i[2])))
        .when(|i| all_if(i, i[1] <= i[2], |i| cut(i, in_front(i, i[1] - i[2]))))
        .say(
            "both ends are taken at the depth of the far side; the outline of a sphere is nearer to the eye than its \
             centre",
        )
        .when(|i| cut(i, in_front(i, i[1] + i[2])))
        .say(
            "the two ends are as far from the centre's image as if it were straight ahead; to the side a sphere \
             looks wider, and its centre is not in the middle",
        )
        .when(|i| cut(i, as_if_ahead(i, i[1] * i[1])))
        .when(|i| cut(i, as_if_ahead(i, distance(i).powi(2))))
        .when(|i| all_if(i, distance(i) <= i[2] || i[1] <= 0.0, |i| cut(i, as_if_ahead(i, distance(i).powi(2)))))
        .when(|i| cut(i, [-1.0, 1.0].map(|side| i[0] / i[1] + side * i[2] / distance(i))))
        .say("it is divided by the distance to the centre, where an image divides by how far something is ahead")
        .when(|i| cut(i, [-1.0, 1.0].map(|side| (i[0] + side * i[2]) / distance(i))))
        .say("the sphere is on the wrong side: to the right is positive")
        .when(|i| sphere_interval(-i[0], i[1], i[2], i[3]))
        .say("`right` and `ahead` are exchanged: the tangent is right over ahead")
        .when(|i| sphere_interval(i[1], i[0], i[2], i[3]))
        .say("the two crossings are sorted; one that lies behind the eye is no end: there the image's edge is")
        .when(|i| all_if(i, distance(i) <= i[2], |i| cut(i, crossings(i))))
        .when(|i| cut(i, crossings(i)))
        .say("the ends are swapped: the left one is first")
        .when(|i| [right(i)[1], right(i)[0]])
        .say("the radius over the distance is the sine of the angle between centre and outline, not its tangent")
        .when(|i| by_angle(i, libm::atan(i[2] / distance(i)), libm::tan))
        .say("the radius over the distance is the sine of the angle, not the angle itself")
        .when(|i| by_angle(i, i[2] / distance(i), libm::tan))
        .say("the radius over the distance is the sine of the angle, not its cosine")
        .when(|i| by_angle(i, libm::acos(i[2] / distance(i)), libm::tan))
        .say(
            "the radius is divided by how far the centre is ahead; the sine of the angle is radius over distance, \
             √(right² + ahead²)",
        )
        .when(|i| by_angle(i, libm::asin(i[2] / i[1]), libm::tan))
        .when(|i| by_angle(i, libm::atan(i[2] / i[1]), libm::tan))
        .when(|i| all_if(i, i[1] <= i[2], |i| by_angle(i, libm::asin(i[2] / i[1]), libm::tan)))
        .when(|i| all_if(i, i[1] <= i[2], |i| by_angle(i, libm::atan(i[2] / i[1]), libm::tan)))
        .say("the angle between centre and outline is halved or doubled; its sine is radius over distance")
        .when(|i| by_angle(i, 0.5 * libm::asin(i[2] / distance(i)), libm::tan))
        .when(|i| by_angle(i, 2.0 * libm::asin(i[2] / distance(i)), libm::tan))
        .say("those are angles, or their sines; on a plane at distance 1 the ends are at their tangents")
        .when(|i| by_angle(i, libm::asin(i[2] / distance(i)), |angle| angle))
        .when(|i| by_angle(i, libm::asin(i[2] / distance(i)), libm::sin))
        .say("the centre's distance is taken for the tangents' length, which is √(right² + ahead² − radius²)")
        .when(|i| cut(i, turned(i, distance(i))))
        .say("beside the image one end is left outside: each end must be cut off at both edges")
        .when(|i| [uncut(i)[0].max(-i[3]), uncut(i)[1].min(i[3])])
        .say("an end beyond the image's edge is left there; it must be cut off at the edge")
        .when(uncut)
        .say("the ends are divided by half; they lie between −half and half")
        .when(|i| right(i).map(|end| end / i[3]))
        .say(
            "a tangent that is not in front of the eye is divided all the same: the interval then goes on to the \
             image's edge",
        )
        .when(|i| cut(i, turned(i, tangent(i).max(0.0).sqrt()).map(|end| if end.is_nan() { 0.0 } else { end })))
        .when(|i| cut(i, turned(i, tangent(i).sqrt())))
        .say(
            "the whole image is taken as soon as the sphere reaches beside the eye; only the end on that side goes \
             on to the edge",
        )
        .when(|i| all_if(i, i[1] <= i[2], right))
        .say("with its centre behind the eye the sphere still reaches in front of it, on one side")
        .when(|i| all_if(i, i[1] <= 0.0, right))
        .say("the eye may be inside the disk: there is no tangent then, and the interval is the whole image")
        .when(|i| if tangent(i) <= 0.0 { [f64::NAN; 2] } else { right(i) })
}

fn right(&[right, ahead, radius, half]: &Input) -> [f64; 2] {
    sphere_interval(right, ahead, radius, half)
}

fn uncut(&[right, ahead, radius, _]: &Input) -> [f64; 2] {
    sphere_interval(right, ahead, radius, 1e9)
}

fn distance(i: &Input) -> f64 {
    libm::hypot(i[0], i[1])
}

/// The length of the tangents, squared.
fn tangent(i: &Input) -> f64 {
    i[0] * i[0] + i[1] * i[1] - i[2] * i[2]
}

fn cut(i: &Input, ends: [f64; 2]) -> [f64; 2] {
    ends.map(|end| end.clamp(-i[3], i[3]))
}

/// The whole image where this is so.
fn all_if(i: &Input, is_so: bool, otherwise: fn(&Input) -> [f64; 2]) -> [f64; 2] {
    if is_so { [-i[3], i[3]] } else { otherwise(i) }
}

/// Divided by this depth.
fn in_front(i: &Input, depth: f64) -> [f64; 2] {
    [-1.0, 1.0].map(|side| (i[0] + side * i[2]) / depth.max(1e-9))
}

/// About the centre's image, with the tangent of the angle at a centre of this distance squared.
fn as_if_ahead(i: &Input, squared: f64) -> [f64; 2] {
    let beside = i[2] / (squared - i[2] * i[2]).max(1e-12).sqrt();
    [i[0] / i[1] - beside, i[0] / i[1] + beside]
}

/// So many radians to both sides of the centre.
fn by_angle(&[right, ahead, radius, half]: &Input, beside: f64, end: fn(f64) -> f64) -> [f64; 2] {
    if libm::hypot(right, ahead) <= radius {
        return [-half, half];
    }
    [-1.0, 1.0].map(|side| {
        let angle = libm::atan2(right, ahead) + side * beside;
        if angle.abs() < std::f64::consts::FRAC_PI_2 { end(angle).clamp(-half, half) } else { side * half }
    })
}

/// The direction to the centre, turned by the angle whose tangent is radius over this length.
/// Where the two tangents cross the image plane, on whichever side of the eye, the smaller first.
fn crossings(&[right, ahead, radius, _]: &Input) -> [f64; 2] {
    let a = ahead * ahead - radius * radius;
    let root = radius * (right * right + a).max(0.0).sqrt();
    let [one, other] = [-root, root].map(|root| (ahead * right + root) / a);
    [one.min(other), one.max(other)]
}

fn turned(&[right, ahead, radius, _]: &Input, tangent: f64) -> [f64; 2] {
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

/// The least and greatest x and y of the image plane at distance 1 at which a sphere is looked for.
type Rectangle = [DVec2; 2];

/// Spheres in their rectangles on the image, whose sides the reader's function gives.
fn mine(ask: Ask<Input, [f64; 2]>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    let kept: Arc<OnceLock<Vec<Rectangle>>> = Arc::default();
    StandIn::instead(
        box_stage::<PlacedSphere>,
        move |projection: Res<Shared<Projection>>,
              spheres: Res<Shared<SphereTable>>,
              mut tiles: Query<(&WorldRays, &mut Hits)>| {
            let rectangles = kept.get_or_init(|| {
                let on_image = |sphere: &PlacedSphere| rectangle(&ask, &projection, sphere);
                spheres.row.iter().map(on_image).collect()
            });
            for (rays, mut hits) in &mut tiles {
                for row in 0..rays.rows() {
                    let [origin, direction] = [rays.origin_of(row), rays.direction_of(row)];
                    let camera = projection.camera_from_world * direction;
                    let at = DVec2::new(camera.x, camera.y) / -camera.z;
                    for ((sphere, [low, high]), &shape) in spheres.row.iter().zip(rectangles).zip(&spheres.shape) {
                        if !(at.cmpge(*low) & at.cmple(*high)).all() {
                            continue;
                        }
                        let t = sphere.t(origin, direction);
                        if t < hits.t[row] {
                            (hits.t[row], hits.shape[row]) = (t, shape);
                        }
                    }
                }
            }
        },
    )
}

/// The rectangle of one sphere: one interval for its width, one for its height.
fn rectangle(ask: &Ask<Input, [f64; 2]>, projection: &Projection, sphere: &PlacedSphere) -> Rectangle {
    let centre = projection.camera_from_world * sphere.centre;
    let nowhere = [DVec2::INFINITY, DVec2::NEG_INFINITY];
    if -centre.z <= -sphere.radius {
        return nowhere;
    }
    let ends = |axis: usize| ask.once([centre[axis], -centre.z, sphere.radius, projection.half[axis]]);
    let (Some([left, right]), Some([low, high])) = (ends(0), ends(1)) else { return nowhere };
    // A ray in f32 may be a hair beside the sample that it was made for.
    let hair = f64::from(f32::EPSILON) * projection.half;
    [DVec2::new(left, low) - hair, DVec2::new(right, high) + hair]
}

/// Balls of radius 1 from far left to far right of the eye, and from about it at the top to far ahead: red is the left end
/// of the interval, green the right one.
fn painted(ask: Ask<Input, [f64; 2]>) -> StandIn {
    StandIn::painted([64, 32], move |[x, y]| {
        let (right, ahead) = ((f64::from(x) - 31.5) / 8.0, f64::from(y) / 6.0 - 0.9);
        let [left, right] = ask.once([right, ahead, 1.0, 1.5]).unwrap_or_default();
        [0.5 + left / 8.0, 0.5 + right / 8.0, 0.1]
    })
}
