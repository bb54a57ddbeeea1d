//! Pinhole beside Mitsuba 3 on the public scenes: error against run time, in turns, on one machine.
//!
//! `cargo bench --bench peers -- --peers FOLDER --python PROGRAM` runs both; FOLDER holds `mitsuba_bench.py`, `scenes.py`
//! and references in `ref/`, PROGRAM is a Python that has numpy and mitsuba.
//! `--variant scalar_rgb`, `--scenes cornell,veach-mis`, `--samples 4,16,64`, `--rounds 5` and `--sampler sobol` ask for
//! less or other, `--light-tracing 0.0625` for so many rays from the lights a sample; without `--python` only pinhole runs and its images are held against the references.
//!
//! The references of mesh100k and mesh100k-ao are `mesh.exr` and `mesh-ao.exr` in a folder of their own, which
//! `--references` names; `mitsuba_bench.py ref --scenes mesh,mesh-ao --mesh mesh100k --refdir FOLDER` makes them.
//!
//! `cargo bench --bench peers -- --agree cylinder,cone,torus,rough_glass,principled,ply_file,obj_file --python PROGRAM`
//! compares block by block the pictures of scenes in tests/bench/peers, which stand there as scene files and again as a Python script;
//! `--runs 16` and `--samples 256` say how many renders of how many samples, `--variant llvm_ad_rgb` by what Mitsuba.
//! It fails where they are apart. Media are `fog_bodies,fog_room,fog_glass,fog_cloud`, by Mitsuba's `volpath`
//! or with `--their-integrator volpathmis` by that, which is the better oracle of the first; `dispersion` takes 1024 samples.
//! With `--rounds 8` both render so often in turns, and the ratio of their efficiencies is printed, by processor seconds;
//! `--sampler sobol` and `--their-sampler multijitter` are other samplers for it.
//! `caustic` and `pool` are by path tracing, or with `--light-tracing 1` or `--photon-mapping 1`, and Mitsuba's `path`, or
//! with `--their-integrator ptracer` the first; `--their-samples 4096` gives Mitsuba so many.
//!
//! `--agree smallvcm_sun,smallvcm_area,smallvcm_point,smallvcm_sky --smallvcm FOLDER --method vcm` compares with SmallVCM,
//! of whose repository FOLDER holds a copy, instead of with Mitsuba; its methods are `pt`, `lt`, `ppm`, `bpm`, `bpt` and
//! `vcm`, and `--bidirectional 1` asks for pinhole's from both ends. It needs g++.
//!
//! `--stages` prints the nanoseconds a row of each stage of those scenes, on one thread, the median of as many renders as
//! there are rounds; `--samples` says of how many samples.
//!
//! relMSE is the mean of (x − r)² / (r² + 0.01); the reference's own is subtracted from both sides.

#![allow(clippy::disallowed_methods, reason = "what is measured here may come from the platform's functions")]
#![allow(clippy::print_stdout, reason = "a benchmark's product is what it prints")]

#[path = "peers/agree.rs"]
mod agree;
#[allow(dead_code, reason = "a benchmark takes what it needs")]
mod interval;
#[path = "../scenes/mod.rs"]
mod scenes;

use agree::{Agreement, Peer};
use bevy_ecs::prelude::World;
use interval::{interval, median};
use pinhole::plan::Census;
use pinhole::render::{Execution, RenderInProgress, Rendered, render};
use pinhole::scene::{Filter, LightStrategy, LightTracing, Sampler, Sampling, Statistics};
use pinhole_lab::measure::image_error::{Numbers, image_error};
use pinhole_lab::measure::image_file::read_numbers;
use pinhole_lab::report::distribution::student_cdf;
use pinhole_lab::report::run::numbers;
use scenes::public::{MESHES, PUBLIC, public};
use scenes::{named, offer};
use std::path::PathBuf;
use std::process::Command;
use std::str::FromStr;
use std::time::Instant;

/// The relMSE of each reference, as shared/peers/README.md states it.
fn of_reference(scene: &str) -> f64 {
    match scene {
        "veach-mis" => 2.9e-4,
        "cornell-glass" => 4.9e-4,
        "mesh-ao" | "mesh100k-ao" => 1.3e-4,
        _ => 4.5e-5,
    }
}

struct Options {
    peers: PathBuf,
    references: PathBuf,
    python: Option<String>,
    variants: Vec<String>,
    scenes: Vec<String>,
    samples: Vec<u32>,
    rounds: u64,
    sampler: Sampler,
    converge: u32,
    light_tracing: Option<f64>,
}

/// What follows a flag on the command line.
fn after(flag: &str) -> Option<String> {
    let mut words = std::env::args().skip_while(|word| word != flag);
    words.nth(1)
}

/// The same as a list, parted by commas.
fn list(flag: &str, default: &str) -> Vec<String> {
    after(flag).unwrap_or(default.into()).split(',').map(String::from).collect()
}

/// The same as a number.
fn count<N: FromStr>(flag: &str, default: N) -> N {
    after(flag).and_then(|word| word.parse().ok()).unwrap_or(default)
}

/// The sampler of a name.
fn sampler(name: &str) -> Sampler {
    Sampler::ALL.iter().find(|(word, _)| *word == name).map(|(_, own)| *own).expect("a sampler")
}

impl Options {
    fn read() -> Option<Self> {
        let peers = PathBuf::from(after("--peers")?);
        Some(Self {
            references: after("--references").map_or_else(|| peers.join("ref"), PathBuf::from),
            peers,
            python: after("--python"),
            variants: list("--variant", "scalar_rgb,llvm_ad_rgb"),
            scenes: list("--scenes", &[&PUBLIC[..], &MESHES[..2]].concat().join(",")),
            samples: list("--samples", "4,16,64").iter().filter_map(|word| word.parse().ok()).collect(),
            rounds: count("--rounds", 5),
            sampler: after("--sampler").map_or(Sampler::Independent, |word| sampler(&word)),
            converge: count("--converge", 64),
            light_tracing: after("--light-tracing").map(|word| word.parse().expect("a number")),
        })
    }
}

/// A scene with so many samples a pixel.
fn scene_world(scene: &str, options: &Options, samples: u32, seed: u64, sampler: Sampler) -> World {
    let mut world = public(scene, LightStrategy::Mis);
    let camera = named(&mut world, "camera");
    // The references have each sample in its own pixel only.
    let filter = Filter::Box { radius: 0.5 };
    world.entity_mut(camera).insert(Sampling { samples, seed, sampler, filter });
    if let Some(paths) = options.light_tracing {
        world.entity_mut(camera).insert(LightTracing { paths });
    }
    world
}

/// One render: seconds, and the image.
fn render_pinhole(scene: &str, options: &Options, samples: u32, seed: u64, sampler: Sampler) -> (f64, Numbers) {
    let world = scene_world(scene, options, samples, seed, sampler);
    let started = Instant::now();
    let mut render = RenderInProgress::begin(&Census::of(&world), &offer(), &Execution::default()).expect("begins");
    render.advance(render.steps(), &()).expect("renders");
    let seconds = started.elapsed().as_secs_f64();
    (seconds, numbers(&render.finish().film))
}

/// Each stage's share of a scene's time and its nanoseconds a row.
fn stages(scene: &str, options: &Options) {
    let mut world = scene_world(scene, options, options.samples[0], 1, options.sampler);
    let camera = named(&mut world, "camera");
    world.entity_mut(camera).insert(Statistics);
    let execution = Execution { threads: Some(1), ..Execution::default() };
    let run = |_| render(&world, &offer(), &execution, &()).expect("renders");
    let runs: Vec<Rendered> = (0..options.rounds).map(run).collect();
    let laps = |slot: usize| {
        let mut times: Vec<f64> = runs.iter().map(|run| run.laps[slot].time.as_secs_f64()).collect();
        (median(&mut times), runs[0].laps[slot].rows)
    };
    let slots = 0..runs[0].plan.stages.len();
    let whole: f64 = slots.clone().map(|slot| laps(slot).0).sum();
    println!("{scene}: {whole:.3} s on one thread");
    for slot in slots {
        let (seconds, rows) = laps(slot);
        let of_row = seconds * 1e9 / rows.max(1) as f64;
        let name = runs[0].plan.stages[slot].name;
        println!("  {name:<40} {:>5.1} % {rows:>10} rows {of_row:>8.2} ns a row", 100.0 * seconds / whole);
    }
}

/// What the peers call a scene, and the mesh that they take for it.
fn of_peers(scene: &str) -> (String, &'static str) {
    match scene.strip_prefix("mesh100k") {
        Some(rest) => (format!("mesh{rest}"), "mesh100k"),
        None => (scene.into(), "mesh1m"),
    }
}

/// Seconds and relMSE of Mitsuba's renders, one for each sample count.
fn theirs(options: &Options, python: &str, variant: &str, scene: &str) -> Vec<(f64, f64)> {
    let counts: Vec<String> = options.samples.iter().map(u32::to_string).collect();
    let (scene, mesh) = of_peers(scene);
    let output = Command::new(python)
        .arg(options.peers.join("mitsuba_bench.py"))
        .args([
            "run",
            "--variant",
            variant,
            "--scenes",
            &scene,
            "--mesh",
            mesh,
            "--reps",
            "1",
            "--spp",
            &counts.join(","),
        ])
        .env("PEERS_REF", &options.references)
        .output()
        .expect("Python starts");
    let text = String::from_utf8_lossy(&output.stdout);
    let value = |line: &str, word: &str| -> Option<f64> {
        line.split_whitespace().find_map(|part| part.strip_prefix(word)?.strip_prefix('=')?.parse().ok())
    };
    let rows: Vec<(f64, f64)> =
        text.lines().filter_map(|line| Some((value(line, "time")?, value(line, "relmse")?))).collect();
    assert_eq!(rows.len(), counts.len(), "Mitsuba said: {text}{}", String::from_utf8_lossy(&output.stderr));
    rows
}

fn main() {
    if after("--agree").is_some() {
        let peer = match after("--smallvcm") {
            Some(copy) => Peer::smallvcm(&copy, after("--method").unwrap_or("vcm".into())),
            None => Peer::Mitsuba {
                python: after("--python").expect("--python names a Python that has mitsuba"),
                variant: after("--variant").unwrap_or("llvm_ad_rgb".into()),
                sampler: after("--their-sampler").unwrap_or("independent".into()),
                integrator: after("--their-integrator"),
            },
        };
        let agreement = Agreement {
            scenes: list("--agree", ""),
            peer,
            runs: count("--runs", 16),
            rounds: count("--rounds", 1),
            samples: count("--samples", 256),
            their_samples: count("--their-samples", count("--samples", 256)),
            sampler: after("--sampler").map(|word| sampler(&word)),
            light_tracing: after("--light-tracing").map(|word| word.parse().expect("a number")),
            photon_mapping: after("--photon-mapping").map(|word| word.parse().expect("a number")),
            bidirectional: after("--bidirectional").map(|word| word.parse().expect("a number")),
        };
        assert!(agreement.run(), "the two programs are apart");
        return;
    }
    let Some(options) = Options::read() else {
        println!("peers: nothing is run without --peers FOLDER (see the head of tests/bench/peers.rs)");
        return;
    };
    for scene in &options.scenes {
        if std::env::args().any(|word| word == "--stages") {
            stages(scene, &options);
            continue;
        }
        let file = options.references.join(format!("{}.exr", of_peers(scene).0));
        let reference = read_numbers(&file).expect("a reference");
        converged(scene, &reference, &options);
        compare(scene, &reference, &options);
    }
}

/// Blocks of the mean of many renders against the reference, each by how far noise may have moved both.
fn converged(scene: &str, reference: &Numbers, options: &Options) {
    const RUNS: u64 = 8;
    const SIDE: u32 = 16;
    let images: Vec<Numbers> = (0..RUNS)
        .map(|seed| render_pinhole(scene, options, options.converge, 900 + seed, Sampler::Independent).1)
        .collect();
    let [width, height] = reference.size;
    let (mut tests, mut apart, mut worst) = (0, 0, 0.0_f64);
    let limit = {
        let count = f64::from(width.div_ceil(SIDE) * height.div_ceil(SIDE) * 3);
        1.0 - 0.99_f64.powf(1.0 / count)
    };
    let mut squares = 0.0;
    for (y, x) in
        (0..height).step_by(SIDE as usize).flat_map(|y| (0..width).step_by(SIDE as usize).map(move |x| (y, x)))
    {
        for part in 0..3 {
            let pixels: Vec<usize> = (y..(y + SIDE).min(height))
                .flat_map(|y| (x..(x + SIDE).min(width)).map(move |x| (y * width + x) as usize))
                .collect();
            let of =
                |image: &Numbers| pixels.iter().map(|&at| image.pixels[at][part]).sum::<f64>() / pixels.len() as f64;
            let means: Vec<f64> = images.iter().map(of).collect();
            let mean = means.iter().sum::<f64>() / RUNS as f64;
            let own =
                means.iter().map(|own| (own - mean) * (own - mean)).sum::<f64>() / (RUNS - 1) as f64 / RUNS as f64;
            let spread = pixels.iter().map(|&at| reference.pixels[at][part].powi(2) + 0.01).sum::<f64>();
            let of_reference = of_reference(scene) * spread / (pixels.len() as f64).powi(2);
            let z = (mean - of(reference)) / (own + of_reference).sqrt();
            squares += z * z;
            tests += 1;
            worst = worst.max(z.abs());
            // The renders' own spread is known from as many as there are, so far from 0 the noise is not a normal variable.
            apart += usize::from(2.0 * student_cdf(-z.abs(), (RUNS - 1) as f64) < limit);
        }
    }
    println!(
        "{scene}: mean of {RUNS} renders with {} samples against the reference: {apart} of {tests} blocks apart, worst {worst:.1} SE, root mean square {:.2} SE",
        options.converge,
        (squares / f64::from(tests)).sqrt()
    );
}

/// Efficiency, 1 / (relMSE · seconds), pinhole's over theirs.
fn compare(scene: &str, reference: &Numbers, options: &Options) {
    let own_error = |image: &Numbers| image_error(reference, image).expect("one size").means.expect("means").rel_mse;
    let less = of_reference(scene);
    let run = |samples, seed| {
        let (seconds, image) = render_pinhole(scene, options, samples, seed, options.sampler);
        (seconds, own_error(&image) - less)
    };
    let Some(python) = &options.python else {
        for &samples in &options.samples {
            let (seconds, error) = run(samples, 1);
            println!(
                "{scene} {samples} samples: {seconds:.3} s, relMSE {error:.5}, efficiency {:.1}",
                1.0 / (error * seconds)
            );
        }
        return;
    };
    for variant in &options.variants {
        let mut logs: Vec<Vec<f64>> = vec![Vec::new(); options.samples.len()];
        let mut last = Vec::new();
        for round in 0..options.rounds {
            let own: Vec<(f64, f64)> = options.samples.iter().map(|&samples| run(samples, 10 + round)).collect();
            let other = theirs(options, python, variant, scene);
            last = own.iter().copied().zip(other.iter().copied()).collect();
            for (level, (own, other)) in last.iter().enumerate() {
                let efficiency = |(seconds, error): (f64, f64)| 1.0 / (seconds * error);
                logs[level].push((efficiency(*own) / efficiency((other.0, other.1 - less))).ln());
            }
        }
        for (level, &samples) in options.samples.iter().enumerate() {
            let (low, middle, high) = interval(&logs[level]);
            let ((seconds, error), (their_seconds, their_error)) = last[level];
            println!(
                "{scene} {samples} samples, {:?} against {variant}: efficiency ratio {middle:.2} [{low:.2}, {high:.2}] of {} rounds; last: {seconds:.3} s relMSE {error:.5}, theirs {their_seconds:.3} s {:.5}",
                options.sampler,
                options.rounds,
                their_error - less
            );
        }
    }
}
