use super::error::{Error, Result};
use super::find;
use super::format::{Format, number_or_word, print_json};
use pinhole::Chapter;
use pinhole_lab::exercise::{Exercise, Outcome, Progress, Turn, list_exercises, take_turn, turn, what_is_left};
use serde::Serialize;
use serde_json::{Value, json};
use std::io::Write;
use std::path::Path;

/// Where it is remembered which exercises were tried and which are done.
const PROGRESS: &str = "out/check.json";

/// The name of a chapter, and what it asks its reader to write.
pub type Named = (&'static str, Exercise);

/// Checks the reader's function of one chapter, or lists those of all.
///
/// Errors: a wrong answer, in one sentence after the report; no such chapter, or none with an exercise.
pub fn check(
    chapters: &[Chapter],
    exercises: &[Named],
    asked: Option<&str>,
    format: Format,
    out: &mut dyn Write,
) -> Result {
    let file = Path::new(PROGRESS);
    match (asked, format) {
        (None, Format::Text) => Ok(list_exercises(exercises, file, out)?),
        (None, Format::Json) => print_json(&told(exercises, file), out),
        (Some(asked), Format::Text) => {
            let (name, exercise) = exercise_of(chapters, exercises, asked)?;
            Ok(take_turn(name, exercise, file, out)?)
        }
        (Some(asked), Format::Json) => {
            let (name, exercise) = exercise_of(chapters, exercises, asked)?;
            let turn = turn(name, exercise, file);
            print_json(&CheckRecord::of(name, &turn), out)?;
            Ok(what_is_left(name, &turn.report)?)
        }
    }
}

/// A chapter's name and the function that it asks for.
///
/// Errors: no such chapter, or none with an exercise.
pub fn exercise_of<'e>(chapters: &[Chapter], exercises: &'e [Named], asked: &str) -> Result<&'e Named> {
    let name = find::chapter(chapters, asked)?.name;
    let none = || format!("{name} has no exercise to check; `check` without a chapter lists those that have one");
    exercises.iter().find(|(chapter, _)| *chapter == name).ok_or_else(|| Error::usage(none()))
}

fn told(exercises: &[Named], file: &Path) -> Value {
    let (progress, remark) = Progress::read(file);
    let told = |(chapter, exercise): &(&str, Exercise)| {
        let file = format!("chapters/{chapter}/exercise.rs");
        json!({
            "chapter": chapter, "function": exercise.function, "file": file, "tries": progress.of(chapter),
        })
    };
    let exercises: Vec<Value> = exercises.iter().map(told).collect();
    json!({ "exercises": exercises, "notes": remark.into_iter().collect::<Vec<String>>() })
}

#[derive(Serialize)]
struct CheckRecord<'t> {
    chapter: &'static str,
    function: &'static str,
    /// right, ordinary (right for ordinary inputs, not for all extreme ones), wrong, stub, panicked or late.
    outcome: &'static str,
    inputs: usize,
    extreme_inputs: usize,
    wrong_inputs: Option<usize>,
    allowed_error: f64,
    error_unit: &'static str,
    /// The worst error of right answers, or the error of the first wrong one.
    error: Option<Value>,
    /// The input that was answered wrongly first, or not at all.
    input: Option<Value>,
    /// What came of that input: yours, expected, difference, looks_like; or a panic; or the patience in seconds.
    answer: Option<Value>,
    hints: &'static [&'static str],
    hints_in_all: usize,
    pinhole_has: Option<Value>,
    tries: Value,
    notes: &'t [String],
}

impl<'t> CheckRecord<'t> {
    fn of(chapter: &'static str, turn: &'t Turn) -> Self {
        let report = &turn.report;
        let ((file, name), (allowed_error, error_unit)) = (report.pinhole_has, report.allowed);
        let (outcome, error, asked, answer) = match &report.outcome {
            Outcome::Right(worst) => ("right", Some(*worst), None, None),
            Outcome::OrdinaryRight(found) | Outcome::Wrong(found) => {
                let word = match report.is_done() {
                    true => "ordinary",
                    false if report.is_stub() => "stub",
                    false => "wrong",
                };
                let answer = json!({
                    "yours": found.yours, "expected": found.right, "difference": found.difference,
                    "looks_like": found.looks_like,
                });
                (word, Some(found.apart), Some(&found.asked), Some(answer))
            }
            Outcome::Panicked(asked, words) => ("panicked", None, Some(asked), Some(json!({ "panic": words }))),
            Outcome::Late(asked, patience) => {
                let patience = json!({ "patience_seconds": patience.as_secs_f64() });
                ("late", None, Some(asked), Some(patience))
            }
        };
        let wrong = match &report.outcome {
            Outcome::OrdinaryRight(found) | Outcome::Wrong(found) => Some(found.wrong),
            _ => None,
        };
        Self {
            chapter,
            function: report.function,
            outcome,
            inputs: report.inputs,
            extreme_inputs: report.extremes,
            wrong_inputs: wrong,
            allowed_error,
            error_unit,
            error: error.map(number_or_word),
            input: asked.map(|asked| json!({ "number": asked.number, "about": asked.about, "arguments": asked.input })),
            answer,
            hints: turn.hints(),
            hints_in_all: report.hints.len(),
            pinhole_has: report.is_done().then(|| json!({ "file": file, "name": name })),
            tries: json!(turn.tries),
            notes: &turn.notes,
        }
    }
}
