use super::arguments::SceneOptions;
use super::subject::Subject;
use crate::Result;
use crate::look;
use crate::scene::TracePixel;
use std::io::Write;

/// A pixel's way to light.
pub fn print_trace(subject: &Subject<'_>, pixel: TracePixel, options: &SceneOptions, out: &mut dyn Write) -> Result {
    let asked = options.asked(false);
    let traced = look::trace(&subject.world(&asked), &subject.stages(), pixel);
    let trace = traced.map_err(|error| subject.placed(error, &asked))?;
    write!(out, "{} {trace}", subject.name())?;
    Ok(())
}
