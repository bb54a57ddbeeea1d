use super::error::{Error, Result};
use super::format::{Format, print_json};
use super::interrupt::{Waiting, interrupted};
use super::subject::Subject;
use pinhole::Overrides;
use pinhole_lab::measure::sweep::{Line, SIZE, sweep};
use serde::Serialize;
use std::io::Write;

/// A line for each thing done to a scene.
///
/// Errors: what a render of the scene would be refused for; a line that does not hold.
pub fn print_sweep(subject: &Subject<'_>, format: Format, out: &mut dyn Write) -> Result {
    let make = || subject.world(&Overrides::default());
    let lines = sweep(&make, &subject.stages(), &Waiting::new(0, true))?;
    if interrupted() {
        return Err(pinhole::Error::Interrupted.into());
    }
    let held = lines.iter().filter(|line| line.held).count();
    match format {
        Format::Json => {
            let [width, height] = SIZE;
            print_json(&Swept { scene: subject.name(), width, height, tried: lines.len(), held, lines: &lines }, out)?;
        }
        Format::Text => {
            writeln!(out, "{}, {} x {} pixels where no other size is named", subject.name(), SIZE[0], SIZE[1])?;
            writeln!(out, "{:<39}{:<44}{:<9}asked", "done", "came", "")?;
            for line in &lines {
                writeln!(out, "{line}")?;
            }
            writeln!(out, "held: {held} of {} lines", lines.len())?;
        }
    }
    match lines.iter().find(|line| !line.held) {
        None => Ok(()),
        Some(Line { done, came, asked, .. }) => {
            Err(Error::usage(format!("{} does not hold when {done}: {came}, where {asked} is asked", subject.name())))
        }
    }
}

#[derive(Serialize)]
struct Swept<'a> {
    scene: &'a str,
    width: u32,
    height: u32,
    tried: usize,
    held: usize,
    lines: &'a [Line],
}
