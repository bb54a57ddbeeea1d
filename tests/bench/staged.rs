//! Stages on columns against one hand-written loop: the same scene, the same image, interleaved runs.
//!
//! `cargo bench --bench staged` prints the ratio of CPU times with its 95 % interval, on one and two threads, with one
//! ray a pixel and with 4 samples; then each stage's nanoseconds a row; then memory at two sizes.
//! `-- --pairs 5 --size 480x270` takes fewer and smaller runs; `-- --only samples` only those with samples.

#![allow(clippy::disallowed_methods, reason = "what is measured here may come from the platform's functions")]
#![allow(clippy::print_stdout, reason = "a benchmark's product is what it prints")]

mod fused;
mod interval;

#[path = "../scenes/sunflower.rs"]
mod sunflower;

use bevy_ecs::prelude::World;
use interval::{cpu, interval, median};
use pinhole::extract::ImageFrame;
use pinhole::plan::{Census, Table};
use pinhole::render::{Execution, render};
use pinhole::scene::{Resolution, Sampler};
use pinhole::{Chapter, Overrides, SamplingOverrides};

fn main() {
    let options = Options::read();
    for sampler in [Sampler::Sobol, Sampler::Independent, Sampler::Stratified] {
        sampled(sampler, &options);
    }
    if options.only_samples {
        return;
    }
    let pinhole = chapters::all().into_iter().find(|chapter| chapter.name == "05_pinhole").expect("a chapter");
    for chapter in [pinhole, sunflower::sunflower()] {
        for threads in [1, 2] {
            compare(&chapter, &options.world(&chapter, false), threads, "one ray a pixel", &options);
        }
        stages(&chapter, &options);
    }
    memory();
}

struct Options {
    pairs: usize,
    size: Resolution,
    only_samples: bool,
}

impl Options {
    fn read() -> Self {
        let words: Vec<String> = std::env::args().collect();
        let after = |flag: &str| words.iter().position(|word| word == flag).and_then(|at| words.get(at + 1));
        let pairs = after("--pairs").and_then(|pairs| pairs.parse().ok()).unwrap_or(15);
        let size = after("--size").and_then(|size| size.split_once('x'));
        let size = size.and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
        let (width, height) = size.unwrap_or((1920, 1080));
        let only_samples = after("--only").is_some_and(|only| only == "samples");
        Self { pairs, size: Resolution { width, height }, only_samples }
    }

    fn world(&self, chapter: &Chapter, statistics: bool) -> World {
        chapter.world(&Overrides { resolution: Some(self.size), statistics, ..Overrides::default() })
    }
}

/// Samples a pixel where several are taken.
const SAMPLES: u32 = 4;

/// The sunflower by several samples a pixel, with direct light and shadows, through the default filter; half as wide and high,
/// so that there are as many rays as without.
fn sampled(sampler: Sampler, options: &Options) {
    let size = Resolution { width: options.size.width / 2, height: options.size.height / 2 };
    let chapter = sunflower::sunflower();
    let sampling = SamplingOverrides { samples: Some(SAMPLES), sampler: Some(sampler), ..SamplingOverrides::default() };
    let world = chapter.world(&Overrides { resolution: Some(size), sampling, ..Overrides::default() });
    let word = Sampler::ALL.into_iter().find(|(_, other)| *other == sampler).expect("a sampler's name").0;
    for threads in [1, 2] {
        let ms = compare(&chapter, &world, threads, &format!("{SAMPLES} {word} samples"), options);
        let samples = f64::from(size.width) * f64::from(size.height) * f64::from(SAMPLES);
        println!("{:<12} {word}: {:.2} Msamples/s a core on {threads} threads", chapter.name, samples / ms / 1e3);
    }
}

/// Staged over fused, interleaved ABBA, after a warm-up of each and a check that the images are the same.
///
/// Gives the median of the staged runs' CPU milliseconds.
fn compare(chapter: &Chapter, world: &World, threads: usize, work: &str, options: &Options) -> f64 {
    let offer = chapter.stages();
    let execution = Execution { threads: Some(threads), ..Execution::default() };
    let size = ImageFrame::extract(&Census::of(world)).map(|image| [image.width, image.height]).expect("a size");
    let staged = || render(world, &offer, &execution, &()).expect("renders").film;
    let fused = || fused::render(world, threads);
    assert!(staged().tiles == fused().tiles, "the two images differ");

    let mut logs = Vec::new();
    let (mut staged_ms, mut fused_ms) = (Vec::new(), Vec::new());
    for pair in 0..options.pairs {
        let (a, b) = if pair % 2 == 0 {
            let a = cpu(&staged);
            (a, cpu(&fused))
        } else {
            let b = cpu(&fused);
            (cpu(&staged), b)
        };
        staged_ms.push(a.as_secs_f64() * 1e3);
        fused_ms.push(b.as_secs_f64() * 1e3);
        logs.push((a.as_secs_f64() / b.as_secs_f64()).ln());
    }
    let (low, middle, high) = interval(&logs);
    println!(
        "{:<12} {}x{} threads {threads} {work:<22} staged/fused CPU time {middle:.3} [{low:.3}, {high:.3}] of {} pairs; medians {:.0} and {:.0} ms",
        chapter.name,
        size[0],
        size[1],
        options.pairs,
        median(&mut staged_ms),
        median(&mut fused_ms),
    );
    median(&mut staged_ms)
}

/// Each stage's nanoseconds a row, the median of as many runs as there are pairs.
fn stages(chapter: &Chapter, options: &Options) {
    let world = options.world(chapter, true);
    let offer = chapter.stages();
    let execution = Execution { threads: Some(1), ..Execution::default() };
    let runs: Vec<_> = (0..options.pairs).map(|_| render(&world, &offer, &execution, &()).expect("renders")).collect();
    for (slot, stage) in runs[0].plan.stages.iter().enumerate() {
        let lap = |run: &pinhole::render::Rendered| run.laps[slot];
        let each = |run| lap(run).time.as_nanos() as f64 / lap(run).rows.max(1) as f64;
        let mut values: Vec<f64> = runs.iter().map(each).collect();
        let (rows, each) = (lap(&runs[0]).rows, median(&mut values));
        match rows {
            0 => println!("  {:<33} no rows {:>10.1} µs in all", stage.name, each / 1e3),
            _ => println!("  {:<33} {rows:>8} rows {each:>8.2} ns a row", stage.name),
        }
    }
}

/// Peak memory of a whole process at two sizes: what is left beside the film must not grow.
fn memory() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut measured = Vec::new();
    for size in ["1920x1080", "7680x4320"] {
        let file = folder.path().join("picture.png");
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_pinhole"))
            .args(["render", "10_light_and_shadow", "--size", size, "--stats", "-o"])
            .arg(&file)
            .output()
            .expect("pinhole runs");
        let stats: serde_json::Value = serde_json::from_slice(&output.stdout).expect("statistics as JSON");
        let number = |key: &str| stats[key].as_f64().unwrap_or(f64::NAN);
        let (film, peak) = (number("film_bytes"), number("peak_memory_bytes"));
        println!(
            "memory {size}: film {:.1} MiB ({} bytes a pixel), peak {:.1} MiB, beside the film {:.1} MiB",
            film / 1048576.0,
            number("film_bytes_per_pixel"),
            peak / 1048576.0,
            (peak - film) / 1048576.0
        );
        measured.push((number("width") * number("height"), peak));
    }
    let growth = (measured[1].1 - measured[0].1) / (measured[1].0 - measured[0].0);
    println!("memory: {growth:.2} bytes a further pixel");
}
