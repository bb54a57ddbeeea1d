//! Answers that readers of chapter 12 gave who saw its page and nothing else, and words of the remark that each must get.

use super::question::StageWords;
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
            "repeat until nothing changes: keep what writes a column that is wanted, whoever wants it, early or late",
            exercise(a),
            "earlier one reads",
        ),
        (
            "the stages run in the order given, so I go through them in that order and collect what kept ones read",
            exercise(b),
            "gone through first to last",
        ),
        (
            "a stage is worth keeping if what it writes is read, that is all of its columns",
            exercise(c),
            "all that it writes is wanted",
        ),
        (
            "somebody must read what it writes, so I look whether any needed stage after it reads one of its columns",
            exercise(d),
            "dropped stage reads",
        ),
        (
            "backwards, first follow the columns, and at the end leave out the stages that the scene does not need",
            exercise(e),
            "does not need reads",
        ),
        (
            "once a stage that writes a column has been found, the column is provided for and nobody else need write it",
            exercise(f),
            "counts as provided for",
        ),
        (
            "The stages run in the order given, so I went through them once from the first to the last and noted what each kept stage reads.",
            exercise(second_a),
            "the stages are gone through first",
        ),
        (
            "A stage stays if somebody after it reads what it writes; I did not ask whether that somebody is kept itself.",
            exercise(second_b),
            "what a dropped stage reads is",
        ),
        (
            "Going backwards, once I have found the stage that writes a column, that column is dealt with, and I took it from the list; I forgot that several stages may write the same one.",
            exercise(second_c),
            "a column counts as provided for",
        ),
    ]
}

fn right(stages: &[StageWords], asked: &str) -> Vec<String> {
    let mut wanted = vec![asked.to_string()];
    let mut names: Vec<String> = Vec::new();
    for stage in stages.iter().rev() {
        if stage.needed && stage.writes.iter().any(|c| wanted.contains(&c.to_string())) {
            names.push(stage.name.to_string());
            for c in stage.reads.iter() {
                wanted.push(c.to_string());
            }
        }
    }
    names.reverse();
    names
}

fn a(stages: &[StageWords], asked: &str) -> Vec<String> {
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

fn b(stages: &[StageWords], asked: &str) -> Vec<String> {
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

fn c(stages: &[StageWords], asked: &str) -> Vec<String> {
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

fn d(stages: &[StageWords], asked: &str) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for (i, stage) in stages.iter().enumerate() {
        if !stage.needed {
            continue;
        }
        let mut useful = false;
        for column in stage.writes.iter() {
            let column = column.to_string();
            if column == asked {
                useful = true;
            }
            for later in &stages[i + 1..] {
                if later.needed && later.reads.contains(&column) {
                    useful = true;
                }
            }
        }
        if useful {
            names.push(stage.name.to_string());
        }
    }
    names
}

fn e(stages: &[StageWords], asked: &str) -> Vec<String> {
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

fn f(stages: &[StageWords], asked: &str) -> Vec<String> {
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

fn second_a(stages: &[super::question::StageWords], asked: &str) -> Vec<String> {
    let mut wanted: Vec<String> = vec![asked.to_string()];
    let mut names = Vec::new();
    for stage in stages.iter() {
        let writes_wanted = stage.writes.iter().any(|column| wanted.contains(&column.to_string()));
        if stage.needed && writes_wanted {
            names.push(stage.name.to_string());
            for column in stage.reads.iter() {
                wanted.push(column.to_string());
            }
        }
    }
    names
}

fn second_b(stages: &[super::question::StageWords], asked: &str) -> Vec<String> {
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

fn second_c(stages: &[super::question::StageWords], asked: &str) -> Vec<String> {
    let mut wanted: Vec<String> = vec![asked.to_string()];
    let mut names = Vec::new();
    for stage in stages.iter().rev() {
        let writes: Vec<String> = stage.writes.iter().map(|column| column.to_string()).collect();
        if stage.needed && writes.iter().any(|column| wanted.contains(column)) {
            names.push(stage.name.to_string());
            wanted.retain(|column| !writes.contains(column));
            for column in stage.reads.iter() {
                wanted.push(column.to_string());
            }
        }
    }
    names.reverse();
    names
}
