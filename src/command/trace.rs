use super::arguments::SceneOptions;
use crate::Result;
use crate::chapter::Chapter;
use crate::look;
use crate::scene::TracePixel;
use std::io::Write;

/// A pixel's way to light.
pub fn print_trace(chapter: &Chapter, pixel: TracePixel, options: &SceneOptions, out: &mut dyn Write) -> Result {
    let trace = look::trace(&chapter.world(&options.asked(false)), &chapter.stages(), pixel)?;
    write!(out, "{} {trace}", chapter.name)?;
    Ok(())
}
