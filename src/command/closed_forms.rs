use super::arguments::TryClosedForms;
use super::interrupt::interrupted;
use crate::measure::closed_form::closed_forms;
use crate::{Error, Result};
use std::io::Write;

/// A line a closed form: what was measured, its standard error, the truth, how many standard errors lie between.
///
/// Errors: one that lies more than four standard errors from the truth.
pub fn print_closed_forms(asked: &TryClosedForms, out: &mut dyn Write) -> Result {
    writeln!(
        out,
        "{:<44} {:<38} {:>9} {:>20} {:>8}",
        "measured by whole renders", "formula", "truth", "measured", "off"
    )?;
    let mut missed = None;
    let mut found = false;
    for form in closed_forms().filter(|form| form.name.contains(&asked.case)) {
        if interrupted() {
            return Err(Error::Interrupted);
        }
        let truth = (form.truth)();
        let measured = form.measure(form.few.saturating_mul(asked.times), asked.seed)?;
        let (mean, error, off) = (measured.mean, measured.standard_error / truth, measured.deviation(truth));
        writeln!(
            out,
            "{:<44} {:<38} {truth:>9.5} {mean:>9.5} ± {:>6.3} % {off:>+5.1} SE",
            form.name,
            form.formula,
            100.0 * error
        )?;
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
