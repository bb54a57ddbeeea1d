//! Answers to the exercise of chapter 18: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: Some(exercise(textbook)),
        wrong: [
            (exercise(first), "whole variance is taken off"),
            (exercise(second), "pairs a run with itself"),
            (exercise(third), "pairs are miscounted"),
            (exercise(fourth), "taken about the truth"),
            (exercise(fifth), "only neighbours are paired"),
            (exercise(sixth), "Second, bias² is the square of the mean"),
        ],
    }
}

pub fn solution(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
    if runs.len() < 2 {
        return None;
    }
    let n = runs.len() as f64;
    let off: Vec<f64> = runs.iter().map(|run| run - truth).collect();
    let sum: f64 = off.iter().sum();
    let mean = sum / n;
    let variance = off.iter().map(|off| (off - mean) * (off - mean)).sum::<f64>() / (n - 1.0);
    // All products of two runs, less those of a run with itself, are the pairs of different ones, each twice.
    let squares: f64 = off.iter().map(|off| off * off).sum();
    Some([variance, (sum * sum - squares) / (n * (n - 1.0))])
}

/// The formula straight from the page.
fn textbook(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
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

/// The square of the mean's distance is too large by the variance, so I subtract the variance.
fn first(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
    if runs.len() < 2 {
        return None;
    }
    let n = runs.len() as f64;
    let mean = runs.iter().sum::<f64>() / n;
    let variance = runs.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0);
    let bias = mean - truth;
    Some([variance, bias * bias - variance])
}

/// Two loops over all runs make all pairs, and there are n (n − 1) of them.
fn second(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
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

/// Each pair counts once, so the inner loop starts after the outer one, and the sum is divided by n (n − 1).
fn third(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
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

/// We know what the runs should be on average, so the variance is taken from the truth, over one less than their
/// number.
fn fourth(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
    if runs.len() < 2 {
        return None;
    }
    let n = runs.len() as f64;
    let sum: f64 = runs.iter().map(|x| x - truth).sum();
    let squares: f64 = runs.iter().map(|x| (x - truth) * (x - truth)).sum();
    let variance = squares / (n - 1.0);
    Some([variance, (sum * sum - squares) / (n * (n - 1.0))])
}

/// A pair is a run and the next one, so the products of neighbours are averaged.
fn fifth(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
    if runs.len() < 2 {
        return None;
    }
    let n = runs.len() as f64;
    let mean = runs.iter().sum::<f64>() / n;
    let variance = runs.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0);
    let products: f64 = runs.windows(2).map(|w| (w[0] - truth) * (w[1] - truth)).sum();
    Some([variance, products / (n - 1.0)])
}

/// Both are means: of the squared distances from the mean, and of the distances from the truth, squared.
fn sixth(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
    let n = runs.len() as f64;
    let off: Vec<f64> = runs.iter().map(|run| run - truth).collect();
    let mean = off.iter().sum::<f64>() / n;
    (n > 1.0).then(|| [off.iter().map(|off| (off - mean).powi(2)).sum::<f64>() / n, mean * mean])
}
