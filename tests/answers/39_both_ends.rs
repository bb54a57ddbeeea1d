//! Answers to the exercise of chapter 39: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "to the way before it"),
            (exercise(second), "balance heuristic"),
            (exercise(third), "itself is missing"),
            (exercise(fourth), "upside down"),
            (exercise(fifth), "1 over it"),
            (exercise(sixth), "from the last to the first"),
        ],
    }
}

pub fn solution(ratios: [f64; 3]) -> f64 {
    let (mut sum, mut square) = (1.0, 1.0);
    for ratio in ratios {
        square *= ratio * ratio;
        sum += square;
    }
    1.0 / sum
}

/// Each ratio is squared and added.
fn first(ratios: [f64; 3]) -> f64 {
    1.0 / (1.0 + ratios.iter().map(|ratio| ratio.powi(2)).sum::<f64>())
}

/// pdfs of all ways, of which the first is 1; a weight is a share of their sum.
fn second([a, b, c]: [f64; 3]) -> f64 {
    let pdfs = [1.0, a, a * b, a * b * c];
    pdfs[0] / pdfs.iter().sum::<f64>()
}

/// The product runs along, the sum begins at 0.
fn third(ratios: [f64; 3]) -> f64 {
    let (mut sum, mut pdf) = (0.0, 1.0);
    for ratio in ratios {
        pdf *= ratio;
        sum += pdf * pdf;
    }
    1.0 / sum
}

/// Each way's pdf is the one before divided by the ratio.
fn fourth(ratios: [f64; 3]) -> f64 {
    let (mut sum, mut pdf) = (1.0, 1.0);
    for ratio in ratios {
        pdf /= ratio;
        sum += pdf * pdf;
    }
    1.0 / sum
}

/// The sum is what is wanted, is it not?
fn fifth(ratios: [f64; 3]) -> f64 {
    let mut sum = 1.0;
    for ratio in ratios.iter().rev() {
        sum = 1.0 + ratio * ratio * sum;
    }
    sum
}

/// From the inside out, but in the wrong order.
fn sixth(ratios: [f64; 3]) -> f64 {
    let mut sum = 1.0;
    for ratio in ratios {
        sum = 1.0 + ratio * ratio * sum;
    }
    1.0 / sum
}
