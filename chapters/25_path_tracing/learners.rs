//! Answers that readers of chapter 25 gave who saw its page and nothing else, and words of the remark that each must get.

use super::question::exercise;
use pinhole_lab::exercise::Exercise;

/// The formula straight from the page.
pub fn textbook() -> Exercise {
    exercise(right)
}

/// What each reader thought, and the answer.
pub fn all() -> Vec<(&'static str, Exercise, &'static str)> {
    vec![
        ("how bright a throughput is, its luminance says, so that is the probability", exercise(a), "is the luminance"),
        (
            "a probability above 1 survives anyway, so I divide by the largest component without cutting it at 1",
            exercise(b),
            "divides light away",
        ),
        (
            "a path that survives has the weight of those that survive, so it is multiplied by q",
            exercise(c),
            "multiplied by the probability",
        ),
        ("a path ends with the probability 1 − q, so it ends where u lies below that", exercise(d), "below 1 − p"),
        (
            "it must count for those that ended, and those are 1 − q, so I divide by 1 − q",
            exercise(e),
            "probability of its end",
        ),
        ("each colour plays by itself, with its own component as its probability", exercise(f), "plays for itself"),
        (
            "A survivor counts for those that ended, and these are the fraction 1 − q, so I divide by 1 − q.",
            exercise(second_a),
            "a path that goes on is divided by",
        ),
        (
            "Red, green and blue each go on with their own probability and are each divided by it.",
            exercise(second_b),
            "each colour plays for itself; a",
        ),
        (
            "How large three numbers are together is the length of the vector, so that, at most 1, is the probability.",
            exercise(second_c),
            "the probability is the length of",
        ),
    ]
}

fn right(throughput: [f64; 3], u: f64) -> [f64; 3] {
    let q = throughput[0].max(throughput[1]).max(throughput[2]).min(1.0);
    if u < q { [throughput[0] / q, throughput[1] / q, throughput[2] / q] } else { [0.0; 3] }
}

fn a(throughput: [f64; 3], u: f64) -> [f64; 3] {
    let q = (0.2126 * throughput[0] + 0.7152 * throughput[1] + 0.0722 * throughput[2]).min(1.0);
    if u < q { [throughput[0] / q, throughput[1] / q, throughput[2] / q] } else { [0.0; 3] }
}

fn b(throughput: [f64; 3], u: f64) -> [f64; 3] {
    let q = throughput[0].max(throughput[1]).max(throughput[2]);
    if u < q { [throughput[0] / q, throughput[1] / q, throughput[2] / q] } else { [0.0; 3] }
}

fn c(throughput: [f64; 3], u: f64) -> [f64; 3] {
    let q = throughput.iter().fold(0.0_f64, |m, &x| m.max(x)).min(1.0);
    if u < q { [throughput[0] * q, throughput[1] * q, throughput[2] * q] } else { [0.0; 3] }
}

fn d(throughput: [f64; 3], u: f64) -> [f64; 3] {
    let q = throughput[0].max(throughput[1]).max(throughput[2]).min(1.0);
    if u < 1.0 - q {
        return [0.0; 3];
    }
    if q == 0.0 {
        return [0.0; 3];
    }
    [throughput[0] / q, throughput[1] / q, throughput[2] / q]
}

fn e(throughput: [f64; 3], u: f64) -> [f64; 3] {
    let q = throughput[0].max(throughput[1]).max(throughput[2]).min(1.0);
    if u >= q {
        return [0.0; 3];
    }
    if q == 1.0 {
        return throughput;
    }
    [throughput[0] / (1.0 - q), throughput[1] / (1.0 - q), throughput[2] / (1.0 - q)]
}

fn f(throughput: [f64; 3], u: f64) -> [f64; 3] {
    let mut result = [0.0; 3];
    for i in 0..3 {
        let q = throughput[i].min(1.0);
        if u < q {
            result[i] = throughput[i] / q;
        }
    }
    result
}

fn second_a(throughput: [f64; 3], u: f64) -> [f64; 3] {
    let q = throughput[0].max(throughput[1]).max(throughput[2]).min(1.0);
    if u >= q {
        return [0.0; 3];
    }
    if q >= 1.0 {
        return throughput;
    }
    let ended = 1.0 - q;
    [throughput[0] / ended, throughput[1] / ended, throughput[2] / ended]
}

fn second_b(throughput: [f64; 3], u: f64) -> [f64; 3] {
    let mut result = [0.0; 3];
    for i in 0..3 {
        let q = throughput[i].min(1.0);
        if u < q {
            result[i] = throughput[i] / q;
        }
    }
    result
}

fn second_c(throughput: [f64; 3], u: f64) -> [f64; 3] {
    let length = (throughput[0] * throughput[0] + throughput[1] * throughput[1] + throughput[2] * throughput[2]).sqrt();
    let q = length.min(1.0);
    if u < q { [throughput[0] / q, throughput[1] / q, throughput[2] / q] } else { [0.0; 3] }
}
