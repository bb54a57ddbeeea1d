use super::arguments::CostOfChapter;
use super::error::Result;
use super::find;
use super::format::{Format, print_json, shown};
use super::interrupt::Waiting;
use pinhole::extract::SamplingTable;
use pinhole::film::write_whole;
use pinhole::plan::{Census, Table};
use pinhole::render::Execution;
use pinhole::scene::{Resolution, printable_path};
use pinhole::{Chapter, Overrides};
use pinhole_lab::measure::cost::{Cost, PROBES, RENDERS, StageCost, made_from, measure};
use pinhole_lab::report::provenance::{compiler, load, processor};
use serde_json::{Value, json};
use std::fmt;
use std::io::Write;
use std::path::Path;

/// The image that every chapter is measured with, as many times smaller as it takes several samples a pixel.
const SIZE: Resolution = Resolution { width: 960, height: 540 };

/// What a chapter's stages cost, or those of all chapters; kept beside the chapter if asked for.
pub fn print_cost(chapters: &[Chapter], asked: &CostOfChapter, format: Format, out: &mut dyn Write) -> Result {
    if asked.chapter != "all" {
        let (measured, written) = measure_one(find::chapter(chapters, &asked.chapter)?, asked, format, out)?;
        return if format.is_json() { print_json(&measured.as_json(&written), out) } else { Ok(()) };
    }
    let mut all = Vec::new();
    for chapter in chapters {
        let (measured, written) = measure_one(chapter, asked, format, out)?;
        all.push(measured.as_json(&written));
    }
    if format.is_json() { print_json(&all, out) } else { Ok(()) }
}

/// Measures a chapter and keeps the report where that is asked for; as text, prints it too.
fn measure_one(
    chapter: &Chapter,
    asked: &CostOfChapter,
    format: Format,
    out: &mut dyn Write,
) -> Result<(Measured, Vec<String>)> {
    let measured = Measured::of(chapter)?;
    let report = measured.to_string();
    if !format.is_json() {
        out.write_all(report.as_bytes())?;
    }
    if !asked.write {
        return Ok((measured, Vec::new()));
    }
    let short = Path::new("chapters").join(chapter.name).join("costs.txt");
    let file = pinhole_lab::repository().join(&short);
    write_whole(&file, |file| file.write_all(report.as_bytes()))?;
    if !format.is_json() {
        writeln!(out, "wrote {}", printable_path(&short))?;
    }
    Ok((measured, vec![shown(&short)]))
}

/// What a chapter's stages cost, and where that was measured.
struct Measured {
    chapter: &'static str,
    size: Resolution,
    samples: u32,
    cost: Cost,
    processor: String,
    threads: usize,
    compiler: String,
    load: Option<f64>,
    made_from: String,
}

impl Measured {
    fn of(chapter: &Chapter) -> Result<Self> {
        let made_from = made_from(chapter.name)?;
        let samples = SamplingTable::extract(&Census::of(&chapter.world(&Overrides::default())))?.samples;
        let smaller = samples.isqrt().max(1);
        let size = Resolution { width: SIZE.width / smaller, height: SIZE.height / smaller };
        let asked = Overrides { resolution: Some(size), statistics: true, ..Overrides::default() };
        let side = Execution::default().tile_side;
        let tiles = u64::from(size.width.div_ceil(side) * size.height.div_ceil(side) * samples.max(1));
        let waiting = Waiting::new(tiles * RENDERS as u64, false);
        let cost = measure(&chapter.world(&asked), &chapter.stages(), &waiting);
        waiting.done();
        Ok(Self {
            chapter: chapter.name,
            size,
            samples,
            cost: cost?,
            processor: processor(),
            threads: std::thread::available_parallelism().map_or(1, usize::from),
            compiler: compiler(),
            load: load(),
            made_from,
        })
    }

    fn as_json(&self, written: &[String]) -> Value {
        let stage = |cost: &StageCost| {
            let times = cost.nanoseconds.map(|[low, median, high]| json!({ "p10": low, "p50": median, "p90": high }));
            let error = Some(&cost.error).filter(|error| *error != "-");
            json!({ "stage": cost.stage, "rows": cost.rows, "nanoseconds_per_row": times, "error": error })
        };
        json!({
            "scene": self.chapter, "width": self.size.width, "height": self.size.height,
            "samples_per_pixel": self.samples, "threads": 1, "renders": RENDERS - 1,
            "pixels_probed_for_errors": PROBES[0] * PROBES[1],
            "stages": self.cost.stages.iter().map(stage).collect::<Vec<Value>>(),
            "machine": {
                "processor": self.processor, "threads": self.threads, "compiler": self.compiler, "load": self.load,
            },
            "built_for_release": !cfg!(debug_assertions), "made_from": self.made_from, "files": written,
        })
    }
}

impl fmt::Display for Measured {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "cost of {}: {} x {} pixels of {} samples on one thread, {} renders after one to warm up\n\
             errors: the worst of {} pixels, against exact arithmetic; u = 2^-24\n{}",
            self.chapter,
            self.size.width,
            self.size.height,
            self.samples,
            RENDERS - 1,
            PROBES[0] * PROBES[1],
            self.cost
        )?;
        let load = self.load.map_or_else(|| "unknown".into(), |load| format!("{load:.2}"));
        writeln!(f, "machine: {}, {} threads; {}; load {load}", self.processor, self.threads, self.compiler)?;
        if cfg!(debug_assertions) {
            writeln!(f, "built without --release: these times say nothing about the kit")?;
        }
        writeln!(f, "made from {}", self.made_from)
    }
}
