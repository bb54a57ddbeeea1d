//! Answers to the exercise of chapter 12: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::{StageWords, exercise};

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "earlier one reads"),
            (exercise(second), "gone through first to last"),
            (exercise(third), "all that it writes is wanted"),
            (exercise(fourth), "does not need reads"),
            (exercise(fifth), "counts as provided for"),
            (exercise(sixth), "what a dropped stage reads is"),
        ],
    }
}

pub fn solution(stages: &[StageWords], asked: &str) -> Vec<String> {
    let mut wanted = vec![asked];
    let mut kept = Vec::new();
    for stage in stages.iter().rev() {
        if stage.needed && stage.writes.iter().any(|column| wanted.contains(&column.as_str())) {
            kept.push(stage.name.clone());
            wanted.extend(stage.reads.iter().map(String::as_str));
        }
    }
    kept.reverse();
    kept
}

/// Repeat until nothing changes: keep what writes a column that is wanted, whoever wants it, early or late.
fn first(stages: &[StageWords], asked: &str) -> Vec<String> {
    let mut keep = vec![false; stages.len()];
    let mut wanted = vec![asked.to_string()];
    loop {
        let mut changed = false;
        for (i, stage) in stages.iter().enumerate() {
            if !keep[i] && stage.needed && stage.writes.iter().any(|c| wanted.contains(&c.to_string())) {
                keep[i] = true;
                changed = true;
                wanted.extend(stage.reads.iter().map(|c| c.to_string()));
            }
        }
        if !changed {
            break;
        }
    }
    let mut names = Vec::new();
    for (i, stage) in stages.iter().enumerate() {
        if keep[i] {
            names.push(stage.name.to_string());
        }
    }
    names
}

/// The stages run in the order given, so I go through them in that order and collect what kept ones read.
fn second(stages: &[StageWords], asked: &str) -> Vec<String> {
    let mut wanted = vec![asked.to_string()];
    let mut names: Vec<String> = Vec::new();
    for stage in stages {
        if stage.needed && stage.writes.iter().any(|c| wanted.contains(&c.to_string())) {
            names.push(stage.name.to_string());
            wanted.extend(stage.reads.iter().map(|c| c.to_string()));
        }
    }
    names
}

/// A stage is worth keeping if what it writes is read, that is all of its columns.
fn third(stages: &[StageWords], asked: &str) -> Vec<String> {
    let mut wanted = vec![asked.to_string()];
    let mut names: Vec<String> = Vec::new();
    for stage in stages.iter().rev() {
        let read = stage.writes.iter().all(|c| wanted.contains(&c.to_string()));
        if stage.needed && read {
            names.insert(0, stage.name.to_string());
            wanted.extend(stage.reads.iter().map(|c| c.to_string()));
        }
    }
    names
}

/// Backwards, first follow the columns, and at the end leave out the stages that the scene does not need.
fn fourth(stages: &[StageWords], asked: &str) -> Vec<String> {
    let mut wanted = vec![asked.to_string()];
    let mut found: Vec<usize> = Vec::new();
    for i in (0..stages.len()).rev() {
        if stages[i].writes.iter().any(|c| wanted.contains(&c.to_string())) {
            found.push(i);
            for c in stages[i].reads.iter() {
                wanted.push(c.to_string());
            }
        }
    }
    found.reverse();
    found.into_iter().filter(|&i| stages[i].needed).map(|i| stages[i].name.to_string()).collect()
}

/// Once a stage that writes a column has been found, the column is provided for and nobody else need write it.
fn fifth(stages: &[StageWords], asked: &str) -> Vec<String> {
    let mut wanted = vec![asked.to_string()];
    let mut names: Vec<String> = Vec::new();
    for stage in stages.iter().rev() {
        let writes: Vec<String> = stage.writes.iter().map(|c| c.to_string()).collect();
        if stage.needed && writes.iter().any(|c| wanted.contains(c)) {
            wanted.retain(|c| !writes.contains(c));
            wanted.extend(stage.reads.iter().map(|c| c.to_string()));
            names.push(stage.name.to_string());
        }
    }
    names.reverse();
    names
}

/// A stage stays if somebody after it reads what it writes; I did not ask whether that somebody is kept itself.
fn sixth(stages: &[StageWords], asked: &str) -> Vec<String> {
    let mut names = Vec::new();
    for (index, stage) in stages.iter().enumerate() {
        if !stage.needed {
            continue;
        }
        let useful = stage.writes.iter().any(|column| {
            let column = column.to_string();
            column == asked || stages[index + 1..].iter().any(|later| later.reads.contains(&column))
        });
        if useful {
            names.push(stage.name.to_string());
        }
    }
    names
}
