use super::arguments::CostOfChapter;
use super::called::called;
use super::error::Result;
use super::find;
use super::format::{Format, print_json, shown};
use super::interrupt::Waiting;
use bevy_ecs::prelude::World;
use pinhole::extract::SamplingTable;
use pinhole::film::write_whole;
use pinhole::plan::{Census, Table};
use pinhole::render::Execution;
use pinhole::scene::{Resolution, printable_path};
use pinhole::{Chapter, Overrides};
use pinhole_lab::measure::cost::{Cost, FILM, PROBES, RENDERS, StageCost, measure, place, stage_names};
use pinhole_lab::measure::film_bits::film_digest;
use pinhole_lab::report::provenance::Provenance;
use pinhole_lab::review::SNAPSHOT_SIZE;
use serde_json::{Value, json};
use std::fmt;
use std::io::Write;
use std::path::PathBuf;

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
    let short = keep(chapter, &report)?;
    if !format.is_json() {
        writeln!(out, "wrote {}", printable_path(&short))?;
    }
    Ok((measured, vec![shown(&short)]))
}

/// Measures a chapter's costs and keeps them.
pub(super) fn measure_and_keep(chapter: &Chapter) -> Result<PathBuf> {
    keep(chapter, &Measured::of(chapter)?.to_string())
}

fn keep(chapter: &Chapter, costs: &str) -> Result<PathBuf> {
    let short = place(chapter.name);
    write_whole(&pinhole_lab::repository().join(&short), |file| file.write_all(costs.as_bytes()))?;
    Ok(short)
}

/// What is measured: the chapter's scene with timers, in a size at which its samples take as long as those of others.
struct Measurable {
    scene: World,
    size: Resolution,
    samples: u32,
}

impl Measurable {
    fn of(chapter: &Chapter) -> Result<Self> {
        let samples = SamplingTable::extract(&Census::of(&chapter.world(&Overrides::default())))?.samples;
        let smaller = samples.isqrt().max(1);
        let size = Resolution { width: SIZE.width / smaller, height: SIZE.height / smaller };
        let asked = Overrides { resolution: Some(size), statistics: true, ..Overrides::default() };
        Ok(Self { scene: chapter.world(&asked), size, samples })
    }
}

/// The stages that a chapter's costs are of, in order.
///
/// Errors: the scene has no plan.
pub(super) fn stages_of(chapter: &Chapter) -> Result<Vec<&'static str>> {
    Ok(stage_names(&Measurable::of(chapter)?.scene, &chapter.stages())?)
}

/// The digest of the chapter's film in the size of its snapshots: with another, its stages may have other errors.
///
/// Errors: what a render would be refused for.
pub(super) fn film_of(chapter: &Chapter) -> Result<String> {
    let asked = Overrides { resolution: Some(SNAPSHOT_SIZE), ..Overrides::default() };
    Ok(film_digest(&chapter.world(&asked), &chapter.stages())?)
}

/// What a chapter's stages cost, and where that was measured.
struct Measured {
    chapter: &'static str,
    size: Resolution,
    samples: u32,
    cost: Cost,
    film: String,
    provenance: Provenance,
}

impl Measured {
    fn of(chapter: &Chapter) -> Result<Self> {
        let Measurable { scene, size, samples } = Measurable::of(chapter)?;
        let side = Execution::default().tile_side;
        let tiles = u64::from(size.width.div_ceil(side) * size.height.div_ceil(side) * samples.max(1));
        let waiting = Waiting::new(tiles * RENDERS as u64, false);
        let cost = measure(&scene, &chapter.stages(), &waiting);
        waiting.done();
        Ok(Self {
            chapter: chapter.name,
            size,
            samples,
            cost: cost?,
            film: film_of(chapter)?,
            provenance: Provenance::now(called(&format!("cost {}", chapter.name))),
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
            "provenance": self.provenance, "film": self.film, "files": written,
        })
    }
}

impl fmt::Display for Measured {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "cost of {}: {} x {} pixels of {} samples on one thread, {} renders after one to warm up\n\
             errors: the worst of {} pixels, against exact arithmetic; u = 2^-24{FILM}{}\n{}",
            self.chapter,
            self.size.width,
            self.size.height,
            self.samples,
            RENDERS - 1,
            PROBES[0] * PROBES[1],
            self.film,
            self.cost
        )?;
        let Provenance { processor, cores, rustc, .. } = &self.provenance;
        writeln!(f, "machine: {processor}, {cores} threads; {rustc}")?;
        if cfg!(debug_assertions) {
            writeln!(f, "built without --release: these times say nothing about pinhole")?;
        }
        writeln!(f, "{}", self.provenance.measured())
    }
}
