//! Answers to the exercise of chapter 37: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;
use std::f64::consts::TAU;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: Some(exercise(by_library)),
        wrong: [
            (exercise(first), "exchanged"),
            (exercise(second), "summed up far from 0"),
            (exercise(third), "missing"),
            (exercise(fourth), "radians"),
            (exercise(fifth), "change places"),
            (exercise(sixth), "clockwise"),
        ],
    }
}

/// A quarter of a turn is taken off as often as it takes, and put on again.
pub fn solution(turn: f64) -> [f64; 2] {
    let quarter = (4.0 * turn).round_ties_even();
    let x = TAU * (turn - quarter / 4.0);
    let y = x * x;
    let sine = x * (1.0 - y / 6.0 * (1.0 - y / 20.0 * (1.0 - y / 42.0 * (1.0 - y / 72.0))));
    let cosine = 1.0 - y / 2.0 * (1.0 - y / 12.0 * (1.0 - y / 30.0 * (1.0 - y / 56.0)));
    let mut point = [cosine, sine];
    for done in 0..3 {
        if f64::from(done) < quarter && quarter < 4.0 {
            point = [-point[1], point[0]];
        }
    }
    point
}

fn by_library(turn: f64) -> [f64; 2] {
    [libm::cos(TAU * turn), libm::sin(TAU * turn)]
}

fn first(turn: f64) -> [f64; 2] {
    [libm::sin(TAU * turn), libm::cos(TAU * turn)]
}

/// The first seven powers of each, from 0 on.
fn second(turn: f64) -> [f64; 2] {
    let x = TAU * turn;
    let (mut point, mut term) = ([0.0, 0.0], 1.0);
    for power in 0..12 {
        point[power % 2] += if power % 4 < 2 { term } else { -term };
        term *= x / (power as f64 + 1.0);
    }
    point
}

/// 1 and x.
fn third(turn: f64) -> [f64; 2] {
    let quarter = libm::rint(4.0 * turn);
    let x = TAU * (turn - quarter / 4.0);
    let [cosine, sine] = [1.0, x];
    match quarter as u32 % 4 {
        0 => [cosine, sine],
        1 => [-sine, cosine],
        2 => [-cosine, -sine],
        _ => [sine, -cosine],
    }
}

fn fourth(turn: f64) -> [f64; 2] {
    [libm::cos(turn), libm::sin(turn)]
}

/// The signs of each quarter, and cosine for x in all of them.
fn fifth(turn: f64) -> [f64; 2] {
    let quarter = libm::rint(4.0 * turn);
    let x = TAU * (turn - quarter / 4.0);
    match quarter as u32 % 4 {
        0 => [libm::cos(x), libm::sin(x)],
        1 => [-libm::cos(x), libm::sin(x)],
        2 => [-libm::cos(x), -libm::sin(x)],
        _ => [libm::cos(x), -libm::sin(x)],
    }
}

fn sixth(turn: f64) -> [f64; 2] {
    [libm::cos(TAU * turn), -libm::sin(TAU * turn)]
}
