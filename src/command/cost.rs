use super::arguments::CostOfChapter;
use super::find;
use super::interrupt::Waiting;
use crate::Result;
use crate::chapter::{Asked, Chapter};
use crate::extract::SamplingTable;
use crate::film::write_whole;
use crate::measure::cost::{PROBES, RENDERS, made_from, measure};
use crate::plan::Table;
use crate::render::Execution;
use crate::report::provenance::{compiler, load, processor};
use crate::scene::Resolution;
use std::fmt::Write as _;
use std::io::Write;
use std::path::Path;

/// The image that every chapter is measured with, as many times smaller as it takes several samples a pixel.
const SIZE: Resolution = Resolution { width: 960, height: 540 };

/// What a chapter's stages cost, or those of all chapters; kept beside the chapter if asked for.
pub fn print_cost(chapters: &[Chapter], asked: &CostOfChapter, out: &mut dyn Write) -> Result {
    let chosen = match asked.chapter.as_str() {
        "all" => chapters.iter().collect(),
        one => vec![find::chapter(chapters, one)?],
    };
    for chapter in chosen {
        let report = report(chapter)?;
        out.write_all(report.as_bytes())?;
        if asked.write {
            let short = Path::new("chapters").join(chapter.name).join("costs.txt");
            let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(&short);
            write_whole(&file, |file| file.write_all(report.as_bytes()))?;
            writeln!(out, "wrote {}", short.display())?;
        }
    }
    Ok(())
}

fn report(chapter: &Chapter) -> Result<String> {
    let made_from = made_from(chapter.name)?;
    let samples = SamplingTable::extract(&chapter.world(&Asked::default()))?.samples;
    let smaller = samples.isqrt().max(1);
    let size = Resolution { width: SIZE.width / smaller, height: SIZE.height / smaller };
    let asked = Asked { resolution: Some(size), statistics: true, ..Asked::default() };
    let side = Execution::default().tile_side;
    let tiles = u64::from(size.width.div_ceil(side) * size.height.div_ceil(side) * samples.max(1));
    let waiting = Waiting::new(tiles * RENDERS as u64, false);
    let cost = measure(&chapter.world(&asked), &chapter.stages(), &waiting);
    waiting.done();
    let mut report = format!(
        "cost of {}: {} x {} pixels of {samples} samples on one thread, {} renders after one to warm up\n\
         errors: the worst of {} pixels, against exact arithmetic; u = 2^-24\n{}",
        chapter.name,
        size.width,
        size.height,
        RENDERS - 1,
        PROBES[0] * PROBES[1],
        cost?
    );
    let _ = writeln!(report, "machine: {}", machine());
    if cfg!(debug_assertions) {
        let _ = writeln!(report, "built without --release: these times say nothing about the kit");
    }
    let _ = writeln!(report, "made from {made_from}");
    Ok(report)
}

/// The machine as far as it says: processor, threads, compiler, load.
fn machine() -> String {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let load = load().map_or_else(|| "unknown".into(), |load| format!("{load:.2}"));
    format!("{}, {threads} threads; {}; load {load}", processor(), compiler())
}
