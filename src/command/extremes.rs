use super::arguments::TryExtremes;
use super::interrupt::{Waiting, interrupted};
use crate::measure::extremes::{Case, Group, try_group, unbroken};
use crate::{Error, Result};
use std::io::Write;

/// A table a group, then how many cases held.
///
/// Errors: a case in which the kit does not keep what is asked.
pub fn print_extremes(asked: &TryExtremes, out: &mut dyn Write) -> Result {
    let groups = asked.group.map_or(Group::ALL.to_vec(), |group| vec![group]);
    let mut cases: Vec<Case> = Vec::new();
    for group in groups {
        writeln!(out, "{}", group.heading())?;
        let tried = try_group(group, asked.rays, &Waiting::new(0, true));
        if interrupted() {
            return Err(Error::Interrupted);
        }
        for case in &tried {
            write!(out, "{case}")?;
        }
        writeln!(out)?;
        cases.extend(tried);
    }
    for method in unbroken(&cases) {
        writeln!(out, "no case here breaks \"{method}\"")?;
    }
    let held = cases.iter().filter(|case| case.held()).count();
    writeln!(out, "held: {held} of {} cases", cases.len())?;
    match cases.iter().find(|case| !case.held()) {
        None => Ok(()),
        Some(case) => Err(Error::Usage(format!("the kit does not hold in the case \"{}\"", case.name))),
    }
}
