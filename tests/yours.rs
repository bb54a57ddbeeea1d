//! The program that a reader writes from the first page on: every step compiles, and shows what pinhole shows.

#[path = "yours/programs.rs"]
pub mod programs;

use pinhole_lab::yours::{Verdict, program_after, steps};
use programs::{MISTAKES, RIGHT, found};

/// Chapters whose pictures have no noise, so that a mistake is told in a second; the bench `yours` tries all.
const QUICK: u32 = 13;

#[test]
fn every_state_shows_what_pinhole_shows() {
    for step in steps() {
        let lines = program_after(step.number).expect("applies").lines().count();
        let found = found((step.number, "fn main", "fn main"));
        let Verdict::Same { resolved } = found else { panic!("{}: {found:?}", step.chapter) };
        assert!(resolved < 0.2, "{}: {resolved}", step.chapter);
        eprintln!("{}: {lines} lines, the same; {:.1} % would be told", step.chapter, 100.0 * resolved);
    }
}

#[test]
fn mistakes_are_told_and_right_programs_accepted() {
    let (mut tried, mut named) = (0, 0);
    for edit in MISTAKES.into_iter().filter(|edit| edit.0 <= QUICK) {
        let Verdict::Differs { looks_like, .. } = found(edit) else { panic!("{edit:?} is not told") };
        tried += 1;
        named += usize::from(looks_like.is_some());
    }
    for edit in RIGHT.into_iter().filter(|edit| edit.0 <= QUICK) {
        assert!(matches!(found(edit), Verdict::Same { .. }), "{edit:?} is right");
    }
    eprintln!("mistakes in the reader's program: {tried} told, {named} of them named");
    assert!(tried >= 20 && 10 * named >= 5 * tried);
}
