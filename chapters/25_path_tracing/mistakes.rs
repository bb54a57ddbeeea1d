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
        (exercise(|s, u| if u < survival(s) { s } else { [0.0; 3] }), "is lost"),
        (exercise(|s, _| s.map(|part| part / survival(s))), "nothing ever ends"),
        (exercise(|s, u| if u < survival(s) { [0.0; 3] } else { divided(s, survival(s)) }), "two ends are swapped"),
        (exercise(without_most), "at most 1"),
        (exercise(by_mean), "mean of the three"),
        (exercise(by_green), "green alone"),
        (exercise(|s, u| s.map(|part| if u < part { part.max(1.0) } else { 0.0 })), "each colour"),
    ]
}

fn divided(v: [f64; 3], by: f64) -> [f64; 3] {
    v.map(|part| part / by)
}

fn survival(throughput: [f64; 3]) -> f64 {
    without_cap(throughput).min(1.0)
}

fn without_cap(throughput: [f64; 3]) -> f64 {
    throughput[0].max(throughput[1]).max(throughput[2])
}

fn kept_with(survival: f64, throughput: [f64; 3], u: f64) -> [f64; 3] {
    if u < survival { divided(throughput, survival) } else { [0.0; 3] }
}

fn without_most(throughput: [f64; 3], u: f64) -> [f64; 3] {
    kept_with(without_cap(throughput), throughput, u)
}

fn by_mean(throughput: [f64; 3], u: f64) -> [f64; 3] {
    kept_with(((throughput[0] + throughput[1] + throughput[2]) / 3.0).min(1.0), throughput, u)
}

fn by_green(throughput: [f64; 3], u: f64) -> [f64; 3] {
    kept_with(throughput[1].min(1.0), throughput, u)
}
