//! Scenes as files: what is written comes back bit for bit, and what is wrong is told by line and column.

#[path = "../chapters/mod.rs"]
mod chapters;
mod scenes;

#[path = "scene_files/round_trip.rs"]
mod round_trip;

use pinhole::scene::SceneFile;
use std::path::Path;

/// A scene file of this text.
fn parsed(text: &str) -> Result<SceneFile, pinhole::scene::FileProblem> {
    SceneFile::parse(Path::new("scene.ron"), text.into())
}
#[test]
fn scratch() {
    for text in std::fs::read_to_string("/tmp/sf_cases.txt").unwrap().split("\n---\n") {
        let told = match parsed(text) { Ok(f) => format!("ok {}", f.len()), Err(e) => e.to_string() };
        eprintln!("{}\n      => {told}", text.replace('\n', "⏎"));
    }
}
