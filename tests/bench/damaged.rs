//! A hundred thousand damaged files given to the program's commands: `cargo bench --bench damaged [-- how many [the first]]`.
//!
//! Scene files through `plan`, `render`, `trace` and `preflight`; textures through `render`; images through `compare`;
//! checkpoints through `render --resume`.
//! `cargo bench --bench damaged -- kills 60` kills the program so often in the midst of a render and resumes it.
//! The same code, and few of the same files, run in `cargo test --test scene_files`.

#[path = "../scene_files/damaged.rs"]
mod damaged;
#[path = "../scene_files/fuzz.rs"]
#[expect(dead_code, reason = "the bench `fuzz` and the tests use the rest")]
mod fuzz;
#[path = "../long_renders/kill.rs"]
mod kill;
#[path = "../scenes/mod.rs"]
mod scenes;

use std::time::Instant;

fn main() {
    let numbers: Vec<u64> = std::env::args().filter_map(|word| word.parse().ok()).collect();
    let count = numbers.first().copied().unwrap_or(100_000);
    if std::env::args().any(|word| word == "kills") {
        let kills = kill::kills(numbers.first().map_or(60, |&count| count as u32));
        assert!(kills.same && kills.broken == 0, "of {} kills, one has changed the picture", kills.asked);
        return;
    }
    let first = numbers.get(1).copied().unwrap_or(0);
    let folder = tempfile::tempdir().expect("a temporary folder");
    let bases = damaged::Bases::in_folder(folder.path());
    let mut counts = damaged::Counts::default();
    let started = Instant::now();
    for seed in first..first + count {
        bases.try_seed(seed, &mut counts);
        let done = seed - first + 1;
        if done % 5_000 == 0 {
            eprintln!("after {:?}: {counts}", started.elapsed());
        }
    }
    eprintln!("{counts}, in {:?}", started.elapsed());
    assert!(counts.hold(), "some files bring a command down");
}
