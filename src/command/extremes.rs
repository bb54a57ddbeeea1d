use super::arguments::TryExtremes;
use super::find;
use super::interrupt::{Waiting, interrupted};
use crate::chapter::{Asked, Chapter};
use crate::film::{check_place, write_whole};
use crate::measure::extremes::{Case, Group, try_group, unbroken};
use crate::measure::extremes_page::{page, strips};
use crate::{Error, Result};
use std::io::Write;
use std::path::Path;

/// The chapter whose scene the page's pictures show.
const SHOWN: &str = "05_pinhole";

/// A table a group, then how many cases held; a page of the same where one is asked for.
///
/// Errors: a case in which the kit does not keep what is asked; a page that cannot be written.
pub fn print_extremes(chapters: &[Chapter], asked: &TryExtremes, out: &mut dyn Write) -> Result {
    asked.page.as_deref().map_or(Ok(()), check_place)?;
    let groups = asked.group.map_or(Group::ALL.to_vec(), |group| vec![group]);
    let mut cases: Vec<Case> = Vec::new();
    for group in groups {
        writeln!(out, "{}", group.heading())?;
        let tried = try_group(group, &asked.case, asked.rays, &Waiting::new(0, true));
        if interrupted() {
            return Err(Error::Interrupted);
        }
        for case in &tried {
            write!(out, "{case}")?;
        }
        writeln!(out)?;
        cases.extend(tried);
    }
    if cases.is_empty() {
        return Err(Error::Usage(format!("no case's name holds \"{}\"; without --case all are tried", asked.case)));
    }
    for method in unbroken(&cases) {
        writeln!(out, "no case here breaks \"{method}\"")?;
    }
    if let Some(file) = &asked.page {
        write_page(chapters, &cases, file)?;
        writeln!(out, "wrote {}", file.display())?;
    }
    let held = cases.iter().filter(|case| case.held()).count();
    writeln!(out, "held: {held} of {} cases", cases.len())?;
    match cases.iter().find(|case| !case.held()) {
        None => Ok(()),
        Some(case) => Err(Error::Usage(format!("the kit does not hold in the case \"{}\"", case.name))),
    }
}

fn write_page(chapters: &[Chapter], cases: &[Case], file: &Path) -> Result {
    let chapter = find::chapter(chapters, SHOWN)?;
    let make = || chapter.world(&Asked::default());
    let page = page(cases, &strips(&make, &chapter.stages())?, chapter.name)?;
    write_whole(file, |file| file.write_all(page.as_bytes()))
}
