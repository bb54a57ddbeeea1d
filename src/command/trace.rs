use super::error::Result;
use super::format::{Format, number_or_word, print_json};
use super::options::SceneOptions;
use super::subject::Subject;
use pinhole::look::{self, Trace};
use pinhole::plan::{Census, ComponentNumber};
use pinhole::scene::TracePixel;
use serde::Serialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::Write;

/// The path of one of a pixel's samples, stage by stage.
pub fn print_trace(
    subject: &Subject<'_>,
    pixel: TracePixel,
    sample: u32,
    prints_all: bool,
    options: &SceneOptions,
    format: Format,
    out: &mut dyn Write,
) -> Result {
    let asked = options.asked(false);
    let traced = look::trace_sample(&Census::of(&subject.world(&asked)), &subject.stages(), pixel, sample);
    let mut trace = traced.map_err(|error| subject.placed(error, &asked))?;
    if format.is_json() {
        return print_json(&Traced::of(subject.name(), &trace), out);
    }
    trace.prints_all = prints_all;
    write!(out, "{} {trace}", subject.name())?;
    Ok(())
}

#[derive(Serialize)]
struct Traced<'t> {
    scene: &'t str,
    pixel: [u32; 2],
    sample: u32,
    /// What every stage wrote, in order: of a column that several write, the last is what light goes on with.
    stages: Vec<Wrote>,
}

#[derive(Serialize)]
struct Wrote {
    stage: &'static str,
    bounce: u32,
    column: &'static str,
    space: &'static str,
    unit: &'static str,
    rows: Vec<BTreeMap<&'static str, Number>>,
}

/// What a component holds: a number with all its digits, or a word: a shape's name, or that the number is infinite.
#[derive(Serialize)]
#[serde(untagged)]
enum Number {
    Number(ComponentNumber),
    Word(Value),
}

impl Number {
    fn of(number: ComponentNumber) -> Self {
        match number {
            ComponentNumber::F64(value) if value.is_infinite() => Self::Word(number_or_word(value)),
            ComponentNumber::F32(value) if value.is_infinite() => Self::Word(number_or_word(value.into())),
            number => Self::Number(number),
        }
    }
}

impl<'t> Traced<'t> {
    fn of(scene: &'t str, trace: &'t Trace) -> Self {
        let component = |&(name, number): &(&'static str, ComponentNumber)| match name {
            "row" => None,
            "shape" => Some((name, Number::Word(json!(trace.shape_name(number))))),
            _ => Some((name, Number::of(number))),
        };
        let wrote = |recorded: &'t look::Recorded| Wrote {
            stage: recorded.stage,
            bounce: recorded.depth,
            column: recorded.column.name,
            space: recorded.column.space,
            unit: recorded.column.unit,
            rows: recorded.rows.iter().map(|components| components.iter().filter_map(component).collect()).collect(),
        };
        let stages = trace.stages.iter().map(wrote).collect();
        Self { scene, pixel: [trace.pixel.x, trace.pixel.y], sample: trace.sample, stages }
    }
}
