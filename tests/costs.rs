//! Each chapter's costs were measured with the sources as they are.

use pinhole_lab::measure::cost::made_from;
use std::fs;
use std::path::Path;

#[test]
fn costs_are_of_the_present_sources() {
    let mut wrong = Vec::new();
    for chapter in chapters::all() {
        let short = format!("chapters/{}/costs.txt", chapter.name);
        let expected = format!("made from {}", made_from(chapter.name).expect("the sources are here"));
        match fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(&short)) {
            Err(_) => wrong.push(format!("{short} is missing")),
            Ok(costs) if costs.lines().last() != Some(expected.as_str()) => {
                wrong.push(format!("{short} was measured with other sources than the present ones"));
            }
            Ok(_) => {}
        }
    }
    assert!(
        wrong.is_empty(),
        "{};\nto measure anew, on a quiet machine: cargo run --release -- cost all --write",
        wrong.join(",\n")
    );
}
