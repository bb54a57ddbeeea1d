use super::arguments::TryExtremes;
use super::error::{Error, Result};
use super::find;
use super::format::{Format, number_or_word, print_json, shown};
use super::interrupt::{Waiting, interrupted};
use super::progress::say;
use super::span::told;
use pinhole::film::{check_place, write_whole};
use pinhole::scene::printable_path;
use pinhole::{Chapter, Overrides};
use pinhole_lab::measure::extremes::{Case, Group, Outcome, Worst, try_group, unbroken};
use pinhole_lab::measure::extremes_page::{page, strips};
use serde::Serialize;
use serde_json::{Value, json};
use std::io::Write;
use std::path::Path;
use std::time::{Duration, Instant};

/// From so many inputs a case it is said beforehand that all groups take long.
const MANY_RAYS: u64 = 20_000;
/// No two lines of progress follow each other sooner than this.
const SOONEST: Duration = Duration::from_secs(5);
/// The chapter whose scene the page's pictures show.
const SHOWN: &str = "05_pinhole";

/// A table a group, then how many cases held; a page of the same where one is asked for.
///
/// Errors: a case in which pinhole does not keep what is asked; a page that cannot be written.
pub fn print_extremes(chapters: &[Chapter], asked: &TryExtremes, format: Format, out: &mut dyn Write) -> Result {
    asked.page.as_deref().map_or(Ok(()), check_place)?;
    let groups = asked.group.map_or(Group::ALL.to_vec(), |group| vec![group]);
    let mut cases: Vec<Case> = Vec::new();
    let (began, mut told_at) = (Instant::now(), Duration::ZERO);
    if groups.len() > 1 && asked.rays >= MANY_RAYS {
        say(&format!(
            "note: {} groups with {} inputs a case may take a quarter of an hour; --rays 2000, or the name of a group, is \
             there sooner",
            groups.len(),
            asked.rays
        ));
    }
    for (done, &group) in groups.iter().enumerate() {
        let passed = began.elapsed();
        if done > 0 && passed.saturating_sub(told_at) >= SOONEST {
            told_at = passed;
            let left = passed.mul_f64((groups.len() - done) as f64 / done as f64);
            say(&format!("{done} of {} groups after {}, about {} left", groups.len(), told(passed), told(left)));
        }
        if !format.is_json() {
            writeln!(out, "{}", group.heading())?;
        }
        let tried = try_group(group, &asked.case, asked.rays, &Waiting::new(0, true));
        if interrupted() {
            return Err(pinhole::Error::Interrupted.into());
        }
        if !format.is_json() {
            tried.iter().try_for_each(|case| write!(out, "{case}"))?;
            writeln!(out)?;
        }
        cases.extend(tried);
    }
    if cases.is_empty() {
        return Err(Error::usage(format!("no case's name holds \"{}\"; without --case all are tried", asked.case)));
    }
    if let Some(file) = &asked.page {
        write_page(chapters, &cases, file)?;
    }
    let held = cases.iter().filter(|case| case.held()).count();
    if format.is_json() {
        let record = TrialsRecord {
            tried: cases.len(),
            held,
            unbroken_methods: unbroken(&cases),
            cases: cases.iter().map(CaseRecord::of).collect(),
            files: asked.page.iter().map(|file| shown(file)).collect(),
        };
        print_json(&record, out)?;
    } else {
        for method in unbroken(&cases) {
            writeln!(out, "no case here breaks \"{method}\"")?;
        }
        if let Some(file) = &asked.page {
            writeln!(out, "wrote {}", printable_path(file))?;
        }
        writeln!(out, "held: {held} of {} cases", cases.len())?;
    }
    match cases.iter().find(|case| !case.held()) {
        None => Ok(()),
        Some(case) => Err(Error::usage(format!("pinhole does not hold in the case \"{}\"", case.name))),
    }
}

fn write_page(chapters: &[Chapter], cases: &[Case], file: &Path) -> Result {
    let chapter = find::chapter(chapters, SHOWN)?;
    let make = || chapter.world(&Overrides::default());
    let page = page(cases, &strips(&make, &chapter.stages())?, chapter.name)?;
    Ok(write_whole(file, |file| file.write_all(page.as_bytes()))?)
}

#[derive(Serialize)]
struct TrialsRecord<'c> {
    tried: usize,
    held: usize,
    unbroken_methods: Vec<&'static str>,
    cases: Vec<CaseRecord<'c>>,
    files: Vec<String>,
}

#[derive(Serialize)]
struct CaseRecord<'c> {
    group: String,
    case: &'c str,
    inputs: u64,
    checked: u64,
    held: bool,
    methods: Vec<MethodRecord>,
    naive_at_its_worst: Option<Value>,
}

/// A method and how it did; what has no unit is right or wrong and no more.
#[derive(Serialize)]
struct MethodRecord {
    name: &'static str,
    is_naive: bool,
    result: String,
    wrong: u64,
    first_wrong_input: Option<u64>,
    unit: Option<&'static str>,
    worst_error: Option<Value>,
    worst_error_input: Option<u64>,
    /// None where no answer may be wrong and nothing else is asked.
    allowed_error: Option<f64>,
}

impl<'c> CaseRecord<'c> {
    fn of(case: &'c Case) -> Self {
        Self {
            group: case.group.to_string(),
            case: &case.name,
            inputs: case.rays,
            checked: case.hits,
            held: case.held(),
            methods: case.outcomes.iter().map(MethodRecord::of).collect(),
            naive_at_its_worst: case.worst.as_ref().map(|worst| at_worst(case, worst)),
        }
    }
}

impl MethodRecord {
    fn of(outcome: &Outcome) -> Self {
        let Outcome { method, score } = outcome;
        let unit = Some(method.unit).filter(|unit| !unit.is_empty());
        Self {
            name: method.name,
            is_naive: !method.of_pinhole,
            result: outcome.words().result.to_lowercase().replace(' ', "_"),
            wrong: score.wrong,
            first_wrong_input: score.first_wrong,
            unit,
            worst_error: unit.map(|_| number_or_word(score.worst)),
            worst_error_input: unit.map(|_| score.worst_at),
            allowed_error: unit.map(|_| method.bound).filter(|bound| bound.is_finite()),
        }
    }
}

/// The input at which a naive method is at its worst, and the answers there, or else the errors, where they are numbers.
fn at_worst(case: &Case, worst: &Worst) -> Value {
    let (method, own) = (case.outcomes[worst.method].method, case.outcomes[0].method);
    let [naive, pinhole] = [worst.method, 0].map(|row| worst.scores[row]);
    let answers = match (naive.said, pinhole.said) {
        (Some([naive, exact]), Some([pinhole, _])) => {
            let [naive, pinhole, exact] = [naive, pinhole, exact].map(|answer| answer.map(number_or_word));
            json!({ "naive": naive, "pinhole": pinhole, "exact": exact })
        }
        _ => Value::Null,
    };
    let comparable = answers.is_null() && naive.wrong == 0 && pinhole.wrong == 0 && method.unit == own.unit;
    let errors = comparable.then(|| {
        let [naive, pinhole] = [naive, pinhole].map(|score| number_or_word(score.worst));
        json!({ "naive": naive, "pinhole": pinhole, "unit": method.unit })
    });
    let (is_wrong, input) = (naive.wrong > 0, worst.input);
    json!({ "method": method.name, "input": input, "is_wrong": is_wrong, "answers": answers, "errors": errors })
}
