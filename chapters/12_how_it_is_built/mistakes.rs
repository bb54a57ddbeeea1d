//! Typical wrong solutions of chapter 12, written as a reader would, and words of the remark that each must get.

use super::question::{StageWords, exercise};
use super::solution::kept;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(kept)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|stages, _| only(stages, |stage| stage.needed)), "left out"),
        (exercise(forward), "later"),
        (exercise(backward), "last to first"),
        (exercise(one_step), "only the stage"),
    ]
}

fn only(stages: &[StageWords], kept: impl Fn(&StageWords) -> bool) -> Vec<String> {
    stages.iter().filter(|stage| kept(stage)).map(|stage| stage.name.clone()).collect()
}

/// Round after round, until nothing more is kept; whatever the order of the stages.
fn forward(stages: &[StageWords], asked: &str) -> Vec<String> {
    let mut wanted = vec![asked.to_owned()];
    loop {
        let before = wanted.len();
        for stage in stages {
            if stage.needed && stage.writes.iter().any(|column| wanted.contains(column)) {
                wanted
                    .extend(stage.reads.iter().filter(|column| !wanted.contains(column)).cloned().collect::<Vec<_>>());
            }
        }
        if wanted.len() == before {
            return only(stages, |stage| stage.needed && stage.writes.iter().any(|column| wanted.contains(column)));
        }
    }
}

fn backward(stages: &[StageWords], asked: &str) -> Vec<String> {
    let mut kept = kept(stages, asked);
    kept.reverse();
    kept
}

fn one_step(stages: &[StageWords], asked: &str) -> Vec<String> {
    only(stages, |stage| stage.needed && stage.writes.iter().any(|column| column == asked))
}
