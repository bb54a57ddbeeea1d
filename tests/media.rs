//! Participating media, held against closed forms and against quadrature.
//!
//! All pixels of a picture have one expected value here, so that their spread says how well it is known.
//!
//! `PINHOLE_TEST_SAMPLES=16 cargo test --test renderer media -- --nocapture` takes 16 times as many samples, and says how
//! well each mean is known.

#[path = "media/bodies.rs"]
mod bodies;
#[path = "media/density.rs"]
mod density;
#[path = "media/lights.rs"]
mod lights;
#[path = "media/refused.rs"]
mod refused;
#[path = "media/slabs.rs"]
mod slabs;

use crate::follow::times_samples;
use crate::scenes::{named, offer};
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::material::henyey_greenstein;
use pinhole::render::{Execution, render};
use pinhole::scene::*;

/// The pixels of a picture along each side.
const SIDE: u32 = 16;

/// A camera at `eye` that looks along `ahead` and sees next to nothing but one ray.
fn one_ray(world: &mut World, eye: DVec3, ahead: DVec3, samples: u32, max_depth: u32) -> Entity {
    let up = if ahead.x == 0.0 && ahead.z == 0.0 { DVec3::X } else { DVec3::Y };
    let look = LookAt { eye, target: eye + ahead, up };
    let integrator = Integrator::Path { max_depth, lights: LightStrategy::Mis, roulette: 5 };
    let size = Resolution { width: SIDE, height: SIDE };
    let camera = OrthographicCamera { view_height: 1e-5 };
    let sampling = Sampling { samples: samples * times_samples(), ..Sampling::default() };
    world.spawn((Name::new("camera"), camera, look, size, sampling, integrator)).id()
}

/// The mean of a picture whose pixels have one expected value, colour by colour, and its standard error.
#[derive(Clone, Copy, Debug)]
struct Measured {
    mean: [f64; 3],
    error: [f64; 3],
}

impl Measured {
    fn of(world: &World) -> Self {
        let film = render(world, &offer(), &Execution::default(), &()).expect("renders").film;
        assert_eq!(film.rejected().0, 0, "samples that are no numbers");
        let pixels: Vec<[f64; 3]> = film.means().into_iter().map(|rgb| rgb.map(f64::from)).collect();
        let count = pixels.len() as f64;
        let mean = [0, 1, 2].map(|part| pixels.iter().map(|rgb| rgb[part]).sum::<f64>() / count);
        let squares = [0, 1, 2]
            .map(|part: usize| pixels.iter().map(|rgb| (rgb[part] - mean[part]).powi(2)).sum::<f64>() / (count - 1.0));
        Self { mean, error: squares.map(|square| (square / count).sqrt()) }
    }

    /// Asserts that it is within 4 standard errors of the truth, and known to `known` of it; returns the greatest
    /// deviation in standard errors.
    fn check(&self, what: &str, truth: [f64; 3], known: f64) -> f64 {
        let mut worst = 0.0_f64;
        for part in 0..3 {
            // Where all paths have one weight, the rounding of the film to f32 is all that is left.
            let error = self.error[part].max(3e-7 * truth[part]);
            let off = (self.mean[part] - truth[part]) / error.max(f64::MIN_POSITIVE);
            worst = worst.max(off.abs());
            let told = format!("{what}: {:?} ± {:?} for {truth:?}", self.mean, self.error);
            assert!(off.abs() <= 4.0 || self.mean[part] == truth[part], "{told}, {off:+.1} standard errors off");
            if times_samples() > 1 && truth[part] > 0.0 {
                eprintln!(
                    "{what}: {:.4} % known to {:.4} %",
                    100.0 * (self.mean[part] / truth[part] - 1.0),
                    100.0 * error / truth[part]
                );
            }
            assert!(self.error[part] <= known * truth[part], "{told}: known to less than {known}");
        }
        worst
    }
}

/// e^(−τ) of each colour.
fn transmittance(depth: [f64; 3]) -> [f64; 3] {
    depth.map(|depth| (-depth).exp())
}

/// The Henyey–Greenstein function of an angle by its cosine.
fn phase(g: f64, cosine: f64) -> f64 {
    henyey_greenstein(g, 1.0 - cosine)
}

/// The integral of a function over an interval, by Gauss and Legendre's rule of five points on many parts.
fn integral(from: f64, to: f64, of: impl Fn(f64) -> f64) -> f64 {
    const NODES: [(f64, f64); 5] = [
        (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
        (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
        (0.0, 0.568_888_888_888_888_9),
        (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
        (0.906_179_845_938_664, 0.236_926_885_056_189_08),
    ];
    let (parts, mut sum) = (2000, 0.0);
    let half = 0.5 * (to - from) / f64::from(parts);
    for part in 0..parts {
        let middle = from + (2.0 * f64::from(part) + 1.0) * half;
        sum += NODES.iter().map(|(node, weight)| weight * of(middle + node * half)).sum::<f64>() * half;
    }
    sum
}

/// A colour of three parts.
fn rgb([r, g, b]: [f64; 3]) -> Rgb {
    Rgb::new(r, g, b)
}
