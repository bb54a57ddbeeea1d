//! Scenes as files: what is written comes back bit for bit, and what is wrong is told by file, line and column.

#[path = "scene_files/bad_cases.rs"]
mod bad_cases;
#[path = "scene_files/bad_files.rs"]
mod bad_files;
#[path = "scene_files/bad_places.rs"]
mod bad_places;
#[path = "scene_files/damaged.rs"]
mod damaged;
#[path = "scene_files/edits.rs"]
mod edits;
#[path = "scene_files/fuzz.rs"]
mod fuzz;
#[path = "scene_files/hostile.rs"]
mod hostile;
#[path = "scene_files/json.rs"]
mod json;
#[path = "scene_files/list.rs"]
mod list;
#[path = "scene_files/many_lights.rs"]
mod many_lights;
#[path = "scene_files/round_trip.rs"]
mod round_trip;
#[path = "scene_files/watch.rs"]
mod watch;
#[path = "scene_files/words.rs"]
mod words;

use pinhole::scene::{FileProblem, SceneFile};
use std::path::Path;

/// A scene file of this text.
fn parsed(text: &str) -> Result<SceneFile, FileProblem> {
    SceneFile::parse(Path::new("scene.ron"), text.into())
}

/// What a command line prints.
fn typed(words: &[&str]) -> pinhole_cli::command::Result<String> {
    let words: Vec<String> = words.iter().map(|word| word.to_string()).collect();
    let mut out = Vec::new();
    pinhole_cli::command::run(&chapters::all(), &words, &mut out)?;
    Ok(String::from_utf8(out).expect("text"))
}

/// Few files of the very code to which `cargo bench --bench damaged` gives a hundred thousand.
#[test]
fn no_damaged_file_brings_a_command_down() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let bases = damaged::Bases::in_folder(folder.path());
    let mut counts = damaged::Counts::default();
    (0..240).for_each(|seed| bases.try_seed(seed, &mut counts));
    eprintln!("damaged files: {counts}");
    assert!(counts.hold(), "{counts}");
    assert!(counts.done.iter().all(|&done| done > 0), "of some kind nothing is left to be read: {counts}");
}

/// Few cases of the very code that `cargo bench --bench fuzz` runs a million times.
#[test]
fn no_scene_file_brings_pinhole_down() {
    let counts = std::cell::RefCell::new(fuzz::Counts::default());
    let bases = fuzz::bases();
    let config = proptest::test_runner::Config { cases: 400, failure_persistence: None, ..Default::default() };
    proptest::proptest!(config, |(seed: u64)| {
        counts.borrow_mut().add(seed, fuzz::outcome(&fuzz::case(&bases, seed)));
    });
    let counts = counts.into_inner();
    eprintln!("fuzzed scene files: {counts}");
    assert!(counts.slow.is_empty() && counts.panics.is_empty(), "{counts}");
    assert!(
        counts.rendered > 20 && counts.mistakes > 20 && counts.refused > 5,
        "the cases are all of a kind: {counts}"
    );
}
