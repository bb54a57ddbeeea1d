use super::arguments::SceneOptions;
use crate::Result;
use crate::chapter::Chapter;
use crate::review::plan_text;
use std::io::Write;

/// The plan of a chapter's scene.
pub fn print_plan(chapter: &Chapter, options: &SceneOptions, out: &mut dyn Write) -> Result {
    write!(out, "{}", plan_text(chapter, &chapter.world(&options.asked(false)), &chapter.stages())?)?;
    Ok(())
}
