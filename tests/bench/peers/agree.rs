//! Whether pinhole and Mitsuba render the same picture of a scene, by the means of blocks of its pixels.
//!
//! Each program renders the scene several times with seeds of its own, so that every block mean has a standard error on
//! both sides.

use super::{named, offer};
use pinhole::plan::Census;
use pinhole::render::{Execution, RenderInProgress};
use pinhole::scene::{Sampling, SceneFile};
use pinhole_lab::report::distribution::{sidak, student_cdf};
use pinhole_lab::report::run::numbers;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

/// The side of a block, in pixels; the scenes are whole blocks wide and high.
const SIDE: u32 = 16;

/// The relative error of Mitsuba's sums in single precision.
const ROUNDING: f64 = 2e-6;

/// What is compared, and how.
pub struct Agreement {
    /// The names of scenes in tests/bench/peers.
    pub scenes: Vec<String>,
    /// A Python that has numpy and mitsuba.
    pub python: String,
    /// Mitsuba's variant.
    pub variant: String,
    /// Renders of each program.
    pub runs: u64,
    /// Samples per pixel of each render.
    pub samples: u32,
}

/// The block means of each render: red, green and blue of one block after another.
type BlockMeans = Vec<Vec<f64>>;

impl Agreement {
    /// Compares all scenes; true if none is apart.
    pub fn run(&self) -> bool {
        let agrees: Vec<bool> = self.scenes.iter().map(|scene| self.compare(scene)).collect();
        agrees.into_iter().all(|agrees| agrees)
    }

    /// Compares one scene and prints what was found.
    fn compare(&self, scene: &str) -> bool {
        let started = Instant::now();
        let (own, across) = self.pinhole(scene);
        let half = Instant::now();
        let theirs = self.mitsuba(scene);
        let seconds = [(half - started).as_secs_f64(), half.elapsed().as_secs_f64()];
        let tests = own[0].len();
        assert!(own.iter().chain(&theirs).all(|means| means.len() == tests), "{scene}: images of different sizes");
        // Each side's spread is known from its own renders only, so the ratio follows Student's t rather than a normal
        // distribution.
        let freedom = 2.0 * (self.runs - 1) as f64;
        let limit = 1.0 - sidak(0.99, tests);
        let (mut squares, mut apart, mut worst, mut known) = (0.0, 0, (0.0_f64, 0), Vec::new());
        for test in 0..tests {
            let [(mean, error), (their_mean, their_error)] =
                [&own, &theirs].map(|renders| mean_and_error(renders.iter().map(|means| means[test])));
            // A block of nothing but sky has no noise, only rounding.
            let both = error.hypot(their_error).hypot(ROUNDING * their_mean);
            let z = (mean - their_mean) / both;
            squares += z * z;
            apart += usize::from(2.0 * student_cdf(-z.abs(), freedom) < limit);
            known.push(both / their_mean);
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
            "{scene}: {} blocks of {SIDE} × {SIDE} pixels in 3 channels, {} renders of {} samples each side; \
             (pinhole − Mitsuba) / SE: rms {:.2} (expected {:.2}), worst {:+.1} in block ({}, {}), {apart} of {tests} \
             apart at 1 % (Šidák); SE of a block {:.3} % (median), {:.3} % (worst); ratio of the means {:.5} ± {:.5}; \
             {:.0} s and {:.0} s",
            tests / 3,
            self.runs,
            self.samples,
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
        apart == 0
    }

    /// Pinhole's renders, and how many blocks the image is wide.
    fn pinhole(&self, scene: &str) -> (BlockMeans, usize) {
        let file = folder().join(format!("{scene}.ron"));
        let mut across = 0;
        let mut render = |seed| -> Vec<f64> {
            let mut world = SceneFile::open(&file).unwrap_or_else(|problem| panic!("{problem}")).world();
            let camera = named(&mut world, "camera");
            if let Some(mut sampling) = world.get_mut::<Sampling>(camera) {
                *sampling = Sampling { samples: self.samples, seed, ..*sampling };
            }
            let mut render =
                RenderInProgress::begin(&Census::of(&world), &offer(), &Execution::default()).expect("begins");
            render.advance(render.steps(), &()).expect("renders");
            let image = numbers(&render.finish().film);
            let [width, height] = image.size;
            across = (width / SIDE) as usize;
            let corners = (0..height / SIDE).flat_map(|y| (0..width / SIDE).map(move |x| [x * SIDE, y * SIDE]));
            let mean = |[x, y]: [u32; 2], channel: usize| {
                let rows = (y..y + SIDE).flat_map(|y| (x..x + SIDE).map(move |x| (y * width + x) as usize));
                rows.map(|at| image.pixels[at][channel]).sum::<f64>() / f64::from(SIDE * SIDE)
            };
            corners.flat_map(|corner| [0, 1, 2].map(|channel| mean(corner, channel))).collect()
        };
        let means = (0..self.runs).map(|run| render(500 + run)).collect();
        (means, across)
    }

    /// Mitsuba's renders.
    fn mitsuba(&self, scene: &str) -> BlockMeans {
        let output = Command::new(&self.python)
            .arg(folder().join("mitsuba_scenes.py"))
            .arg(scene)
            .args(["--variant", &self.variant, "--side", &SIDE.to_string()])
            .args(["--samples", &self.samples.to_string(), "--runs", &self.runs.to_string()])
            .stderr(Stdio::inherit())
            .output()
            .expect("Python starts");
        let text = String::from_utf8_lossy(&output.stdout);
        serde_json::from_str(&text).unwrap_or_else(|error| panic!("{scene}: Mitsuba's block means: {error}: {text}"))
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
