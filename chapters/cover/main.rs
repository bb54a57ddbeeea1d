//! The cover: what following light makes possible, in one picture.
//! A globe of glass focuses a light beside it; mirrors, metal and matte seeds stand around, near the lens and far.
//! Each seed stands a golden angle further round than the last, as in a sunflower.

use bevy_ecs::prelude::*;
use pinhole::scene::*;
use pinhole::{Chapter, stages};
use std::process::ExitCode;

fn main() -> ExitCode {
    pinhole::run(chapter())
}

// ANCHOR: chapter
/// The scene, and the stages on offer.
pub fn chapter() -> Chapter {
    Chapter::new("cover", "the cover: glass, mirrors and metal, in and out of focus, under an area light", scene)
        .offer(stages::all())
}
// ANCHOR_END: chapter

/// π (3 − √5): the angle that never lets two seeds stand behind one another.
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

// ANCHOR: scene
fn scene(world: &mut World) {
    let look = LookAt { eye: [0.0, 3.8, 11.0].into(), target: [0.1, 0.8, 0.3].into(), ..LookAt::default() };
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(30.0), axis: FovAxis::Vertical },
        look,
        Lens { aperture: Aperture::Radius { radius: 0.16 }, focus_distance: 9.8, ..Lens::default() },
        Resolution { width: 960, height: 540 },
        Sampling { samples: 80, ..Sampling::default() },
        // Paths that survive roulette count for more, and one that then hits the light is a speck: so roulette begins late.
        Integrator::Path { max_depth: 1 << 12, lights: LightStrategy::Mis, roulette: 8 },
        // What the globe shows of the light that it focuses is found by photons only.
        PhotonMapping { paths: 0.25, ..PhotonMapping::default() },
    ));
    world.spawn((Name::new("globe"), Sphere { radius: 1.5 }, Placement::at(0.0, 1.5, 0.0), Glass::default()));
    for seed in 0..55 {
        let (turn, ring) = (f64::from(seed) * GOLDEN_ANGLE, 2.0 + 0.0815 * f64::from(seed));
        let radius = 0.2 + 0.0046 * f64::from(seed);
        let place = Placement::at(ring * libm::cos(turn), radius, ring * libm::sin(turn));
        let colour = seed_colour(f64::from(seed) / 54.0);
        let mut sphere = world.spawn((Name::new(format!("seed {seed}")), Sphere { radius }, place));
        match seed {
            _ if seed % 5 == 3 => sphere.insert(Mirror { colour: Rgb::new(0.9, 0.9, 0.92) }),
            _ if seed % 6 == 2 => sphere.insert(Metal { colour: blend(colour, CREAM, 0.5), ..ROUGH }),
            _ => sphere.insert(Matte { colour }),
        };
    }
    world.spawn((Name::new("ground"), Plane::default(), Matte { colour: Rgb::new(0.52, 0.5, 0.47) }));
    // Large and dim: what mirrors and glass show of the light is found only by paths that happen to hit it, and where one
    // in 80 does, it must not whiten the pixel.
    let shine = Emissive { radiance: Rgb::new(7.0, 6.0, 4.8), ..Emissive::default() };
    world.spawn((Name::new("lamp"), Sphere { radius: 4.7 }, Placement::at(-6.0, 10.0, -9.0), shine));
    let dusk = Gradient { bottom: Rgb::new(0.02, 0.022, 0.03), top: Rgb::new(0.14, 0.2, 0.36) };
    world.spawn((Name::new("dusk"), dusk));
}
// ANCHOR_END: scene

const ROUGH: Metal = Metal { colour: CREAM, roughness: 0.3, multiple_scattering: true };
const CREAM: Rgb = Rgb::new(1.0, 0.9, 0.7);
const EMBER: Rgb = Rgb::new(0.82, 0.2, 0.07);
const GOLD: Rgb = Rgb::new(0.86, 0.58, 0.16);
const TEAL: Rgb = Rgb::new(0.06, 0.34, 0.38);

/// From ember through gold to teal, the further out.
fn seed_colour(t: f64) -> Rgb {
    if t < 0.5 { blend(EMBER, GOLD, 2.0 * t) } else { blend(GOLD, TEAL, 2.0 * t - 1.0) }
}

/// A blend of two colours, from 0, all of the first, to 1.
fn blend(from: Rgb, to: Rgb, t: f64) -> Rgb {
    let [r, g, b] = (from.to_vec() * (1.0 - t) + to.to_vec() * t).to_array();
    Rgb::new(r, g, b)
}
