//! Answers to the exercise of chapter 25: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "is the luminance"),
            (exercise(second), "divides light away"),
            (exercise(third), "multiplied by the probability"),
            (exercise(fourth), "below 1 − p"),
            (exercise(fifth), "probability of its end"),
            (exercise(sixth), "plays for itself"),
        ],
    }
}

pub fn solution(throughput: [f64; 3], u: f64) -> [f64; 3] {
    let survival = throughput[0].max(throughput[1]).max(throughput[2]).min(1.0);
    if u < survival { throughput.map(|part| part / survival) } else { [0.0; 3] }
}

/// How bright a throughput is, its luminance says, so that is the probability.
fn first(throughput: [f64; 3], u: f64) -> [f64; 3] {
    let q = (0.2126 * throughput[0] + 0.7152 * throughput[1] + 0.0722 * throughput[2]).min(1.0);
    if u < q { [throughput[0] / q, throughput[1] / q, throughput[2] / q] } else { [0.0; 3] }
}

/// A probability above 1 survives anyway, so I divide by the largest component without cutting it at 1.
fn second(throughput: [f64; 3], u: f64) -> [f64; 3] {
    let q = throughput[0].max(throughput[1]).max(throughput[2]);
    if u < q { [throughput[0] / q, throughput[1] / q, throughput[2] / q] } else { [0.0; 3] }
}

/// A path that survives has the weight of those that survive, so it is multiplied by q.
fn third(throughput: [f64; 3], u: f64) -> [f64; 3] {
    let q = throughput.iter().fold(0.0_f64, |m, &x| m.max(x)).min(1.0);
    if u < q { [throughput[0] * q, throughput[1] * q, throughput[2] * q] } else { [0.0; 3] }
}

/// A path ends with the probability 1 − q, so it ends where u lies below that.
fn fourth(throughput: [f64; 3], u: f64) -> [f64; 3] {
    let q = throughput[0].max(throughput[1]).max(throughput[2]).min(1.0);
    if u < 1.0 - q {
        return [0.0; 3];
    }
    if q == 0.0 {
        return [0.0; 3];
    }
    [throughput[0] / q, throughput[1] / q, throughput[2] / q]
}

/// It must count for those that ended, and those are 1 − q, so I divide by 1 − q.
fn fifth(throughput: [f64; 3], u: f64) -> [f64; 3] {
    let q = throughput[0].max(throughput[1]).max(throughput[2]).min(1.0);
    if u >= q {
        return [0.0; 3];
    }
    if q == 1.0 {
        return throughput;
    }
    [throughput[0] / (1.0 - q), throughput[1] / (1.0 - q), throughput[2] / (1.0 - q)]
}

/// Each colour plays by itself, with its own component as its probability.
fn sixth(throughput: [f64; 3], u: f64) -> [f64; 3] {
    let mut result = [0.0; 3];
    for i in 0..3 {
        let q = throughput[i].min(1.0);
        if u < q {
            result[i] = throughput[i] / q;
        }
    }
    result
}
