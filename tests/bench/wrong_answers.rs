//! What `check` says of wrong answers that were written before looking at what it knows, and whether it takes right ones
//! that look unlike the book's.
//!
//! `cargo bench --profile dev --bench wrong_answers`; half a minute. With a number, that chapter alone; with
//! `-- --latest`, those that were written last, before anybody looked at what was known by then.
#![allow(clippy::print_stdout, reason = "a bench prints what it found")]
#![allow(clippy::disallowed_methods, reason = "readers write with the platform's functions")]

#[path = "wrong_answers/mod.rs"]
mod wrong_answers;

#[allow(dead_code, reason = "what is right is for the tests")]
#[path = "../exercises/answers.rs"]
mod answers;

use pinhole_lab::exercise::{Exercise, Outcome, PATIENCE, Report};
use std::collections::HashSet;
use wrong_answers::Fresh;

fn main() {
    let only = std::env::args().find_map(|word| word.parse::<usize>().ok());
    let asks = |word: &str| std::env::args().any(|own| own == word);
    let (answers, earlier) = match () {
        () if asks("--latest") => (wrong_answers::latest(), wrong_answers::all()),
        () => (wrong_answers::all(), Vec::new()),
    };
    // What was answered before: in the tests, and in the earlier set.
    let mut known: HashSet<Signature> = answers::ALL
        .iter()
        .flat_map(|(stem, answers)| {
            let chapter = stem[..2].parse().unwrap_or(0);
            answers().wrong.map(|(answer, _)| signature(chapter, &answer))
        })
        .collect();
    for Fresh { chapter, wrong, .. } in earlier {
        known.extend(wrong.iter().map(|(answer, _)| signature(chapter, answer)));
    }
    let (mut new, mut new_named) = (0, 0);
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
            if known.insert(signature(chapter, answer)) {
                (new, new_named) = (new + 1, new_named + usize::from(is_named));
            }
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
    println!("{new} that no earlier set has, {new_named} of them named");
}

/// What tells one wrong answer from another: the chapter, the first input that is answered wrongly, the answer, and how many
/// are wrong.
type Signature = (usize, usize, String, usize);

fn signature(chapter: usize, answer: &Exercise) -> Signature {
    match answer.check(PATIENCE).outcome {
        Outcome::Wrong(own) | Outcome::OrdinaryRight(own) => (chapter, own.asked.number, own.yours, own.wrong),
        other => (chapter, 0, format!("{other:?}"), 0),
    }
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
