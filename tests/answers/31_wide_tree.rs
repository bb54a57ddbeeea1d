//! Answers to the exercise of chapter 31: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: Some(exercise(textbook)),
        wrong: [
            (exercise(first), "opposite order"),
            (exercise(second), "in which the ray starts"),
            (exercise(third), "left before t = 0"),
            (exercise(fourth), "flat boxes are lost"),
            (exercise(fifth), "compared with one another"),
            (exercise(sixth), "a box that reaches behind the"),
        ],
    }
}

pub fn solution(enters: [f64; 8], leaves: [f64; 8], closest: f64) -> u32 {
    let mut mask = 0;
    for child in 0..8 {
        // What of the box is on the ray, and before the closest hit.
        let (from, until) = (enters[child].max(0.0), leaves[child].min(closest));
        if from <= until {
            mask |= 1 << child;
        }
    }
    mask
}

/// The formula straight from the page.
fn textbook(enters: [f64; 8], leaves: [f64; 8], closest: f64) -> u32 {
    let mut mask = 0;
    for i in 0..8 {
        if enters[i].max(0.0) <= leaves[i].min(closest) {
            mask |= 1 << i;
        }
    }
    mask
}

/// Shift what I have to the left and put in the new bit, box after box (so the first box ends at bit 7).
fn first(enters: [f64; 8], leaves: [f64; 8], closest: f64) -> u32 {
    let mut mask = 0;
    for i in 0..8 {
        let hit = enters[i].max(0.0) <= leaves[i].min(closest);
        mask = (mask << 1) | hit as u32;
    }
    mask
}

/// The ray begins at 0, so a box is entered only if its entry is at 0 or later.
fn second(enters: [f64; 8], leaves: [f64; 8], closest: f64) -> u32 {
    let mut mask = 0;
    for i in 0..8 {
        if enters[i] >= 0.0 && enters[i] <= leaves[i] && enters[i] <= closest {
            mask |= 1 << i;
        }
    }
    mask
}

/// It is a hit where it enters before it leaves and before the closest hit (boxes behind the ray forgotten).
fn third(enters: [f64; 8], leaves: [f64; 8], closest: f64) -> u32 {
    let mut mask = 0;
    for i in 0..8 {
        if enters[i] <= leaves[i] && enters[i] <= closest {
            mask |= 1 << i;
        }
    }
    mask
}

/// The interval must not be empty, so its begin is less than its end (flat boxes are lost).
fn fourth(enters: [f64; 8], leaves: [f64; 8], closest: f64) -> u32 {
    let mut mask = 0;
    for i in 0..8 {
        let begin = enters[i].max(0.0);
        let end = leaves[i].min(closest);
        if begin < end {
            mask |= 1 << i;
        }
    }
    mask
}

/// The nearest box is the next one to visit, so as soon as I set its bit it becomes the closest that the others are
/// compared with.
fn fifth(enters: [f64; 8], leaves: [f64; 8], closest: f64) -> u32 {
    let mut mask = 0;
    let mut nearest = closest;
    for i in 0..8 {
        if enters[i].max(0.0) <= leaves[i].min(nearest) {
            mask |= 1 << i;
            nearest = nearest.min(leaves[i]);
        }
    }
    mask
}

/// A box counts if the ray goes through it before the closest hit, so it must leave the box before that hit.
fn sixth(enters: [f64; 8], leaves: [f64; 8], closest: f64) -> u32 {
    let mut mask = 0_u32;
    for i in 0..8 {
        if enters[i] <= leaves[i] && leaves[i] >= 0.0 && leaves[i] <= closest {
            mask |= 1_u32 << i;
        }
    }
    mask
}
