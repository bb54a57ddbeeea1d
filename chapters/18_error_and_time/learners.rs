//! Answers that readers of chapter 18 gave who saw its page and nothing else, and words of the remark that each must get.

use super::question::exercise;
use pinhole_lab::exercise::Exercise;

/// The formula straight from the page.
pub fn textbook() -> Exercise {
    exercise(right)
}

/// What each reader thought, and the answer.
pub fn all() -> Vec<(&'static str, Exercise, &'static str)> {
    vec![
        (
            "the square of the mean's distance is too large by the variance, so I subtract the variance",
            exercise(a),
            "whole variance is taken off",
        ),
        (
            "a square cannot be negative, so where the mean of the products is below 0 the bias² is 0",
            exercise(b),
            "is cut off",
        ),
        (
            "two loops over all runs make all pairs, and there are n (n − 1) of them",
            exercise(c),
            "pairs a run with itself",
        ),
        (
            "each pair counts once, so the inner loop starts after the outer one, and the sum is divided by n (n − 1)",
            exercise(d),
            "pairs are miscounted",
        ),
        (
            "we know what the runs should be on average, so the variance is taken from the truth, over one less than their number",
            exercise(e),
            "taken about the truth",
        ),
        (
            "a pair is a run and the next one, so the products of neighbours are averaged",
            exercise(f),
            "only neighbours are paired",
        ),
        (
            "The square of the mean's distance is too large by the variance, so I subtract the variance; I forgot that of a mean of n it is only an n-th.",
            exercise(second_a),
            "the whole variance is taken off the",
        ),
        (
            "Pairs of two different runs are each run and the next one, the first with the second, the second with the third, and so on.",
            exercise(second_b),
            "only neighbours are paired; every",
        ),
        (
            "We know the truth, so the variance is the mean of squared distances from it; n − 1 is for those who have to estimate the mean.",
            exercise(second_c),
            "the variance is taken about the",
        ),
    ]
}

fn right(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
    if runs.len() < 2 {
        return None;
    }
    let n = runs.len() as f64;
    let mean = runs.iter().sum::<f64>() / n;
    let variance = runs.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0);
    let mut sum = 0.0f64;
    for (i, x) in runs.iter().enumerate() {
        for (j, y) in runs.iter().enumerate() {
            if i != j {
                sum += (x - truth) * (y - truth);
            }
        }
    }
    Some([variance, sum / (n * (n - 1.0))])
}

fn a(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
    if runs.len() < 2 {
        return None;
    }
    let n = runs.len() as f64;
    let mean = runs.iter().sum::<f64>() / n;
    let variance = runs.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0);
    let bias = mean - truth;
    Some([variance, bias * bias - variance])
}

fn b(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
    if runs.len() < 2 {
        return None;
    }
    let n = runs.len() as f64;
    let mean = runs.iter().sum::<f64>() / n;
    let variance = runs.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0);
    let bias_squared = (mean - truth) * (mean - truth) - variance / n;
    Some([variance, bias_squared.max(0.0)])
}

fn c(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
    if runs.len() < 2 {
        return None;
    }
    let n = runs.len() as f64;
    let mean = runs.iter().sum::<f64>() / n;
    let variance = runs.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0);
    let mut sum = 0.0f64;
    for x in runs {
        for y in runs {
            sum += (x - truth) * (y - truth);
        }
    }
    Some([variance, sum / (n * (n - 1.0))])
}

fn d(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
    if runs.len() < 2 {
        return None;
    }
    let n = runs.len() as f64;
    let mean = runs.iter().sum::<f64>() / n;
    let variance = runs.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0);
    let mut sum = 0.0f64;
    for i in 0..runs.len() {
        for j in i + 1..runs.len() {
            sum += (runs[i] - truth) * (runs[j] - truth);
        }
    }
    Some([variance, sum / (n * (n - 1.0))])
}

fn e(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
    if runs.len() < 2 {
        return None;
    }
    let n = runs.len() as f64;
    let sum: f64 = runs.iter().map(|x| x - truth).sum();
    let squares: f64 = runs.iter().map(|x| (x - truth) * (x - truth)).sum();
    let variance = squares / (n - 1.0);
    Some([variance, (sum * sum - squares) / (n * (n - 1.0))])
}

fn f(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
    if runs.len() < 2 {
        return None;
    }
    let n = runs.len() as f64;
    let mean = runs.iter().sum::<f64>() / n;
    let variance = runs.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0);
    let products: f64 = runs.windows(2).map(|w| (w[0] - truth) * (w[1] - truth)).sum();
    Some([variance, products / (n - 1.0)])
}

fn second_a(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
    if runs.len() < 2 {
        return None;
    }
    let n = runs.len() as f64;
    let mean = runs.iter().sum::<f64>() / n;
    let variance = runs.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0);
    let bias = mean - truth;
    Some([variance, bias * bias - variance])
}

fn second_b(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
    if runs.len() < 2 {
        return None;
    }
    let n = runs.len() as f64;
    let mean = runs.iter().sum::<f64>() / n;
    let variance = runs.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0);
    let products: f64 = runs.windows(2).map(|pair| (pair[0] - truth) * (pair[1] - truth)).sum();
    Some([variance, products / (n - 1.0)])
}

fn second_c(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
    if runs.len() < 2 {
        return None;
    }
    let n = runs.len() as f64;
    let variance = runs.iter().map(|x| (x - truth) * (x - truth)).sum::<f64>() / n;
    let mut products = 0.0;
    for i in 0..runs.len() {
        for j in 0..runs.len() {
            if i != j {
                products += (runs[i] - truth) * (runs[j] - truth);
            }
        }
    }
    Some([variance, products / (n * (n - 1.0))])
}
