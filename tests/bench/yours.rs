//! What `yours` says of the reader's program with mistakes, and of right ones that look unlike the book's.
//!
//! `cargo bench --bench yours`; a few minutes.
#![allow(clippy::print_stdout, reason = "a bench prints what it found")]

#[path = "../yours/programs.rs"]
mod programs;

use programs::{MISTAKES, NOT_NAMED, RIGHT, found, said};

fn main() {
    let (mut told, mut named) = (0, 0);
    for edit @ (chapter, old, new) in MISTAKES {
        let said = said(&found(edit));
        told += usize::from(said.is_some());
        named += usize::from(said.is_some_and(|said| said != NOT_NAMED));
        println!("{chapter:>2}  {:<50}  {:<40}  {}", old.trim(), new.trim(), said.unwrap_or("not told"));
    }
    println!("mistakes: {} tried, {told} told, {named} named", MISTAKES.len());
    let refused: Vec<_> = RIGHT.into_iter().filter(|edit| said(&found(*edit)).is_some()).collect();
    println!("right programs: {} tried, {} called wrong {refused:?}", RIGHT.len(), refused.len());
}
