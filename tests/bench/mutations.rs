//! Mutations that a program chooses, and what the tests that are no snapshots notice of them.
//!
//! `cargo bench --bench mutations` copies the workspace to target/mutations, changes one operator, constant, component
//! or sign in each of many functions, and builds all of these mutations at once, each behind a switch that is read when
//! the program runs; so one build serves all.
//! A first run of every test records which mutated functions it reaches.
//! Then each mutation is switched on, and the tests that run its function follow, the quickest first, until one fails.
//! Snapshots always pass (insta's own switch), and the target `chapters` does not run, so that what catches a mutation
//! is a closed form, an identity or an independent method.
//! What fails or is too slow without any mutation is left out and listed.
//!
//! `--again REPORT` tries once more what an earlier report of the bench on standard error says has survived.
//!
//! Flags: `--count 150`, `--seed 1`, `--folders src/pinhole/shade,src/lab/report`, `--jobs 2`, `--seconds 300` (the most
//! for one mutation), `--minutes 600` (the most for all), `--slowest 60` (seconds of the longest test that runs),
//! `--targets renderer,laboratory,program`, `--cargo "nice cargo"` (how cargo is called).
#![allow(clippy::print_stdout, reason = "a benchmark's product is what it prints")]

#[path = "mutations/build.rs"]
mod build;
#[path = "mutations/choose.rs"]
mod choose;
#[path = "mutations/run.rs"]
mod run;
#[path = "mutations/source.rs"]
mod source;

use build::Workspace;
use choose::Mutation;
use run::{Fate, Limits};
use std::path::Path;
use std::time::{Duration, Instant};

fn main() {
    let words: Vec<String> = std::env::args().collect();
    let after = |flag: &str| words.iter().position(|word| word == flag).and_then(|at| words.get(at + 1)).cloned();
    let number = |flag: &str, default: u64| after(flag).and_then(|word| word.parse().ok()).unwrap_or(default);
    let list = |flag: &str, default: &str| -> Vec<String> {
        let words = after(flag).unwrap_or_else(|| default.into());
        words.split(',').map(String::from).collect()
    };
    let started = Instant::now();
    let cargo = after("--cargo").unwrap_or_else(|| "cargo".into());
    let workspace = Workspace::copied(Path::new(env!("CARGO_MANIFEST_DIR")), &cargo);
    let mut candidates =
        choose::candidates(&workspace.folder, &list("--folders", choose::FOLDERS), number("--seed", 1));
    println!("{} mutations could be made; seed {}", candidates.len(), number("--seed", 1));
    if let Some(report) = after("--again") {
        let report = std::fs::read_to_string(report).expect("an earlier report");
        let survived: Vec<&str> =
            report.lines().filter_map(|line| line.split_once(": SURVIVED")).map(|line| line.0).collect();
        candidates.retain(|own| survived.contains(&format!("{} {}", own.place(), own.change).as_str()));
    }
    let (mutations, refused) = workspace.instrumented(candidates, number("--count", 150) as usize);
    println!("{} compile, {refused} that were tried do not, after {:.0?}", mutations.len(), started.elapsed());
    let tests = workspace.tests(&list("--targets", "renderer,laboratory,program"));
    println!("built: {} tests, after {:.0?}", tests.len(), started.elapsed());
    let limits = Limits {
        jobs: number("--jobs", 2) as usize,
        of_mutation: Duration::from_secs(number("--seconds", 300)),
        of_test: Duration::from_secs(number("--slowest", 60)),
        end: started + Duration::from_secs(60 * number("--minutes", 600)),
    };
    let tests = run::reached(tests, &limits, &workspace.folder);
    println!("reached: after {:.0?}", started.elapsed());
    let fates = run::fates(&mutations, &tests, &limits);
    report(&mutations, &fates);
    println!("{:.0?} in all", started.elapsed());
}

/// A line for each mutation, then the fraction caught, by folder and in all, and the survivors.
fn report(mutations: &[Mutation], fates: &[Option<Fate>]) {
    let tried: Vec<(&Mutation, &Fate)> =
        mutations.iter().zip(fates).filter_map(|(mutation, fate)| Some((mutation, fate.as_ref()?))).collect();
    for (mutation, fate) in &tried {
        println!("{:<46} {:<22} {fate}", mutation.place(), mutation.change);
    }
    let mut folders: Vec<&str> = tried.iter().map(|(mutation, _)| mutation.folder()).collect();
    folders.sort_unstable();
    folders.dedup();
    let fraction = |name: &str, of: &dyn Fn(&Mutation) -> bool| {
        let all: Vec<&Fate> = tried.iter().filter(|(mutation, _)| of(mutation)).map(|(_, fate)| *fate).collect();
        let caught = all.iter().filter(|fate| fate.is_caught()).count();
        let percent = 100.0 * caught as f64 / all.len().max(1) as f64;
        println!("{name:<28} {caught:>4} of {:>4} caught, {percent:.1} %", all.len());
    };
    println!();
    folders.iter().for_each(|&folder| fraction(folder, &|mutation| mutation.folder() == folder));
    fraction("boundaries (< and ≤) alone", &Mutation::is_boundary);
    fraction("all but boundaries", &|mutation| !mutation.is_boundary());
    fraction("all", &|_| true);
    println!("{} of {} were not tried for want of time", mutations.len() - tried.len(), mutations.len());
    println!("\nSurvivors; those at a boundary may be equivalent:");
    for (mutation, fate) in tried.iter().filter(|(_, fate)| !fate.is_caught()) {
        println!("{} {}: {fate}\n  - {}\n  + {}", mutation.place(), mutation.change, mutation.before, mutation.after);
    }
}
