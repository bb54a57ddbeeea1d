//! A million scene files made at random: `cargo bench --bench fuzz [-- how many [the first seed]]`.
//!
//! The same code, and few of the same cases, run in `cargo test --test scene_files`.

#[path = "../scene_files/fuzz.rs"]
mod fuzz;
#[path = "../scenes/mod.rs"]
mod scenes;

use std::time::Instant;

fn main() {
    let numbers: Vec<u64> = std::env::args().filter_map(|word| word.parse().ok()).collect();
    let count = numbers.first().copied().unwrap_or(1_000_000);
    let first = numbers.get(1).copied().unwrap_or(0);
    let bases = fuzz::bases();
    let mut counts = fuzz::Counts::default();
    let started = Instant::now();
    for seed in first..first + count {
        counts.add(seed, fuzz::outcome(&fuzz::case(&bases, seed)));
        let done = seed - first + 1;
        if done % 100_000 == 0 {
            eprintln!("{done} after {:?}: {counts}", started.elapsed());
        }
    }
    eprintln!("{count} scene files made at random in {:?}: {counts}", started.elapsed());
    assert!(counts.panics.is_empty() && counts.slow.is_empty(), "some scene files bring pinhole down");
}
