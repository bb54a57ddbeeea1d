use super::arguments::SceneOptions;
use crate::Result;
use crate::chapter::Chapter;
use crate::render::prepare;
use std::io::Write;

/// The plan of a chapter's scene.
pub fn print_plan(chapter: &Chapter, options: &SceneOptions, out: &mut dyn Write) -> Result {
    let (plan, tables) = prepare(&chapter.world(&options.asked(false)), &chapter.stages())?;
    let bytes: usize = tables.iter().map(|table| table.bytes).sum();
    writeln!(out, "plan of {}, {}", chapter.name, chapter.title)?;
    write!(out, "{plan}")?;
    writeln!(out, "tables take {bytes} bytes")?;
    Ok(())
}
