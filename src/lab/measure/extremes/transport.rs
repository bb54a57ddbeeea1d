//! Transport: do light paths carry what theory says, and do two strategies to find a light count as one?

use super::{Group, Method, Tally, Trial};
use crate::measure::draws::Draws;
use crate::naive::path::{
    light_of_capped_path, power_heuristic_f32, uniform_direction, weight_without_cosine, weight_without_pi,
};
use pinhole::follow::{power_heuristic, survival_probability};
use pinhole::material::{cosine_direction, cosine_pdf};
use std::f64::consts::PI;
use std::ops::Range;

/// Ways of each furnace.
const PATHS: u64 = 4096;
/// Directions of each sky.
const DIRECTIONS: u64 = 1 << 16;
/// How many standard errors a mean may lie from the truth.
const ERRORS: f64 = 4.0;
/// The depth at which a naive path is cut off.
const CAP: u32 = 64;

const WEIGHTS: [Method; 2] = [
    Method::pinhole("pinhole, the ratio squared", "off 1", 2.0 * f64::EPSILON),
    Method::naive("naive, squares in f32", "off 1", 1e-6),
];
const ROULETTE: [Method; 3] = [
    Method::pinhole("pinhole, Russian roulette, reweighted", "of itself", 0.0),
    Method::naive("naive, ends after 64 segments", "of itself", 0.0),
    Method::naive("naive, Russian roulette, not reweighted", "of itself", 0.0),
];
const SKY: [Method; 4] = [
    Method::pinhole("pinhole, cosine-weighted", "of itself", 1e-10),
    Method::naive("naive, directions alike, no cosine", "of itself", 1e-10),
    Method::naive("naive, pi forgotten", "of itself", 1e-10),
    Method::naive("naive, cosine counted twice", "of itself", 1e-10),
];
const LIGHT: [Method; 3] = [
    Method::pinhole("pinhole, cosine-weighted", "of all", 0.01),
    Method::naive("naive, pdf of other directions", "of all", 0.01),
    Method::naive("naive, Jacobian forgotten", "of all", 0.01),
];

/// The cases of the group.
pub fn trials() -> Vec<Trial> {
    let furnace = |(name, albedo): (&str, f64)| {
        // The lengths of paths have a standard deviation of √a of their mean, and so have means of many √a / √n.
        let bound = ERRORS * (albedo / PATHS as f64).sqrt();
        let methods = ROULETTE.map(|method| Method { bound, ..method });
        Trial::new(Group::Transport, name, &methods, move |range| check_roulette(albedo, range)).at_most(1)
    };
    let furnaces = [("furnace, albedo 0.5", 0.5), ("furnace, albedo 0.99", 0.99), ("furnace, albedo 0.9999", 0.9999)];
    let mut trials = vec![Trial::new(Group::Transport, "weights of two, 1e-30 to 1e30", &WEIGHTS, check_weights)];
    trials.extend(furnaces.map(furnace));
    trials.push(Trial::new(Group::Transport, "one surface under an even sky", &SKY, check_sky).at_most(8));
    trials.push(
        Trial::new(Group::Transport, "one surface under a light, 10 to 80 degrees", &LIGHT, check_light).at_most(8),
    );
    trials
}

/// Whether the weights of the two ways to find the same light are 1 together.
fn check_weights(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(WEIGHTS.len());
    for index in range {
        let mut draws = Draws::new(2605, index);
        let [own, other] = [0; 2].map(|_| draws.power_of_ten(-30.0, 30.0));
        tally.count(true);
        tally.scores[0].measure((power_heuristic(own, other) + power_heuristic(other, own) - 1.0).abs());
        let [own, other] = [own as f32, other as f32];
        let both = power_heuristic_f32(own, other) + power_heuristic_f32(other, own);
        tally.scores[1].measure(f64::from((both - 1.0).abs()));
    }
    tally
}

/// The light of paths in a closed room, over what it is by theory.
fn check_roulette(albedo: f64, range: Range<u64>) -> Tally {
    let mut tally = Tally::new(ROULETTE.len());
    let truth = 1.0 / (1.0 - albedo);
    for _ in range {
        let (mut reweighted, mut unweighted) = (0.0, 0.0);
        for path in 0..PATHS {
            reweighted += light_of_path(albedo, path, |throughput, survival| throughput / survival);
            unweighted += light_of_path(albedo, path, |throughput, _| throughput);
        }
        tally.count(true);
        let means = [reweighted / PATHS as f64, light_of_capped_path(albedo, CAP), unweighted / PATHS as f64];
        for (score, mean) in tally.scores.iter_mut().zip(means) {
            score.measure((mean / truth - 1.0).abs());
        }
    }
    tally
}

/// What one path carries that ends by Russian roulette; `kept` is the throughput of one that goes on.
fn light_of_path(albedo: f64, path: u64, kept: impl Fn(f64, f64) -> f64) -> f64 {
    let mut draws = Draws::new(2503, path);
    let (mut light, mut throughput) = (0.0, 1.0);
    loop {
        light += throughput;
        throughput *= albedo;
        let survival = survival_probability([throughput; 3]);
        if draws.unit() >= survival {
            return light;
        }
        throughput = kept(throughput, survival);
    }
}

/// What a surface of albedo 0.8 sends on of a sky that is 1 everywhere.
fn check_sky(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(SKY.len());
    let albedo = 0.8;
    for index in range {
        let mut sums = [0.0; 4];
        for number in 0..DIRECTIONS {
            let mut draws = Draws::new(2504 + index, number);
            let u = [draws.unit(), draws.unit()];
            let cosine = cosine_direction(u).z;
            let sent = albedo / PI * cosine / cosine_pdf(cosine);
            let answers = [sent, weight_without_cosine(albedo), weight_without_pi(albedo), sent * cosine];
            sums.iter_mut().zip(answers).for_each(|(sum, answer)| *sum += answer);
        }
        tally.count(true);
        for (score, sum) in tally.scores.iter_mut().zip(sums) {
            score.measure((sum / DIRECTIONS as f64 / albedo - 1.0).abs());
        }
    }
    tally
}

/// What a white surface receives from a round patch of the sky, 1 within an angle from the zenith: its sine squared.
fn check_light(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(LIGHT.len());
    for index in range {
        let angle = (10.0 + 10.0 * index as f64).to_radians();
        let edge = libm::cos(angle);
        let exact = libm::sin(angle) * libm::sin(angle);
        let (mut sums, count) = ([0.0; 3], DIRECTIONS as f64);
        for number in 0..DIRECTIONS {
            let mut draws = Draws::new(2606 + index, number);
            let u = [draws.unit(), draws.unit()];
            let seen = |cosine: f64| f64::from(u8::from(cosine > edge));
            let (dense, alike) = (cosine_direction(u).z, uniform_direction(u)[2]);
            sums[0] += seen(dense);
            // Uniform directions, divided by the pdf of others: the cosines cancel as if directions were cosine-weighted.
            sums[1] += seen(alike);
            // Uniform angles: the sine that makes areas of the sky of them is forgotten.
            let theta = u[0] * PI / 2.0;
            sums[2] += seen(libm::cos(theta)) * libm::cos(theta) * PI;
        }
        tally.count(true);
        for (score, sum) in tally.scores.iter_mut().zip(sums) {
            score.measure((sum / count - exact).abs());
        }
    }
    tally
}
