use super::arguments::SceneOptions;
use super::subject::Subject;
use crate::Result;
use crate::render::prepare;
use std::io::Write;

/// The plan of a scene.
pub fn print_plan(subject: &Subject<'_>, options: &SceneOptions, out: &mut dyn Write) -> Result {
    let asked = options.asked(false);
    let prepared = prepare(&subject.world(&asked), &subject.stages());
    let (plan, tables) = prepared.map_err(|error| subject.placed(error, &asked))?;
    let bytes: usize = tables.iter().map(|table| table.bytes).sum();
    writeln!(out, "plan of {}, {}", subject.name(), subject.title())?;
    write!(out, "{plan}")?;
    writeln!(out, "tables take {bytes} bytes")?;
    Ok(())
}
