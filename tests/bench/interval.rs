//! How a benchmark measures: CPU time, and ratios of pairs with their interval.

#![allow(clippy::disallowed_methods, reason = "what is measured here may come from the platform's functions")]

use cpu_time::ProcessTime;
use std::time::Duration;

/// The CPU time of one run, all threads together, without dropping what it made.
pub fn cpu<T>(run: &impl Fn() -> T) -> Duration {
    let started = ProcessTime::now();
    let result = run();
    let time = started.elapsed();
    drop(result);
    time
}

/// Geometric mean of ratios with its 95 % t interval.
pub fn interval(logs: &[f64]) -> (f64, f64, f64) {
    let n = logs.len() as f64;
    let mean = logs.iter().sum::<f64>() / n;
    let variance = logs.iter().map(|log| (log - mean) * (log - mean)).sum::<f64>() / (n - 1.0);
    let half = student_975(logs.len() - 1) * (variance / n).sqrt();
    ((mean - half).exp(), mean.exp(), (mean + half).exp())
}

/// The 97.5 % point of Student's t (Abramowitz and Stegun, table 26.10), the next smaller tabulated freedom.
fn student_975(freedom: usize) -> f64 {
    const TABLE: [(usize, f64); 10] = [
        (1, 12.706),
        (2, 4.303),
        (3, 3.182),
        (4, 2.776),
        (5, 2.571),
        (7, 2.365),
        (10, 2.228),
        (14, 2.145),
        (20, 2.086),
        (30, 2.042),
    ];
    TABLE.iter().rev().find(|(tabulated, _)| *tabulated <= freedom).map_or(12.706, |(_, point)| *point)
}

/// The middle value.
pub fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
