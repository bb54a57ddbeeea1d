//! Chapter 08: the vertical angle of a field of view that is measured across something else.

use bevy_ecs::prelude::*;
use glam::DMat3;
use pinhole::extract::tan_half;
use pinhole::plan::{Column, VectorRowsMut};
use pinhole::rays;
use pinhole::rays::{CameraRays, ScreenPoints, camera_ray_perspective};
use pinhole::scene::{Degrees, FovAxis, PerspectiveCamera};
use pinhole_lab::exercise::apart::relative;
use pinhole_lab::exercise::{
    Ask, Exercise, Mistakes, Part, Probe, Question, RowPlaces, Setting, StandIn, on_camera, probes,
};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::measure::oracle_camera::ExactCamera;
use std::f64::consts::{PI, SQRT_2};

type Input = (f64, FovAxis, u32, u32);

/// Across what an angle can be measured.
const AXES: [FovAxis; 5] =
    [FovAxis::Vertical, FovAxis::Horizontal, FovAxis::Smaller, FovAxis::Larger, FovAxis::Diagonal];

/// What the reader writes.
pub type Yours = fn(f64, FovAxis, u32, u32) -> f64;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered(
        "vertical_fov",
        question,
        move |&(angle, axis, width, height)| yours(angle, axis, width, height),
        mine,
    )
    .and_in("across the width", |world| {
        on_camera(world, PerspectiveCamera { fov: Degrees(90.0), axis: FovAxis::Horizontal })
    })
    .and_in("across the diagonal", |world| {
        on_camera(world, PerspectiveCamera { fov: Degrees(90.0), axis: FovAxis::Diagonal })
    })
    .and_in("across the smaller side", |world| {
        on_camera(world, PerspectiveCamera { fov: Degrees(90.0), axis: FovAxis::Smaller })
    })
}

fn question() -> Question<Input, f64> {
    Question {
        pinhole_has: ("src/pinhole/cameras/camera.rs", "half_extent"),
        probes: asked(),
        tell: |(angle, axis, width, height)| format!("angle {angle:?}°, axis {axis:?}, width {width}, height {height}"),
        right: |&(angle, axis, width, height)| {
            let camera = ExactCamera::new(width, height, angle, axis, DMat3::IDENTITY);
            degrees(camera.tan_half_vertical.to_f64())
        },
        apart: |yours, right| relative(&[*yours], &[*right]),
        allowed: 1e-10,
        measured: "of the angle",
        mistakes: mistakes(),
        hints: &[
            "at distance 1 the angle spans 2 tan(angle / 2) along its axis; how much is that along the height?",
            "half the height is tan(angle / 2) divided by how many heights its axis is long: 1, width / height, …, \
             and for the diagonal √(width² + height²) / height",
            "now from half the height at distance 1 back to an angle: which function undoes the tangent, and of \
             which part of the angle was it? It works in radians, and degrees go in and come out",
        ],
    }
}

fn mistakes() -> Mistakes<Input, f64> {
    let tangent = Part::<Input, f64>::new(|i| tan_half(Degrees(i.0)))
        .say("tan takes the degrees for radians")
        .when(|i| libm::tan(i.0 / 2.0))
        .say("the tangent is halved or the aspect doubled; they are in proportion as they are")
        .when(|i| tan_half(Degrees(i.0)) / 2.0)
        .say("sines are taken to be in proportion to the sides; on a plane tangents are")
        .when(|i| libm::sin(i.0.to_radians() / 2.0));
    let length = Part::<Input, f64>::new(across)
        .say("the tangent is multiplied by the aspect; the height is what is shorter")
        .when(|i| 1.0 / across(i))
        .say("the aspect divides whole numbers, 480 / 270 = 1: make them f64 first")
        .when(|i| heights(i.1, f64::from(i.2 / i.3)))
        .say("the aspect is height / width; it is width / height")
        .when(|i| heights(i.1, f64::from(i.3) / f64::from(i.2)))
        .say("the horizontal angle is taken for the vertical one, or its tangent multiplied by the aspect; it is divided")
        .when(|i| across(i) * instead(i, FovAxis::Horizontal, |_| 1.0))
        .when(|i| across(i) * instead(i, FovAxis::Horizontal, |aspect| 1.0 / aspect))
        .say("the vertical angle is changed; it is the answer itself")
        .when(|i| across(i) * instead(i, FovAxis::Vertical, |aspect| aspect))
        .when(|i| across(i) * instead(i, FovAxis::Vertical, |aspect| 1.0 / aspect));
    let diagonal = Part::<Input, f64>::new(|_| 1.0)
        .say("the diagonal is taken for something else: it is √(width² + height²) / height heights")
        .when(|i| instead(i, FovAxis::Diagonal, |_| 1.0))
        .when(|i| instead(i, FovAxis::Diagonal, |aspect| aspect))
        .when(|i| instead(i, FovAxis::Diagonal, |aspect| aspect + 1.0))
        .when(|i| instead(i, FovAxis::Diagonal, |aspect| (aspect + 1.0) / 2.0))
        .when(|i| instead(i, FovAxis::Diagonal, |aspect| aspect.sqrt()))
        .when(|i| instead(i, FovAxis::Diagonal, |_| libm::hypot(f64::from(i.2), f64::from(i.3))))
        .say("the diagonal is compared with the width; it is √(width² + height²) / height heights long")
        .when(|i| instead(i, FovAxis::Diagonal, |aspect| (aspect * aspect + 1.0).sqrt() / aspect))
        .say(
            "the diagonal is compared with another side than the height; it is √(width² + height²) / height heights \
             long",
        )
        .when(|i| instead(i, FovAxis::Diagonal, |aspect| (aspect * aspect + 1.0).sqrt() / aspect.max(1.0)))
        .when(|i| instead(i, FovAxis::Diagonal, |aspect| (aspect * aspect + 1.0).sqrt() / aspect.min(1.0)))
        .say("the square root of the diagonal is missing: it is √(width² + height²) / height heights long")
        .when(|i| instead(i, FovAxis::Diagonal, |aspect| aspect * aspect + 1.0))
        .say("the diagonal's tangent is multiplied by its length in heights; it is divided")
        .when(|i| instead(i, FovAxis::Diagonal, |aspect| 1.0 / (aspect * aspect + 1.0).sqrt()))
        .say("the diagonal's squares do not fit in u32: make width and height f64 first")
        .when(|i| {
            let squares = i.2.wrapping_mul(i.2).wrapping_add(i.3.wrapping_mul(i.3));
            instead(i, FovAxis::Diagonal, |_| f64::from(squares).sqrt() / f64::from(i.3))
        })
        .say("the diagonal is taken to be √2 heights, as in a square; it is √(width² + height²), over the height")
        .when(|i| instead(i, FovAxis::Diagonal, |_| SQRT_2));
    let sides = Part::<Input, f64>::new(|_| 1.0)
        .say("the smaller and the larger side are swapped: of a wide image the height is the smaller")
        .when(|i| both(i, |aspect| aspect.max(1.0), |aspect| aspect.min(1.0)))
        .say("the smaller and the larger side are taken to be the height and the width")
        .when(|i| both(i, |_| 1.0, |aspect| aspect))
        .say("the smaller and the larger side are taken to be the width and the height")
        .when(|i| both(i, |aspect| aspect, |_| 1.0))
        .say("the smaller or the larger side is always taken for the same one; which is which depends on the image")
        .when(|i| instead(i, FovAxis::Smaller, |_| 1.0))
        .when(|i| instead(i, FovAxis::Smaller, |aspect| aspect.max(1.0 / aspect)))
        .when(|i| instead(i, FovAxis::Smaller, |aspect| aspect))
        .when(|i| instead(i, FovAxis::Smaller, |aspect| aspect.min(1.0 / aspect)))
        .when(|i| instead(i, FovAxis::Smaller, |aspect| 1.0 / aspect.min(1.0)))
        .when(|i| instead(i, FovAxis::Larger, |aspect| aspect))
        .when(|i| instead(i, FovAxis::Larger, |_| 1.0))
        .when(|i| instead(i, FovAxis::Larger, |aspect| aspect.max(1.0 / aspect)))
        .when(|i| instead(i, FovAxis::Larger, |aspect| 1.0 / aspect.max(1.0)))
        .when(|i| instead(i, FovAxis::Larger, |aspect| aspect.min(1.0)));
    let whole = Part::<[f64; 4], f64>::new(|of| degrees(half_height(of)))
        .say("the answer is in radians; degrees are asked for")
        .when(|of| 2.0 * libm::atan(half_height(of)))
        .say("the answer is half the angle")
        .when(|of| libm::atan(half_height(of)).to_degrees())
        .say("this is the tangent of half the angle; the angle is asked for")
        .when(half_height)
        .say("the tangent is taken for an angle; atan leads back to it")
        .when(|of| (2.0 * half_height(of)).to_degrees());
    Mistakes::<Input, f64>::new()
        .asked_as_given()
        .say("the angle is handed back as it is, whatever it is measured across")
        .when(|i| i.0)
        .say("the angle itself is divided by the aspect; it is the tangent of its half that scales")
        .when(|i| i.0 / across(i))
        .say("the angle itself is multiplied by the aspect; it is the tangent of its half that scales, and it is divided")
        .when(|i| i.0 * across(i))
        .say("tan takes the degrees for radians, and atan's radians are taken for degrees")
        .when(|i| 2.0 * libm::atan(libm::tan(i.0 / 2.0) / across(i)))
        .say("the tangent is taken of the full angle; the triangle at the eye has half of it")
        .when(|i| libm::atan(libm::tan(i.0.to_radians()) / across(i)).to_degrees())
        .when(|i| (i.0.to_radians().tan() / across(i)).atan().to_degrees())
        .when(|i| degrees(libm::tan(i.0.to_radians()) / across(i)))
        .when(|i| degrees(i.0.to_radians().tan() / across(i)))
        .say("sines are taken to be in proportion to the sides; on a plane tangents are")
        .when(|i| 2.0 * libm::asin((libm::sin(i.0.to_radians() / 2.0) / across(i)).min(1.0)).to_degrees())
        .when(|i| 2.0 * libm::asin(libm::sin(i.0.to_radians() / 2.0) / across(i)).to_degrees())
        .say("cosines are taken to be in proportion to the sides; on a plane tangents are")
        .when(|i| 2.0 * libm::acos(libm::cos(i.0.to_radians() / 2.0) / across(i)).to_degrees())
        .say("only the horizontal angle is changed; the other axes have lengths of their own, too")
        .when(|i| if i.1 == FovAxis::Horizontal { degrees(tan_half(Degrees(i.0)) / across(i)) } else { i.0 })
        .of_parts([tangent, length, diagonal, sides], whole)
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

fn across(&(_, axis, width, height): &Input) -> f64 {
    heights(axis, f64::from(width) / f64::from(height))
}

/// The full angle, in degrees, whose half has this tangent.
fn degrees(tangent: f64) -> f64 {
    2.0 * libm::atan(tangent) * (180.0 / PI)
}

/// How much longer than it is an axis is taken to be; nothing of the others.
fn instead(input: &Input, axis: FovAxis, heights: impl Fn(f64) -> f64) -> f64 {
    if input.1 == axis { heights(f64::from(input.2) / f64::from(input.3)) / across(input) } else { 1.0 }
}

/// The same of the smaller and of the larger side.
fn both(input: &Input, smaller: fn(f64) -> f64, larger: fn(f64) -> f64) -> f64 {
    instead(input, FovAxis::Smaller, smaller) * instead(input, FovAxis::Larger, larger)
}

/// Half the image's height on the plane at distance 1.
fn half_height(&[tangent, length, diagonal, sides]: &[f64; 4]) -> f64 {
    tangent / (length * diagonal * sides)
}

/// How many image heights long the axis is.
fn heights(axis: FovAxis, aspect: f64) -> f64 {
    match axis {
        FovAxis::Vertical => 1.0,
        FovAxis::Horizontal => aspect,
        FovAxis::Smaller => aspect.min(1.0),
        FovAxis::Larger => aspect.max(1.0),
        FovAxis::Diagonal => (aspect * aspect + 1.0).sqrt(),
    }
}

/// Directions of camera rays, by the vertical angle that the reader's function makes of the scene's.
fn mine(ask: Ask<Input, f64>, setting: &Setting<'_>) -> StandIn {
    let size = setting.resolution();
    let PerspectiveCamera { fov, axis } = setting.camera().copied().unwrap_or_default();
    StandIn::after(rays::perspective_stage, move |mut tiles: Query<(RowPlaces, &ScreenPoints, &mut CameraRays)>| {
        for (place, screen, mut rays) in &mut tiles {
            let Some(vertical) = ask.at(place, 0, (fov.0, axis, size.width, size.height)) else { continue };
            let tangent = tan_half(Degrees(vertical));
            for row in 0..screen.rows() {
                let direction = camera_ray_perspective(screen.point(row), tangent);
                rays.direction.put(row, direction);
            }
        }
    })
}
