use super::compare::{Outcome, Report};
use super::{Exercise, PATIENCE, Progress, Tries};
use pinhole::{Error, Result};
use std::io::Write;
use std::path::Path;

/// One check of a reader's function, and what is remembered of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Turn {
    /// How the function did.
    pub report: Report,
    /// The tries so far, this one among them.
    pub tries: Tries,
    /// What is to be said of the file in which tries are remembered.
    pub notes: Vec<String>,
}

/// Checks a chapter's exercise once, and remembers it in the file.
pub fn turn(name: &str, exercise: &Exercise, file: &Path) -> Turn {
    let (mut progress, remark) = Progress::read(file);
    let mut notes: Vec<String> = remark.into_iter().collect();
    let report = exercise.check(PATIENCE);
    let mut tries = progress.of(name);
    if !report.is_stub() {
        let done = report.is_done();
        tries.tried = tries.tried.saturating_add(1);
        // Whoever is told the mistake is not stuck.
        let is_stuck = u32::from(!report.is_named());
        tries.wrong = if done { 0 } else { tries.wrong.saturating_add(is_stuck) };
        tries.done = done;
        tries.extremes = matches!(report.outcome, Outcome::Right(_)) && report.extremes > 0;
        progress.0.insert(name.into(), tries);
        if let Err(refused) = progress.write(file) {
            notes.push(format!("this try will not be remembered: {refused}"));
        }
    }
    Turn { report, tries, notes }
}

impl Turn {
    /// The hints that the reader has earned: one for each wrong try whose mistake was not
    /// named, unless that of this one is.
    pub fn hints(&self) -> &'static [&'static str] {
        let all = self.report.hints;
        let earns = !self.report.is_done() && !self.report.is_stub() && !self.report.is_named();
        &all[..if earns { all.len().min(self.tries.wrong as usize) } else { 0 }]
    }
}

/// Checks a chapter's exercise once: prints how the reader's function did, and remembers it in the file.
///
/// Errors: a wrong answer, a panic or no answer in time, with what to do next, for all else has been printed; printing
/// failed.
pub fn take_turn(name: &str, exercise: &Exercise, file: &Path, out: &mut dyn Write) -> Result {
    let Turn { report, tries, notes } = turn(name, exercise, file);
    report.print(tries.wrong as usize, out)?;
    let number = name.split('_').next().unwrap_or(name).trim_start_matches('0');
    match report.outcome {
        Outcome::Right(_) => writeln!(out, "next: `check` without a chapter shows what is left")?,
        Outcome::OrdinaryRight(_) => {
            writeln!(out, "next: on with the chapter, or edit chapters/{name}/exercise.rs for the second star")?;
        }
        _ => {}
    }
    if exercise.renders() && !report.is_stub() {
        writeln!(out, "`render {number} --mine` shows it")?;
    }
    notes.iter().try_for_each(|note| writeln!(out, "note: {note}"))?;
    what_is_left(name, &report)
}

/// What to do after a check.
///
/// Errors: that, where the function is not right yet; what is wrong with it, the report says.
pub fn what_is_left(name: &str, report: &Report) -> Result {
    let number = name.split('_').next().unwrap_or(name).trim_start_matches('0');
    match report.is_done() {
        true => Ok(()),
        false => Err(Error::Usage(format!("edit chapters/{name}/exercise.rs, then `check {number}` again"))),
    }
}

/// The exercises of all chapters, and how far the reader has come.
///
/// Errors: printing failed.
pub fn list_exercises(exercises: &[(&str, Exercise)], file: &Path, out: &mut dyn Write) -> Result {
    let (progress, remark) = Progress::read(file);
    writeln!(out, "functions for you to write, each checked against pinhole's:")?;
    let widest = exercises.iter().map(|(_, exercise)| exercise.function.len()).max().unwrap_or(0);
    for (chapter, exercise) in exercises {
        let tries = progress.of(chapter);
        let state = match (tries.done, tries.tried) {
            (true, _) if tries.extremes => "done ★★".into(),
            (true, _) => "done ★".into(),
            (false, 0) => "not tried".into(),
            (false, 1) => "tried once".into(),
            (false, times) => format!("tried {times} times"),
        };
        writeln!(out, "  {:<22} {:<widest$}  {state}", chapter, exercise.function)?;
    }
    writeln!(out, "each lies in chapters/<chapter>/exercise.rs; `check 5` tries that of chapter 05")?;
    if let Some(remark) = remark {
        writeln!(out, "note: {remark}")?;
    }
    Ok(())
}
