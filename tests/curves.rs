//! What is kept of the curves of chapter 31 was measured with the present sources.

use pinhole_lab::measure::cost::made_from_these;
use std::path::Path;

#[test]
fn curves_are_of_the_present_sources() {
    const CHAPTER: &str = "31_wide_tree";
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("chapters").join(CHAPTER).join("curves.txt");
    let kept = std::fs::read_to_string(file).expect("the curves are kept beside the chapter");
    let beside = ["src/lab/naive/tree.rs", "src/lab/measure/torus_knot.rs", "tests/bench/curves.rs"];
    let expected = format!("made from {}", made_from_these(CHAPTER, &beside).expect("sources"));
    assert_eq!(
        kept.lines().last(),
        Some(expected.as_str()),
        "to measure anew, on a quiet machine: cargo bench --bench curves -- --write"
    );
}
