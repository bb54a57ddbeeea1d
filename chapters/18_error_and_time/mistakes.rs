//! Typical wrong solutions of chapter 18, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::variance_and_bias_squared;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(variance_and_bias_squared)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|x, t| split(x, t, 1.0, squared_mean)), "part of the variance"),
        (exercise(|x, t| split(x, t, 0.0, of_pairs)), "one less is right"),
        (exercise(|x, t| split(x, t, 1.0, |x| of_pairs(x).max(0.0))), "cut off"),
        (exercise(one_run_has_no_variance), "None"),
        (exercise(about_the_truth), "runs' own mean"),
        (exercise(squares_less_square), "rounding"),
    ]
}

fn less_truth(runs: &[f64], truth: f64) -> Vec<f64> {
    runs.iter().map(|run| run - truth).collect()
}

fn squared_mean(off: &[f64]) -> f64 {
    (off.iter().sum::<f64>() / off.len() as f64).powi(2)
}

fn of_pairs(off: &[f64]) -> f64 {
    let (n, sum) = (off.len() as f64, off.iter().sum::<f64>());
    (sum * sum - off.iter().map(|off| off * off).sum::<f64>()) / (n * (n - 1.0))
}

fn spread(off: &[f64], fewer: f64) -> f64 {
    let mean = off.iter().sum::<f64>() / off.len() as f64;
    off.iter().map(|off| (off - mean).powi(2)).sum::<f64>() / (off.len() as f64 - fewer)
}

fn split(runs: &[f64], truth: f64, fewer: f64, bias: fn(&[f64]) -> f64) -> Option<[f64; 2]> {
    let off = less_truth(runs, truth);
    (runs.len() > 1).then(|| [spread(&off, fewer), bias(&off)])
}

fn one_run_has_no_variance(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
    let off = less_truth(runs, truth);
    match runs.len() {
        0 => Some([0.0, 0.0]),
        1 => Some([0.0, off[0] * off[0]]),
        _ => Some([spread(&off, 1.0), of_pairs(&off)]),
    }
}

fn about_the_truth(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
    let off = less_truth(runs, truth);
    (runs.len() > 1).then(|| [off.iter().map(|off| off * off).sum::<f64>() / (off.len() as f64 - 1.0), of_pairs(&off)])
}

fn squares_less_square(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
    let n = runs.len() as f64;
    let squares = runs.iter().map(|run| run * run).sum::<f64>() / n;
    let variance = (squares - squared_mean(runs)) * n / (n - 1.0);
    (runs.len() > 1).then(|| [variance, of_pairs(&less_truth(runs, truth))])
}
