//! Typical wrong solutions of chapter 25, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::after_roulette;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(after_roulette)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|s, u| if u < random(s) { s } else { [0.0; 3] }), "is lost"),
        (exercise(|s, _| s.map(|part| part / random(s))), "nothing ever ends"),
        (exercise(|s, u| if u < random(s) { [0.0; 3] } else { divided(s, random(s)) }), "two ends are swapped"),
        (exercise(without_most), "at most 1"),
        (exercise(by_mean), "mean of the three"),
        (exercise(by_green), "green alone"),
        (exercise(|s, u| s.map(|part| if u < part { part.max(1.0) } else { 0.0 })), "each colour"),
    ]
}

fn divided(v: [f64; 3], by: f64) -> [f64; 3] {
    v.map(|part| part / by)
}

fn s(keep: bool, part: f64) -> f64 {
    if keep { part } else { -part }
}

fn random(share: [f64; 3]) -> f64 {
    without_cap(share).min(1.0)
}

fn without_cap(share: [f64; 3]) -> f64 {
    share[0].max(share[1]).max(share[2])
}

fn kept_with(random: f64, share: [f64; 3], u: f64) -> [f64; 3] {
    if u < random { divided(share, random) } else { [0.0; 3] }
}

fn without_most(share: [f64; 3], u: f64) -> [f64; 3] {
    kept_with(without_cap(share), share, u)
}

fn by_mean(share: [f64; 3], u: f64) -> [f64; 3] {
    kept_with(((share[0] + share[1] + share[2]) / 3.0).min(1.0), share, u)
}

fn by_green(share: [f64; 3], u: f64) -> [f64; 3] {
    kept_with(share[1].min(1.0), share, u)
}
