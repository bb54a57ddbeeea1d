use super::options::SceneOptions;
use super::subject::Subject;
use crate::Result;
use crate::look;
use crate::scene::TracePixel;
use std::io::Write;

/// The way of one of a pixel's samples to light.
pub fn print_trace(
    subject: &Subject<'_>,
    pixel: TracePixel,
    sample: u32,
    prints_all: bool,
    options: &SceneOptions,
    out: &mut dyn Write,
) -> Result {
    let asked = options.asked(false);
    let traced = look::trace_sample(&subject.world(&asked), &subject.stages(), pixel, sample);
    let mut trace = traced.map_err(|error| subject.placed(error, &asked))?;
    trace.prints_all = prints_all;
    write!(out, "{} {trace}", subject.name())?;
    Ok(())
}
