//! Answers to the exercise of chapter 36: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "straight line between"),
            (exercise(second), "equally far apart"),
            (exercise(third), "count per unit of u"),
            (exercise(fourth), "level at both keys"),
            (exercise(fifth), "which arrives there"),
            (exercise(sixth), "the time since the second key"),
        ],
    }
}

/// The cubic a + b s + c s² + d s³ in the time s since the second key, from values and slopes at both ends.
pub fn solution(times: [f64; 4], values: [f64; 4], time: f64) -> f64 {
    let [t0, t1, t2, t3] = times;
    let [v0, v1, v2, v3] = values;
    let (before, after) = ((v2 - v0) / (t2 - t0), (v3 - v1) / (t3 - t1));
    let (h, s) = (t2 - t1, time - t1);
    let slope = (v2 - v1) / h;
    let c = (3.0 * slope - 2.0 * before - after) / h;
    let d = (before + after - 2.0 * slope) / (h * h);
    v1 + s * (before + s * (c + s * d))
}

/// The place on the line between two keys.
fn first(times: [f64; 4], values: [f64; 4], time: f64) -> f64 {
    let u = (time - times[1]) / (times[2] - times[1]);
    (1.0 - u) * values[1] + u * values[2]
}

fn blend(u: f64, from: f64, to: f64, before: f64, after: f64) -> f64 {
    let rest = 1.0 - u;
    from * rest * rest * (1.0 + 2.0 * u) + to * u * u * (3.0 - 2.0 * u) + before * u * rest * rest - after * u * u * rest
}

/// Catmull and Rom's curve as most libraries have it: for keys one apart.
fn second(times: [f64; 4], values: [f64; 4], time: f64) -> f64 {
    let u = (time - times[1]) / (times[2] - times[1]);
    blend(u, values[1], values[2], 0.5 * (values[2] - values[0]), 0.5 * (values[3] - values[1]))
}

/// Slopes per unit of time, taken for slopes per unit of u.
fn third(times: [f64; 4], values: [f64; 4], time: f64) -> f64 {
    let u = (time - times[1]) / (times[2] - times[1]);
    let slope = |a: usize, b: usize| (values[b] - values[a]) / (times[b] - times[a]);
    blend(u, values[1], values[2], slope(0, 2), slope(1, 3))
}

/// The cubic that eases in and out.
fn fourth(times: [f64; 4], values: [f64; 4], time: f64) -> f64 {
    let u = (time - times[1]) / (times[2] - times[1]);
    blend(u, values[1], values[2], 0.0, 0.0)
}

/// The slope of the line that ends at a key.
fn fifth(times: [f64; 4], values: [f64; 4], time: f64) -> f64 {
    let h = times[2] - times[1];
    let slope = |a: usize| (values[a + 1] - values[a]) / (times[a + 1] - times[a]);
    blend((time - times[1]) / h, values[1], values[2], h * slope(0), h * slope(1))
}

/// The time since the second key, not divided.
fn sixth(times: [f64; 4], values: [f64; 4], time: f64) -> f64 {
    let h = times[2] - times[1];
    let slope = |a: usize, b: usize| h * (values[b] - values[a]) / (times[b] - times[a]);
    blend(time - times[1], values[1], values[2], slope(0, 2), slope(1, 3))
}
