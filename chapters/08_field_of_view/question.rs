//! Chapter 08: the vertical angle of a field of view that is measured across something else.

use super::mine::mine;
use glam::DMat3;
use pinhole::extract::tan_half;
use pinhole::scene::{Degrees, FovAxis};
use pinhole_lab::exercise::apart::relative;
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, probes};
use pinhole_lab::measure::oracle_camera::ExactCamera;
use pinhole_lab::measure::ray_aim::Draws;
use std::f64::consts::PI;

pub(super) type Input = (f64, FovAxis, u32, u32);

/// Across what an angle can be measured.
const AXES: [FovAxis; 5] =
    [FovAxis::Vertical, FovAxis::Horizontal, FovAxis::Smaller, FovAxis::Larger, FovAxis::Diagonal];

/// What the reader writes.
pub type Yours = fn(f64, FovAxis, u32, u32) -> f64;

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::vertical_fov)
}

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered(
        "vertical_fov",
        question,
        move |&(angle, axis, width, height)| yours(angle, axis, width, height),
        mine,
    )
}

fn question() -> Question<Input, f64> {
    Question {
        pinhole_has: ("src/pinhole/cameras/field_of_view.rs", "tan_half"),
        probes: asked(),
        tell: |(angle, axis, width, height)| format!("angle {angle:?}°, axis {axis:?}, width {width}, height {height}"),
        right: |&(angle, axis, width, height)| {
            let camera = ExactCamera::new(width, height, angle, axis, DMat3::IDENTITY);
            degrees(camera.tan_half_vertical.to_f64())
        },
        apart: |yours, right| relative(&[*yours], &[*right]),
        allowed: 1e-10,
        measured: "of the angle",
        mistakes: vec![
            Mistake::new("the angle is handed back as it is, whatever it is measured across", |&(angle, ..)| angle),
            Mistake::new(
                "the angle itself is divided by the aspect; it is the tangent of its half that scales",
                |input| input.0 / across(input),
            ),
            Mistake::new("tan takes the degrees for radians", |input| {
                2.0 * libm::atan(libm::tan(input.0 / 2.0) / across(input)) * 180.0 / PI
            }),
            Mistake::new("the answer is in radians; degrees are asked for", |input| vertical(input).to_radians()),
            Mistake::new("the tangent is taken of the full angle; the triangle at the eye has half of it", |input| {
                libm::atan(libm::tan(input.0.to_radians()) / across(input)).to_degrees()
            }),
            Mistake::new("the answer is half the angle", |input| vertical(input) / 2.0),
            Mistake::new("the tangent is multiplied by the aspect; the height is what is shorter", |input| {
                degrees(tan_half(Degrees(input.0)) * across(input))
            }),
            Mistake::new(
                "the diagonal is taken for something else: it is √(width² + height²) / height heights",
                |input| {
                    if input.1 == FovAxis::Diagonal { input.0 } else { vertical(input) }
                },
            ),
            Mistake::new(
                "the smaller and the larger side are taken to be the height and the width",
                |&(angle, axis, w, h)| {
                    let axis = match axis {
                        FovAxis::Smaller => FovAxis::Vertical,
                        FovAxis::Larger => FovAxis::Horizontal,
                        other => other,
                    };
                    vertical(&(angle, axis, w, h))
                },
            ),
        ],
        hints: &[
            "at distance 1 the angle spans 2 tan(angle / 2) along its axis; how much is that along the height?",
            "half the height is tan(angle / 2) divided by how many heights its axis is long: 1, width / height, …, \
             and for the diagonal √(width² + height²) / height",
            "the answer is 2 atan of that half height; tan and atan work in radians, degrees go in and come out",
        ],
    }
}

fn asked() -> Vec<Probe<Input>> {
    let every = |angle: f64, width, height| AXES.map(|axis| (angle, axis, width, height));
    let sizes = [(480, 270), (270, 480), (1, 65_536), (65_536, 1)];
    let any_size = |angle: f64| sizes.into_iter().flat_map(move |(width, height)| every(angle, width, height));
    let mut asked: Vec<_> = probes("90° across 480 × 270", every(90.0, 480, 270)).collect();
    asked.extend(probes("90° across 270 × 480", every(90.0, 270, 480)));
    asked.extend(probes("40° across a square image", every(40.0, 100, 100)));
    asked.extend(probes(
        "an ordinary angle and image",
        (0..40).map(|at| {
            let mut draws = Draws::new(801, at);
            let (width, height) = (draws.between(100.0, 2000.0) as u32, draws.between(100.0, 2000.0) as u32);
            (draws.between(5.0, 150.0), AXES[at as usize % 5], width, height)
        }),
    ));
    asked.extend(probes("the narrowest angle", any_size(1e-4)));
    asked.extend(probes("an ordinary angle, the longest images", any_size(60.0)));
    asked.extend(probes("the widest angle", any_size(179.99)));
    asked
}

fn vertical(input: &Input) -> f64 {
    degrees(tan_half(Degrees(input.0)) / across(input))
}

/// How many image heights long the axis is.
fn across(&(_, axis, width, height): &Input) -> f64 {
    let aspect = f64::from(width) / f64::from(height);
    match axis {
        FovAxis::Vertical => 1.0,
        FovAxis::Horizontal => aspect,
        FovAxis::Smaller => aspect.min(1.0),
        FovAxis::Larger => aspect.max(1.0),
        FovAxis::Diagonal => (aspect * aspect + 1.0).sqrt(),
    }
}

/// The full angle, in degrees, whose half has this tangent.
fn degrees(tangent: f64) -> f64 {
    2.0 * libm::atan(tangent) * (180.0 / PI)
}
