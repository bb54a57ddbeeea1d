//! Readers of model files keep their promises to damaged files: no panic, and memory in proportion.
//!
//! These tests count the memory of the whole process, so they run one after another.

#![allow(clippy::disallowed_methods, reason = "what a test expects may come from the platform's functions")]

#[path = "models/fuzz.rs"]
mod fuzz;
#[path = "models/odd_files.rs"]
mod odd_files;

use std::sync::{Mutex, PoisonError};

static ALONE: Mutex<()> = Mutex::new(());

#[test]
fn damaged_model_files_are_read_or_refused() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let bases = fuzz::Bases::read();
    for format in fuzz::FORMATS {
        let mut counts = fuzz::Counts::default();
        for seed in 0..1000 {
            counts.add(seed, fuzz::outcome(&fuzz::case(&bases, format, seed)));
        }
        eprintln!("1000 .{format} files made at random: {counts}");
        assert!(counts.hold(), ".{format}: {counts}");
    }
}

#[test]
fn small_files_that_ask_for_much_are_given_little() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    for case in fuzz::greedy() {
        let mut counts = fuzz::Counts::default();
        counts.add(0, fuzz::outcome(&case));
        eprintln!("{}, {} bytes: {counts}", case.name, case.bytes.len());
        assert!(counts.hold(), "{}: {counts}", case.name);
    }
}
