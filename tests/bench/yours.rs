//! What `yours` says of the reader's program with mistakes, and of right ones that look unlike the book's.
//!
//! `cargo bench --bench yours`; a few minutes.
#![allow(clippy::print_stdout, reason = "a bench prints what it found")]

#[path = "../yours/programs.rs"]
mod programs;

use pinhole_lab::yours::Comparison;
use programs::{MISTAKES, RIGHT, found};

fn main() {
    let (mut told, mut named) = (0, 0);
    for edit @ (chapter, old, new) in MISTAKES {
        let said = match found(edit) {
            Comparison::Same { .. } => "not told",
            Comparison::Differs { looks_like, .. } => {
                told += 1;
                named += usize::from(looks_like.is_some());
                looks_like.unwrap_or("told, not named")
            }
        };
        println!("{chapter:>2}  {:<50}  {:<40}  {said}", old.trim(), new.trim());
    }
    let refused: Vec<_> = RIGHT.into_iter().filter(|edit| !matches!(found(*edit), Comparison::Same { .. })).collect();
    println!("mistakes: {} tried, {told} told, {named} named", MISTAKES.len());
    println!("right programs: {} tried, {} called wrong {refused:?}", RIGHT.len(), refused.len());
}
