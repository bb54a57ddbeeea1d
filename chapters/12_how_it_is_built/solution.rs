//! A solution of the exercise of chapter 12; look here when you have done yours.

use super::question::StageWords;

pub fn kept(stages: &[StageWords], asked: &str) -> Vec<String> {
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
