//! Whether pinhole and another program render the same picture of a scene, by the means of blocks of its pixels.
//!
//! Each program renders the scene several times with seeds of its own, so that every block mean has a standard error on
//! both sides, and so has every pixel: what varies from render to render is the error of one of them, whatever the truth.

use super::interval::interval;
use super::{named, offer};
use cpu_time::ProcessTime;
use pinhole::plan::Census;
use pinhole::render::{Execution, RenderInProgress};
use pinhole::scene::{BidirectionalPathTracing, LightTracing, PhotonMapping, Sampler, Sampling, SceneFile};
use pinhole_lab::report::distribution::{sidak, student_cdf};
use serde::Deserialize;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

/// The side of a block, in pixels; the scenes are whole blocks wide and high.
const SIDE: usize = 16;

/// The relative error of the other program's sums in single precision, for each sample of a pixel.
const ROUNDING: f64 = 1.5e-8;

/// What is compared, and how.
pub struct Agreement {
    /// The names of scenes in tests/bench/peers.
    pub scenes: Vec<String>,
    /// The other program.
    pub peer: Peer,
    /// Renders of each program in a round.
    pub runs: u64,
    /// How often the programs take turns.
    pub rounds: u64,
    /// Samples per pixel of each render.
    pub samples: u32,
    /// The same of the other program.
    pub their_samples: u32,
    /// Another sampler than the scene file's.
    pub sampler: Option<Sampler>,
    /// Light paths per camera path, where pinhole is to trace such.
    pub light_tracing: Option<f64>,
    /// The same for photon mapping.
    pub photon_mapping: Option<f64>,
    /// The same for bidirectional path tracing.
    pub bidirectional: Option<f64>,
}

/// The program beside which pinhole renders.
pub enum Peer {
    /// Mitsuba 3.
    Mitsuba {
        /// A Python that has numpy and mitsuba.
        python: String,
        /// Its variant.
        variant: String,
        /// Its sampler.
        sampler: String,
        /// Another integrator than its scene has.
        integrator: Option<String>,
    },
    /// SmallVCM, on one thread.
    SmallVcm {
        /// smallvcm.cxx, compiled with its headers.
        program: PathBuf,
        /// The word by which it knows a method.
        method: String,
    },
}

impl Peer {
    /// Compiles smallvcm.cxx with the headers in a folder that holds a copy of SmallVCM's repository.
    pub fn smallvcm(copy: &str, method: String) -> Self {
        let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("smallvcm");
        let compiled = Command::new("g++")
            .args(["-O3", "-march=native", "-std=c++11", "-I", &format!("{copy}/src")])
            .arg(folder().join("smallvcm.cxx"))
            .arg("-o")
            .arg(&program)
            .status();
        assert!(compiled.expect("g++ starts").success(), "{copy} holds no SmallVCM that g++ can compile");
        Self::SmallVcm { program, method }
    }

    /// How it is named beside its figures.
    fn label(&self) -> String {
        match self {
            Self::Mitsuba { sampler, .. } => format!("Mitsuba, {sampler}"),
            Self::SmallVcm { method, .. } => format!("SmallVCM, {method}"),
        }
    }
}

/// Images of one size, each a list of red, green and blue line by line, and the processor seconds that each took.
#[derive(Default, Deserialize)]
struct Renders {
    images: Vec<Vec<f64>>,
    seconds: Vec<f64>,
}

impl Agreement {
    /// Compares all scenes; true if none is apart.
    pub fn run(&self) -> bool {
        let agrees: Vec<bool> = self.scenes.iter().map(|scene| self.compare(scene)).collect();
        agrees.into_iter().all(|agrees| agrees)
    }

    /// Compares one scene and prints what was found.
    fn compare(&self, scene: &str) -> bool {
        let mut seconds = [0.0; 2];
        let mut whole = [Renders::default(), Renders::default()];
        let mut width = 0;
        let mut efficiencies = Vec::new();
        for round in 0..self.rounds {
            let started = Instant::now();
            let own;
            (own, width) = self.pinhole(scene, round);
            let half = Instant::now();
            let theirs = self.theirs(scene, (width, round));
            seconds[0] += (half - started).as_secs_f64();
            seconds[1] += half.elapsed().as_secs_f64();
            let truth = mean_image([&own, &theirs]);
            let costs =
                [&own, &theirs].map(|side| rel_mse(side, &truth) * mean_and_error(side.seconds.iter().copied()).0);
            efficiencies.push((costs, (costs[1] / costs[0]).ln()));
            for (side, more) in whole.iter_mut().zip([own, theirs]) {
                side.images.extend(more.images);
                side.seconds.extend(more.seconds);
            }
        }
        let [own, theirs] =
            whole.map(|side| side.images.iter().map(|image| block_means(image, width)).collect::<Vec<_>>());
        let across = width / SIDE;
        let tests = own[0].len();
        assert!(own.iter().chain(&theirs).all(|means| means.len() == tests), "{scene}: images of different sizes");
        // Each side's spread is known from its own renders only, so the ratio follows Student's t rather than a normal
        // distribution.
        let freedom = 2.0 * (self.runs * self.rounds - 1) as f64;
        let limit = 1.0 - sidak(0.99, tests);
        let (mut squares, mut apart, mut worst, mut known) = (0.0, 0, (0.0_f64, 0), Vec::new());
        for test in 0..tests {
            let [(mean, error), (their_mean, their_error)] =
                [&own, &theirs].map(|renders| mean_and_error(renders.iter().map(|means| means[test])));
            // A block of nothing but sky has no noise, only rounding.
            let rounding = ROUNDING * f64::from(self.their_samples) * their_mean;
            let both = error.hypot(their_error).hypot(rounding);
            // Where no light is at all, nothing is known better than that.
            let z = if mean == their_mean { 0.0 } else { (mean - their_mean) / both };
            squares += z * z;
            apart += usize::from(2.0 * student_cdf(-z.abs(), freedom) < limit);
            known.push(if both > 0.0 { both / their_mean } else { 0.0 });
            if z.abs() > worst.0.abs() {
                worst = (z, test);
            }
        }
        known.sort_by(f64::total_cmp);
        let whole = |means: &Vec<f64>| means.iter().sum::<f64>() / tests as f64;
        let [(mean, error), (their_mean, their_error)] =
            [&own, &theirs].map(|renders| mean_and_error(renders.iter().map(whole)));
        let ratio_error = (error / mean).hypot(their_error / their_mean);
        let block = worst.1 / 3;
        println!(
            "{scene}: {} blocks of {SIDE} × {SIDE} pixels in 3 channels, {} renders of {} and {} samples; \
             (pinhole − {}) / SE: rms {:.2} (expected {:.2}), worst {:+.1} in block ({}, {}), {apart} of {tests} \
             apart at 1 % (Šidák); SE of a block {:.3} % (median), {:.3} % (worst); ratio of the means {:.5} ± {:.5}; \
             {:.0} s and {:.0} s",
            tests / 3,
            self.runs * self.rounds,
            self.samples,
            self.their_samples,
            self.peer.label(),
            (squares / tests as f64).sqrt(),
            (freedom / (freedom - 2.0)).sqrt(),
            worst.0,
            block % across,
            block / across,
            100.0 * known[tests / 2],
            100.0 * known[tests - 1],
            mean / their_mean,
            ratio_error,
            seconds[0],
            seconds[1],
        );
        if self.rounds > 1 {
            let [own, theirs] = [0, 1].map(|side| efficiencies.iter().map(|(costs, _)| costs[side]).sum::<f64>());
            let logs: Vec<f64> = efficiencies.iter().map(|(_, log)| *log).collect();
            let (low, middle, high) = interval(&logs);
            println!(
                "{scene}: relMSE · processor seconds {:.5} (pinhole), {:.5} ({}); efficiency ratio {middle:.2} \
                 [{low:.2}, {high:.2}] of {} rounds",
                own / self.rounds as f64,
                theirs / self.rounds as f64,
                self.peer.label(),
                self.rounds
            );
        }
        apart == 0
    }

    /// Pinhole's renders of a round, and how many pixels they are wide.
    fn pinhole(&self, scene: &str, round: u64) -> (Renders, usize) {
        let file = folder().join(format!("{scene}.ron"));
        let mut width = 0;
        let mut renders = Renders::default();
        for run in 0..self.runs {
            let mut world = SceneFile::open(&file).unwrap_or_else(|problem| panic!("{problem}")).world();
            let camera = named(&mut world, "camera");
            if let Some(mut sampling) = world.get_mut::<Sampling>(camera) {
                let sampler = self.sampler.unwrap_or(sampling.sampler);
                let seed = 500 + round * self.runs + run;
                *sampling = Sampling { samples: self.samples, seed, sampler, ..*sampling };
            }
            if let Some(paths) = self.light_tracing {
                world.entity_mut(camera).insert(LightTracing { paths });
            }
            if let Some(paths) = self.photon_mapping {
                world.entity_mut(camera).insert(PhotonMapping { paths, ..PhotonMapping::default() });
            }
            if let Some(paths) = self.bidirectional {
                world.entity_mut(camera).insert(BidirectionalPathTracing { paths });
            }
            let started = ProcessTime::now();
            let mut render =
                RenderInProgress::begin(&Census::of(&world), &offer(), &Execution::default()).expect("begins");
            render.advance(render.steps(), &()).expect("renders");
            let film = render.finish().film;
            renders.seconds.push(started.elapsed().as_secs_f64());
            width = film.width as usize;
            // Not what is shown of a pixel, which is nothing below 0: paths of one wavelength have negative parts.
            let mean = |x, y| {
                let (tile, row) = film.place(x, y);
                let splat = film.splats.is_some();
                if splat { film.mean(x, y).map(f64::from) } else { film.tiles[tile].shown_f64(row) }
            };
            let pixels = (0..film.height).flat_map(|y| (0..film.width).map(move |x| (x, y)));
            renders.images.push(pixels.flat_map(|(x, y)| mean(x, y)).collect());
        }
        (renders, width)
    }

    /// The other program's renders of a round, so many pixels wide.
    fn theirs(&self, scene: &str, (width, round): (usize, u64)) -> Renders {
        let [samples, runs] = [self.their_samples.to_string(), self.runs.to_string()];
        let seed = (7001 + round * self.runs).to_string();
        let mut command = match &self.peer {
            Peer::Mitsuba { python, variant, sampler, integrator } => {
                let mut command = Command::new(python);
                command.arg(folder().join("mitsuba_scenes.py")).arg(scene);
                command.args(["--variant", variant, "--sampler", sampler]);
                command.args(["--samples", &samples, "--runs", &runs, "--seed", &seed]);
                command.args(integrator.iter().flat_map(|named| ["--integrator", named]));
                command
            }
            Peer::SmallVcm { program, method } => {
                let kinds = ["sun", "area", "point", "sky"].map(|kind| format!("smallvcm_{kind}"));
                let number = kinds.iter().position(|kind| kind == scene);
                let number = number.unwrap_or_else(|| panic!("SmallVCM has no scene {scene}: it has {kinds:?}"));
                let mut command = Command::new(program);
                command.args([&number.to_string(), method, &width.to_string(), &samples, &runs, &seed]);
                command
            }
        };
        let output = command.stderr(Stdio::inherit()).output().expect("the other program starts");
        let text = String::from_utf8_lossy(&output.stdout);
        serde_json::from_str(&text).unwrap_or_else(|error| panic!("{scene}: their images: {error}: {text}"))
    }
}

/// The scenes' folder.
fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bench/peers")
}

/// The mean of independent values, and its standard error.
fn mean_and_error(values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let count = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / count;
    let squares: f64 = values.map(|value| (value - mean) * (value - mean)).sum();
    (mean, (squares / (count - 1.0) / count).sqrt())
}

/// Red, green and blue of one block after another.
fn block_means(image: &[f64], width: usize) -> Vec<f64> {
    let height = image.len() / 3 / width;
    let corners = (0..height / SIDE).flat_map(|y| (0..width / SIDE).map(move |x| [x * SIDE, y * SIDE]));
    let mean = |[x, y]: [usize; 2], channel: usize| {
        let rows = (y..y + SIDE).flat_map(|y| (x..x + SIDE).map(move |x| y * width + x));
        rows.map(|at| image[3 * at + channel]).sum::<f64>() / (SIDE * SIDE) as f64
    };
    corners.flat_map(|corner| [0, 1, 2].map(|channel| mean(corner, channel))).collect()
}

/// The mean of all renders of both sides.
fn mean_image(sides: [&Renders; 2]) -> Vec<f64> {
    let images = || sides.iter().flat_map(|side| &side.images);
    let count = images().count() as f64;
    (0..sides[0].images[0].len()).map(|at| images().map(|image| image[at]).sum::<f64>() / count).collect()
}

/// The mean over pixels and channels of the variance of a render over r² + 0.01.
fn rel_mse(side: &Renders, truth: &[f64]) -> f64 {
    let count = side.images.len() as f64;
    let relative = |(at, truth): (usize, &f64)| {
        let (_, error) = mean_and_error(side.images.iter().map(|image| image[at]));
        count * error * error / (truth * truth + 0.01)
    };
    truth.iter().enumerate().map(relative).sum::<f64>() / truth.len() as f64
}
