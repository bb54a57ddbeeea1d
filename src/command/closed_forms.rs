use super::arguments::TryClosedForms;
use super::interrupt::interrupted;
use crate::measure::closed_form::{ClosedForm, closed_forms};
use crate::{Error, Result};
use std::io::Write;

/// A line a closed form: what was measured, its standard error, the truth, how many standard errors lie between.
///
/// Where nothing is left to chance, what rounding may do stands in for the standard error.
/// Errors: one that lies more than four standard errors from the truth.
pub fn print_closed_forms(asked: &TryClosedForms, out: &mut dyn Write) -> Result {
    writeln!(
        out,
        "{:<46}{:>10}{:>11}{:>13}{:>10}   formula",
        "measured by whole renders", "truth", "measured", "error", "off by"
    )?;
    let mut missed = None;
    let mut found = false;
    for form in closed_forms().filter(|form| form.name.contains(&asked.case)) {
        if interrupted() {
            return Err(Error::Interrupted);
        }
        let truth = (form.truth)();
        let measured = form.measure(form.few.saturating_mul(asked.times), asked.seed)?;
        let (mean, off) = (measured.mean, measured.deviation(truth));
        let (error, unit) = if measured.is_exact(truth) {
            ("rounding".into(), "r ")
        } else {
            (format!("± {:.3} %", 100.0 * measured.standard_error / truth), "SE")
        };
        let ClosedForm { name, formula, .. } = form;
        writeln!(out, "{name:<46}{truth:>10.5}{mean:>11.5}{error:>13}{off:>+7.1} {unit}   {formula}")?;
        found = true;
        if off.abs() > 4.0 {
            missed = missed.or(Some(form.name));
        }
    }
    match missed {
        _ if !found => Err(Error::Usage(format!("no closed form's name holds \"{}\"", asked.case))),
        None => Ok(()),
        Some(name) => Err(Error::Usage(format!("\"{name}\" lies more than 4 standard errors from the truth"))),
    }
}
