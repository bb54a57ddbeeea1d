//! What `check` says of wrong answers that were written before looking at what it knows, and whether it takes right ones
//! that look unlike the book's.
//!
//! `cargo bench --profile dev --bench wrong_answers`; half a minute. With a number, that chapter alone; with
//! `-- --second` or `-- --third`, those that were written later, each set before anybody looked at what was known by then.
#![allow(clippy::print_stdout, reason = "a bench prints what it found")]
#![allow(clippy::disallowed_methods, reason = "readers write with the platform's functions")]

#[path = "wrong_answers/mod.rs"]
mod wrong_answers;

use pinhole_lab::exercise::{Outcome, PATIENCE, Report};
use wrong_answers::Fresh;

fn main() {
    let only = std::env::args().find_map(|word| word.parse::<usize>().ok());
    let asks = |word: &str| std::env::args().any(|own| own == word);
    let answers = match () {
        () if asks("--second") => wrong_answers::second(),
        () if asks("--third") => wrong_answers::third(),
        () => wrong_answers::all(),
    };
    let (mut tried, mut named, mut refused) = (0, 0, 0);
    for Fresh { chapter, wrong, right } in answers {
        if only.is_some_and(|only| only != chapter) {
            continue;
        }
        let mut here = 0;
        for (answer, words) in &wrong {
            let said = remark(&answer.check(PATIENCE));
            let is_named = !words.is_empty() && said.contains(words);
            here += usize::from(is_named);
            if !is_named {
                println!("{chapter:>2}  \"{words}\": {said}");
            }
        }
        let taken = right.iter().map(|answer| answer.check(PATIENCE));
        let not: Vec<_> = taken.filter(|report| !report.is_done()).collect();
        for report in &not {
            println!("{chapter:>2}  a right answer is refused: {:?}", report.outcome);
        }
        println!("{chapter:>2}  {} tried, {here} named; {} right, {} refused", wrong.len(), right.len(), not.len());
        (tried, named, refused) = (tried + wrong.len(), named + here, refused + not.len());
    }
    println!("{tried} wrong answers, {named} named; {refused} right ones refused");
}

/// What a report says that the mistake is.
fn remark(report: &Report) -> String {
    match &report.outcome {
        Outcome::Wrong(mismatch) | Outcome::OrdinaryRight(mismatch) => {
            mismatch.looks_like.clone().unwrap_or_else(|| format!("nothing known: {mismatch:?}"))
        }
        other => format!("{other:?}"),
    }
}
