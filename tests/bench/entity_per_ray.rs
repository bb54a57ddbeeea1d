//! One entity a ray against pinhole's tiles: the same scene, the same image, interleaved runs on one thread.
//!
//! `cargo bench --bench entity_per_ray` prints time as a ratio with its 95 % interval, then memory, each measured in a
//! process of its own; `-- --write` keeps the answer beside chapter 12.
//! `-- --pairs 5 --size 480x270` takes fewer and smaller runs.

#![allow(clippy::disallowed_methods, reason = "what is measured here may come from the platform's functions")]
#![allow(clippy::print_stdout, reason = "a benchmark's product is what it prints")]

mod interval;

use bevy_ecs::prelude::World;
use interval::{cpu, interval, median};
use pinhole::Overrides;
use pinhole::plan::Stage;
use pinhole::render::{Execution, Worlds, peak_memory, render};
use pinhole::scene::Resolution;
use pinhole_lab::naive::entity_per_ray::EntityPerRay;
use pinhole_lab::report::provenance::Provenance;
use std::fmt::Write as _;
use std::process::Command;

const CHAPTER: &str = "12_how_it_is_built";

/// What a process is asked to hold, so that its peak can be told.
const HELD: [(&str, &str); 4] = [
    ("nothing", "the program, the scene and an empty film"),
    ("tiles", "a tile a worker"),
    ("columns", "all tiles at once"),
    ("entities", "an entity a ray"),
];

fn main() {
    let words: Vec<String> = std::env::args().collect();
    let after = |flag: &str| words.iter().position(|word| word == flag).and_then(|at| words.get(at + 1));
    let size = after("--size").and_then(|size| size.split_once('x'));
    let size = size.and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
    let (width, height) = size.unwrap_or((1920, 1080));
    let resolution = Resolution { width, height };
    if let Some(held) = after("--hold") {
        println!("{}", hold(held, resolution));
        return;
    }
    let pairs = after("--pairs").and_then(|pairs| pairs.parse().ok()).unwrap_or(15);
    let mut report = format!("{CHAPTER} without its view: {width} x {height} pixels, one thread\n");
    time(resolution, pairs, &mut report);
    memory(resolution, &mut report);
    let provenance = Provenance::now(String::new());
    let _ = writeln!(report, "machine: {}\n{}", provenance.processor, provenance.measured());
    print!("{report}");
    if words.iter().any(|word| word == "--write") {
        let file = format!("{}/chapters/{CHAPTER}/entity_per_ray.txt", env!("CARGO_MANIFEST_DIR"));
        std::fs::write(&file, &report).expect("the report can be written");
    }
}

/// The chapter's scene as a picture of surfaces, and the stages for it.
fn scene(resolution: Resolution) -> (World, Vec<Stage>) {
    let mut chapter = chapters::all().into_iter().find(|chapter| chapter.name == CHAPTER).expect("the chapter");
    chapter.view = None;
    (chapter.world(&Overrides { resolution: Some(resolution), ..Overrides::default() }), chapter.stages())
}

/// Naive over pinhole, interleaved ABBA, after a check that the images are the same.
fn time(resolution: Resolution, pairs: usize, report: &mut String) {
    let (world, offer) = scene(resolution);
    let execution = Execution { threads: Some(1), ..Execution::default() };
    let pinhole = || render(&world, &offer, &execution, &()).expect("renders").film;
    let spawn = || EntityPerRay::spawn(&world).expect("spawns");
    let mut entities = spawn();
    entities.run();
    assert!(entities.film().tiles == pinhole().tiles, "the two images differ");
    drop(entities);

    let (mut all, mut runs) = (Vec::new(), Vec::new());
    let (mut pinhole_ms, mut spawn_ms, mut run_ms) = (Vec::new(), Vec::new(), Vec::new());
    for pair in 0..pairs {
        let mut a = (pair % 2 == 0).then(|| cpu(&pinhole).as_secs_f64() * 1e3);
        let spawned = cpu(&spawn).as_secs_f64() * 1e3;
        let held = std::cell::RefCell::new(spawn());
        let ran = cpu(&|| held.borrow_mut().run()).as_secs_f64() * 1e3;
        drop(held);
        let pinhole = *a.get_or_insert_with(|| cpu(&pinhole).as_secs_f64() * 1e3);
        all.push(((spawned + ran) / pinhole).ln());
        runs.push((ran / pinhole).ln());
        pinhole_ms.push(pinhole);
        spawn_ms.push(spawned);
        run_ms.push(ran);
    }
    let [pinhole, spawn, run] = [pinhole_ms, spawn_ms, run_ms].map(|mut values| median(&mut values));
    let _ = writeln!(report, "the two images are the same to the last bit");
    let _ = writeln!(
        report,
        "CPU time, medians of {pairs}: pinhole {pinhole:.0} ms; entities {spawn:.0} ms to spawn, {run:.0} ms to run"
    );
    for (what, logs) in [("spawn and run", all), ("run alone", runs)] {
        let (low, middle, high) = interval(&logs);
        let _ =
            writeln!(report, "entities over pinhole, {what}: {middle:.2} [{low:.2}, {high:.2}] with 95 % confidence");
    }
}

/// The peak memory of this process after it has held what it was asked to, in bytes.
fn hold(held: &str, resolution: Resolution) -> u64 {
    let (world, offer) = scene(resolution);
    let execution = |worlds| Execution { threads: Some(1), worlds, ..Execution::default() };
    let film = |worlds| render(&world, &offer, &execution(worlds), &()).expect("renders").film;
    let kept = match held {
        "tiles" => film(Worlds::PerWorker).bytes(),
        "columns" => film(Worlds::One).bytes(),
        "entities" => {
            let mut entities = EntityPerRay::spawn(&world).expect("spawns");
            entities.run();
            let peak = peak_memory();
            drop(entities);
            return peak.unwrap_or(0);
        }
        _ => pinhole::film::Film::new(resolution.width, resolution.height, 32).bytes(),
    };
    assert!(kept > 0);
    peak_memory().unwrap_or(0)
}

fn memory(resolution: Resolution, report: &mut String) {
    let program = std::env::current_exe().expect("this program has a path");
    let size = format!("{}x{}", resolution.width, resolution.height);
    let pixels = f64::from(resolution.width) * f64::from(resolution.height);
    let _ = writeln!(report, "peak memory of a process that holds:");
    for (held, words) in HELD {
        let output = Command::new(&program).args(["--hold", held, "--size", &size]).output().expect("runs again");
        let bytes: f64 = String::from_utf8_lossy(&output.stdout).trim().parse().expect("a number of bytes");
        let _ = writeln!(report, "  {words:<42} {:>4.0} MB, {:>4.0} bytes a pixel", bytes / 1e6, bytes / pixels);
    }
}
