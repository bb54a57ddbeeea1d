//! Answers to the exercise of chapter 38: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "left in nanometres"),
            (exercise(second), "that is n²"),
            (exercise(third), "1 is missing"),
            (exercise(fourth), "c is squared"),
            (exercise(fifth), "is not squared"),
            (exercise(sixth), "1 added to it"),
        ],
    }
}

pub fn solution(b: [f64; 3], c: [f64; 3], wavelength: f64) -> f64 {
    let micrometres = wavelength / 1000.0;
    let square = micrometres * micrometres;
    let mut squared = 1.0;
    for term in 0..3 {
        squared += b[term] * square / (square - c[term]);
    }
    squared.sqrt()
}

/// Wavelengths are wavelengths (their unit forgotten).
fn first(b: [f64; 3], c: [f64; 3], wavelength: f64) -> f64 {
    let square = wavelength.powi(2);
    (1.0 + b.iter().zip(c).map(|(b, c)| b * square / (square - c)).sum::<f64>()).sqrt()
}

/// The equation as it stands, whose left side is n².
fn second(b: [f64; 3], c: [f64; 3], wavelength: f64) -> f64 {
    let l = wavelength * 1e-3;
    1.0 + (0..3).map(|i| b[i] * l * l / (l * l - c[i])).sum::<f64>()
}

/// A sum begins at 0.
fn third(b: [f64; 3], c: [f64; 3], wavelength: f64) -> f64 {
    let (mut sum, square) = (0.0, (wavelength / 1e3).powi(2));
    for i in 0..3 {
        sum += b[i] * square / (square - c[i]);
    }
    sum.sqrt()
}

/// Resonances are wavelengths, so they are squared like the other.
fn fourth(b: [f64; 3], c: [f64; 3], wavelength: f64) -> f64 {
    let square = (wavelength / 1000.0) * (wavelength / 1000.0);
    let term = |i: usize| b[i] * square / (square - c[i] * c[i]);
    (1.0 + term(0) + term(1) + term(2)).sqrt()
}

/// The square forgotten, above and below.
fn fifth(b: [f64; 3], c: [f64; 3], wavelength: f64) -> f64 {
    let l = wavelength / 1000.0;
    let mut n = 1.0;
    for (b, c) in b.into_iter().zip(c) {
        n += b * l / (l - c);
    }
    f64::sqrt(n)
}

/// The root belongs to the sum, and a vacuum has 1.
fn sixth(b: [f64; 3], c: [f64; 3], wavelength: f64) -> f64 {
    let l2 = (0.001 * wavelength).powi(2);
    1.0 + b.iter().zip(&c).map(|(b, c)| b * l2 / (l2 - c)).sum::<f64>().sqrt()
}
