use super::format::{Format, print_json};
use super::options::SceneOptions;
use super::subject::Subject;
use crate::Result;
use crate::look::{self, Trace};
use crate::plan::LaneNumber;
use crate::scene::TracePixel;
use serde::Serialize;
use std::collections::BTreeMap;
use std::io::Write;

/// The way of one of a pixel's samples to light.
pub fn print_trace(
    subject: &Subject<'_>,
    pixel: TracePixel,
    sample: u32,
    options: &SceneOptions,
    format: Format,
    out: &mut dyn Write,
) -> Result {
    let asked = options.asked(false);
    let traced = look::trace_sample(&subject.world(&asked), &subject.stages(), pixel, sample);
    let trace = traced.map_err(|error| subject.placed(error, &asked))?;
    if format.is_json() {
        return print_json(&Traced::of(subject.name(), &trace), out);
    }
    write!(out, "{} {trace}", subject.name())?;
    Ok(())
}

#[derive(Serialize)]
struct Traced<'t> {
    scene: &'t str,
    pixel: [u32; 2],
    sample: u32,
    /// What every stage wrote, in order: of a column that several write, the last is what light goes on with.
    stages: Vec<Wrote<'t>>,
}

#[derive(Serialize)]
struct Wrote<'t> {
    stage: &'static str,
    bounce: u32,
    column: &'static str,
    space: &'static str,
    unit: &'static str,
    rows: Vec<BTreeMap<&'static str, Number<'t>>>,
}

/// What a lane holds: a number, or a shape by its name.
#[derive(Serialize)]
#[serde(untagged)]
enum Number<'t> {
    Number(LaneNumber),
    Shape(Option<&'t str>),
}

impl<'t> Traced<'t> {
    fn of(scene: &'t str, trace: &'t Trace) -> Self {
        let lane = |&(name, number): &(&'static str, LaneNumber)| match name {
            "path" => None,
            "shape" => Some((name, Number::Shape(trace.shape_name(number)))),
            _ => Some((name, Number::Number(number))),
        };
        let wrote = |recorded: &'t look::Recorded| Wrote {
            stage: recorded.stage,
            bounce: recorded.leg,
            column: recorded.column.name,
            space: recorded.column.space,
            unit: recorded.column.unit,
            rows: recorded.rows.iter().map(|lanes| lanes.iter().filter_map(lane).collect()).collect(),
        };
        let stages = trace.stages.iter().map(wrote).collect();
        Self { scene, pixel: [trace.pixel.x, trace.pixel.y], sample: trace.sample, stages }
    }
}
