//! Chapter 27: what a pixel gets of a point's light.

use bevy_ecs::prelude::*;
use glam::{DMat3, DVec2, DVec3};
use pinhole::extract::CameraJoinTable;
use pinhole::plan::{Column, Shared, VectorRowsMut};
use pinhole::rays::join_camera;
use pinhole::shade;
use pinhole::shade::ShadowRays;
use pinhole_lab::exercise::apart::relative;
use pinhole_lab::exercise::{Ask, Exercise, Mistakes, Part, Probe, Question, Setting, Shown, StandIn, probes};
use pinhole_lab::measure::draws::Draws;

type Input = ([f64; 3], f64, f64);

/// What the reader writes.
pub type Yours = fn([f64; 3], f64, f64) -> f64;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered(
        "pixel_fraction",
        question,
        move |&(point, tan_half, height)| yours(point, tan_half, height),
        mine,
    )
    .and_in("off the axis, and behind", |_| ())
}

fn question() -> Question<Input, f64> {
    Question {
        pinhole_has: ("src/pinhole/rays/project.rs", "join_camera"),
        probes: asked(),
        tell: |(point, tan_half, height)| {
            format!("point {}, tan_half {}, height {}", point.shown(), tan_half.shown(), height.shown())
        },
        right: |&(point, tan_half, height)| {
            let join = CameraJoinTable {
                camera_from_world: DMat3::IDENTITY,
                is_perspective: true,
                half_height: tan_half,
                focus_distance: f64::INFINITY,
                size: DVec2::splat(height),
                // Every pixel that there could be.
                margin: f64::INFINITY,
            };
            join_camera(&join, DVec2::ZERO, DVec3::from(point)).map_or(0.0, |joined| joined.importance)
        },
        apart: |yours, right| relative(&[*yours], &[*right]),
        allowed: 1e-10,
        measured: "of the fraction",
        mistakes: mistakes(),
        hints: &[
            "on the axis θ is 0, and the fraction is 1 / (A d²)",
            "the pixel's side on the plane at distance 1 is 2 tan_half / height, and A is its square",
            "cos θ is the depth over the distance; so how does the fraction grow towards the picture's edge, and \
             what is it behind the eye?",
        ],
    }
}

fn mistakes() -> Mistakes<Input, f64> {
    let ahead = Part::<Input, f64>::new(|i| f64::from(u8::from(i.0[2] < 0.0)))
        .say("a point behind the eye counts; it reaches no pixel, so the fraction is 0")
        .when(|_| 1.0)
        .when(|i| -i.0[2].signum())
        .say("the camera looks down −z: the depth is −z, and what has a z above 0 is behind it")
        .when(|i| if i.0[2] > 0.0 { -1.0 } else { 0.0 })
        .when(|_| -1.0);
    let area = Part::<Input, f64>::new(|i| side(i) * side(i))
        .say("A is the area of a pixel, its side squared")
        .when(side)
        .say("the pixel's area A is missing: a smaller pixel gathers from fewer directions")
        .when(|_| 1.0)
        .say("the fraction is multiplied by the pixel's area A; it is 1 / (A d² cos³ θ)")
        .when(|i| side(i).powi(-2))
        .say("tan_half is taken for an angle, or an angle is made of it; it is a tangent already")
        .when(|i| side(&(i.0, 2.0 * libm::atan(i.1), i.2)).powi(2))
        .when(|i| side(&(i.0, libm::atan(i.1), i.2)).powi(2))
        .when(|i| side(&(i.0, libm::tan(i.1), i.2)).powi(2))
        .say("height − 1 pixels are taken for height; the plane holds all of them")
        .when(|i| side(&(i.0, i.1, i.2 - 1.0)).powi(2))
        .say("the plane at distance 1 is 2 tan_half high, not tan_half")
        .when(|i| side(i) * side(i) / 4.0)
        .say("the plane at distance 1 is 2 tan_half high, not 4 tan_half")
        .when(|i| 4.0 * side(i) * side(i))
        .say(
            "there are height² pixels on the plane, as it is height of them wide and high: A is (2 tan_half / \
                 height)²",
        )
        .when(|i| side(i) * side(i) * i.2)
        .when(|i| side(i) * side(i) * i.2 * i.2);
    let squared = Part::<Input, f64>::new(|i| distance(i).powi(2))
        .say("1/d² is missing: light thins out with the distance")
        .when(|_| 1.0)
        .say("d counts once, or its root is missing: light thins out with d², which is x² + y² + z²")
        .when(distance)
        .say("d² is squared once more")
        .when(|i| distance(i).powi(4))
        .say("d² cos³ θ is taken for (−z)³; as cos θ is −z / d, it is (−z)³ / d")
        .when(|i| distance(i).powi(3));
    let cosines = Part::<Input, f64>::new(|i| cosine(i).powi(3))
        .say(
            "cos⁴ is taken; it is cos³: the fourth belongs to an opening, which is seen obliquely too, and an \
                 eye is a point",
        )
        .when(|i| cosine(i).powi(4))
        .say("cos² is taken; it is cos³: the depth is d cos θ, so 1 / (A d² cos³ θ) is more than 1 / (A depth²)")
        .when(|i| cosine(i).powi(2))
        .say("cos is taken; it is cos³: 1/d² is not yet all that the angle does")
        .when(cosine)
        .say("cos³ θ is missing: a pixel off the axis fills a smaller solid angle")
        .when(|_| 1.0)
        .say("the depth −z is taken for d, which is the distance to the eye")
        .when(|i| cosine(i).powi(5))
        .say(
            "the fraction is multiplied by the cosines; off the axis a pixel fills a smaller solid angle, so \
                 divide by cos³ θ",
        )
        .when(|i| cosine(i).powi(-3))
        .when(|i| cosine(i).powi(-4))
        .when(|i| cosine(i).powi(-1))
        .say("the angle θ is that off the axis, of x and y together: cos θ = −z / d")
        .when(|i| (-i.0[2] / libm::hypot(i.0[1], i.0[2])).powi(3))
        .when(|i| (-i.0[2] / libm::hypot(i.0[0], i.0[2])).powi(3))
        .say("the sine is taken for the cosine: cos θ = −z / d")
        .when(|i| (1.0 - cosine(i).powi(2)).max(0.0).sqrt().powi(3))
        .say("cos θ is −z / d, not −z")
        .when(|i| (-i.0[2]).powi(3));
    let whole = Part::<[f64; 4], f64>::new(
        |&[ahead, area, squared, cosines]| {
            if ahead == 0.0 { 0.0 } else { ahead / (area * squared * cosines) }
        },
    )
    .say("that is A d² cos³ θ; the fraction is one over it")
    .when(|&[ahead, area, squared, cosines]| ahead * area * squared * cosines);
    Mistakes::<Input, f64>::new().of_parts([ahead, area, squared, cosines], whole)
}

fn asked() -> Vec<Probe<Input>> {
    let mut asked: Vec<_> =
        probes("straight ahead", [([0.0, 0.0, -1.0], 1.0, 2.0), ([0.0, 0.0, -3.0], 0.7, 100.0)]).collect();
    let of = |seed, count: u64, widest: f64, size: f64| {
        (0..count).map(move |at| {
            let mut draws = Draws::new(seed, at);
            let depth = draws.power_of_ten(-size, size);
            let (x, y) = (draws.between(-widest, widest) * depth, draws.between(-widest, widest) * depth);
            ([x, y, -depth], draws.power_of_ten(-1.5, 0.5), draws.between(2.0, 2000.0).floor())
        })
    };
    asked.extend(probes("before the camera", of(2741, 40, 0.8, 1.0)));
    asked.extend(probes("far off the axis", of(2742, 30, 6.0, 1.0)));
    asked.extend(probes("very near and very far", of(2743, 30, 1.0, 8.0)));
    let behind = of(2744, 10, 1.0, 1.0).map(|([x, y, z], tan_half, height)| ([x, y, -z], tan_half, height));
    asked.extend(probes("behind the camera", behind));
    asked
}

fn distance(input: &Input) -> f64 {
    DVec3::from(input.0).length()
}

fn cosine(input: &Input) -> f64 {
    -input.0[2] / distance(input)
}

fn side(&(_, tan_half, height): &Input) -> f64 {
    2.0 * tan_half / height
}

/// What pixels get of the light that reaches a surface from a light; rows are paths here, and no pixel is known yet.
fn mine(ask: Ask<Input, f64>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    StandIn::after(
        shade::camera_join_stage,
        move |camera: Res<Shared<CameraJoinTable>>, mut tiles: Query<&mut ShadowRays>| {
            for mut rays in &mut tiles {
                for ray in 0..rays.rows() {
                    let from = rays.origin(ray).as_dvec3();
                    let Some(joined) = join_camera(&camera, DVec2::ZERO, from) else { continue };
                    let point = (camera.camera_from_world * from).into();
                    let asked = (point, camera.half_height, camera.size.y);
                    let Some(fraction) = ask.once(asked) else { continue };
                    let more = (fraction / joined.importance) as f32;
                    rays.irradiance.scale(ray, [more; 3]);
                }
            }
        },
    )
}

/// Points up to 4 to either side of the axis, from 3 ahead at the top to 1 behind the eye at the bottom.
fn painted(ask: Ask<Input, f64>) -> StandIn {
    StandIn::painted([64, 32], move |[x, y]| {
        let point = [(f64::from(x) - 31.5) / 8.0, 0.3, -3.0 + (f64::from(y) + 0.5) / 8.0];
        let fraction = ask.once((point, 0.5, 1.0)).unwrap_or_default();
        [fraction / (1.0 + fraction); 3]
    })
}
