use super::arguments::TryClosedForms;
use super::error::{Error, Result};
use super::format::{Format, number_or_word, print_json};
use super::interrupt::interrupted;
use pinhole_lab::measure::closed_form::{ClosedForm, Measured, closed_forms};
use serde::Serialize;
use serde_json::{Value, json};
use std::io::Write;

/// A line a closed form: what was measured, its standard error, the truth, how many standard errors lie between; below it
/// the formula, for there is no room behind it on a page of the book.
///
/// Where nothing is random, what rounding may do stands in for the standard error.
/// Errors: one that lies more than four standard errors from the truth.
pub fn print_closed_forms(asked: &TryClosedForms, format: Format, out: &mut dyn Write) -> Result {
    if !format.is_json() {
        writeln!(
            out,
            "{:<NAME$}{:>10}{:>10}{:>11}{:>9}",
            "measured by whole renders, and its formula", "truth", "measured", "error", "off by"
        )?;
    }
    let mut told = Vec::new();
    for form in closed_forms().filter(|form| form.name.contains(&asked.case)) {
        if interrupted() {
            return Err(pinhole::Error::Interrupted.into());
        }
        let measured = form.measure(form.few.saturating_mul(asked.times), asked.seed)?;
        if !format.is_json() {
            writeln!(out, "{}", line(form, &measured))?;
        }
        told.push(FormRecord::of(form, &measured));
    }
    if told.is_empty() {
        return Err(Error::usage(format!("no closed form's name holds \"{}\"", asked.case)));
    }
    if format.is_json() {
        let held = told.iter().filter(|told| told.held).count();
        print_json(&json!({ "tried": told.len(), "held": held, "closed_forms": told }), out)?;
    }
    match told.iter().find(|told| !told.held) {
        None => Ok(()),
        Some(FormRecord { name, .. }) => {
            Err(Error::usage(format!("\"{name}\" lies more than 4 standard errors from the truth")))
        }
    }
}

/// How wide the names are.
const NAME: usize = 44;

fn line(form: &ClosedForm, measured: &Measured) -> String {
    let ClosedForm { name, formula, .. } = form;
    let truth = (form.truth)();
    let (mean, off) = (measured.mean, measured.deviation(truth));
    let (error, unit) = if measured.is_exact(truth) {
        ("rounding".into(), "r ")
    } else {
        (format!("± {:.3} %", 100.0 * measured.standard_error / truth), "SE")
    };
    format!("{name:<NAME$}{truth:>10.5}{mean:>10.5}{error:>11}{off:>+6.1} {unit}\n  {formula}")
}

#[derive(Serialize)]
struct FormRecord {
    name: &'static str,
    formula: &'static str,
    truth: f64,
    measured: f64,
    standard_error: f64,
    samples: u64,
    off_by: Value,
    /// What `off_by` is counted in: standard errors, or what rounding may do, where nothing is random.
    off_by_unit: &'static str,
    held: bool,
}

impl FormRecord {
    fn of(form: &ClosedForm, measured: &Measured) -> Self {
        let truth = (form.truth)();
        let off = measured.deviation(truth);
        Self {
            name: form.name,
            formula: form.formula,
            truth,
            measured: measured.mean,
            standard_error: measured.standard_error,
            samples: measured.count,
            off_by: number_or_word(off),
            off_by_unit: if measured.is_exact(truth) { "rounding_bounds" } else { "standard_errors" },
            held: off.abs() <= 4.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The book breaks longer lines (`book/builder/check/fit.rs`), and a broken table is none.
    #[test]
    fn every_line_fits_a_page_of_the_book() {
        let mut tried = 0;
        for form in closed_forms() {
            let truth = (form.truth)();
            assert!(form.name.chars().count() <= NAME, "{}", form.name);
            for (mean, standard_error) in [(truth, 0.0), (truth * 1.05, truth * 0.123)] {
                let line = line(form, &Measured { mean, standard_error, count: 1 });
                let widest = line.lines().map(|line| line.chars().count()).max();
                assert!(widest.is_some_and(|widest| widest <= 84), "{line}");
                tried += 1;
            }
        }
        assert!(tried > 40, "{tried}");
    }
}
