//! A million model files of each format made at random:
//! `cargo bench --bench fuzz_models [-- how many [the first seed] [gltf | glb | obj | ply]…]`.
//!
//! The same code, and few of the same files, run in `cargo test --test models`.

#[path = "../models/fuzz.rs"]
#[expect(dead_code, reason = "the tests use the rest")]
mod fuzz;

use std::time::Instant;

fn main() {
    // A panic is counted, not printed.
    std::panic::set_hook(Box::new(|_| {}));
    let words: Vec<String> = std::env::args().collect();
    let numbers: Vec<u64> = words.iter().filter_map(|word| word.parse().ok()).collect();
    let count = numbers.first().copied().unwrap_or(1_000_000);
    let first = numbers.get(1).copied().unwrap_or(0);
    let bases = fuzz::Bases::read();
    let mut all_hold = true;
    for format in fuzz::FORMATS {
        if fuzz::FORMATS.iter().any(|own| words.iter().any(|word| word == own))
            && !words.iter().any(|word| word == format)
        {
            continue;
        }
        let mut counts = fuzz::Counts::default();
        let started = Instant::now();
        for seed in first..first + count {
            counts.add(seed, fuzz::outcome(&fuzz::case(&bases, format, seed)));
            if (seed - first + 1) % 100_000 == 0 {
                eprintln!("{format}, {} after {:?}: {counts}", seed - first + 1, started.elapsed());
            }
        }
        eprintln!("{count} .{format} files made at random in {:?}: {counts}", started.elapsed());
        all_hold &= counts.hold();
    }
    drop(std::panic::take_hook());
    assert!(all_hold, "some model files bring their reader down");
}
