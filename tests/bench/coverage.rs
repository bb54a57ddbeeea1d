//! How often the intervals of `report` hold the truth, on renderers whose variance and bias are known.
//!
//! `cargo bench --bench coverage` repeats each 1,000 times; `-- --repetitions 200` takes fewer.
//! Those marked `*` are outside 93 to 97 %.
#![allow(clippy::print_stdout, reason = "a benchmark's product is what it prints")]

#[path = "../report/coverage.rs"]
mod coverage;
#[path = "../report/synthetic.rs"]
mod synthetic;

use synthetic::Noise;

fn main() {
    let words: Vec<String> = std::env::args().collect();
    let after = |flag: &str| words.iter().position(|word| word == flag).and_then(|at| words.get(at + 1));
    let repetitions = after("--repetitions").and_then(|count| count.parse().ok()).unwrap_or(1000);
    let noises = [Noise::Gaussian, Noise::Uniform, Noise::Lognormal(0.5), Noise::Lognormal(1.0), Noise::Lognormal(2.5)];
    for noise in noises {
        for bias in [0.0, 0.1] {
            println!("{noise:?}, bias field up to {bias}");
            for row in coverage::coverage(noise, bias, repetitions) {
                let share = 100.0 * row.held as f64 / row.of.max(1) as f64;
                let mark = if (93.0..=97.0).contains(&share) { ' ' } else { '*' };
                println!("  {:<40} {share:5.1} %{mark}  of {}, {} refused", row.what, row.of, row.refused);
            }
        }
    }
}
