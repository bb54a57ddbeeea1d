//! Answers that readers of chapter 31 gave who saw its page and nothing else, and words of the remark that each must get.

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
            "shift what I have to the left and put in the new bit, box after box (so the first box ends at bit 7)",
            exercise(a),
            "opposite order",
        ),
        (
            "the ray begins at 0, so a box is entered only if its entry is at 0 or later",
            exercise(b),
            "in which the ray starts",
        ),
        (
            "it is a hit where it enters before it leaves and before the closest hit (boxes behind the ray forgotten)",
            exercise(c),
            "left before t = 0",
        ),
        (
            "a box that reaches behind the closest hit is hidden by it, so it must leave before that",
            exercise(d),
            "reaches behind the closest hit",
        ),
        (
            "the interval must not be empty, so its begin is less than its end (flat boxes are lost)",
            exercise(e),
            "flat boxes are lost",
        ),
        (
            "the nearest box is the next one to visit, so as soon as I set its bit it becomes the closest that the others are compared with",
            exercise(f),
            "compared with one another",
        ),
        (
            "A box counts if the ray goes through it before the closest hit, so it must leave the box before that hit.",
            exercise(second_a),
            "a box that reaches behind the",
        ),
        (
            "Once a box is entered, the closest hit is in it, so boxes that begin behind its end count as missed.",
            exercise(second_b),
            "the boxes are compared with one",
        ),
        (
            "I build the number bit by bit, shift it to the left and append the next box, so that the first box ends up on the left.",
            exercise(second_c),
            "the bits are in the opposite order",
        ),
    ]
}

fn right(enters: [f64; 8], leaves: [f64; 8], closest: f64) -> u32 {
    let mut mask = 0;
    for i in 0..8 {
        if enters[i].max(0.0) <= leaves[i].min(closest) {
            mask |= 1 << i;
        }
    }
    mask
}

fn a(enters: [f64; 8], leaves: [f64; 8], closest: f64) -> u32 {
    let mut mask = 0;
    for i in 0..8 {
        let hit = enters[i].max(0.0) <= leaves[i].min(closest);
        mask = (mask << 1) | hit as u32;
    }
    mask
}

fn b(enters: [f64; 8], leaves: [f64; 8], closest: f64) -> u32 {
    let mut mask = 0;
    for i in 0..8 {
        if enters[i] >= 0.0 && enters[i] <= leaves[i] && enters[i] <= closest {
            mask |= 1 << i;
        }
    }
    mask
}

fn c(enters: [f64; 8], leaves: [f64; 8], closest: f64) -> u32 {
    let mut mask = 0;
    for i in 0..8 {
        if enters[i] <= leaves[i] && enters[i] <= closest {
            mask |= 1 << i;
        }
    }
    mask
}

fn d(enters: [f64; 8], leaves: [f64; 8], closest: f64) -> u32 {
    let mut mask = 0;
    for i in 0..8 {
        if enters[i] <= leaves[i] && leaves[i] >= 0.0 && leaves[i] <= closest {
            mask |= 1 << i;
        }
    }
    mask
}

fn e(enters: [f64; 8], leaves: [f64; 8], closest: f64) -> u32 {
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

fn f(enters: [f64; 8], leaves: [f64; 8], closest: f64) -> u32 {
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

fn second_a(enters: [f64; 8], leaves: [f64; 8], closest: f64) -> u32 {
    let mut mask = 0_u32;
    for i in 0..8 {
        if enters[i] <= leaves[i] && leaves[i] >= 0.0 && leaves[i] <= closest {
            mask |= 1_u32 << i;
        }
    }
    mask
}

fn second_b(enters: [f64; 8], leaves: [f64; 8], closest: f64) -> u32 {
    let mut mask = 0_u32;
    let mut nearest = closest;
    for i in 0..8 {
        let enter = enters[i].max(0.0);
        let leave = leaves[i].min(nearest);
        if enter <= leave {
            mask |= 1_u32 << i;
            nearest = leave;
        }
    }
    mask
}

fn second_c(enters: [f64; 8], leaves: [f64; 8], closest: f64) -> u32 {
    let mut mask = 0_u32;
    for i in 0..8 {
        let enter = enters[i].max(0.0);
        let leave = leaves[i].min(closest);
        mask <<= 1;
        if enter <= leave {
            mask |= 1;
        }
    }
    mask
}
