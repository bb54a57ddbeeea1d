//! What a person sees at the end of a render: a few lines, none wider than a terminal.

use super::span::told;
use pinhole::look::RenderStats;
use pinhole::render::Outcome;
use pinhole::scene::OPEN_END;
use serde::Serialize;
use std::time::Duration;

/// No line is wider.
const WIDEST: usize = 120;
/// No summary is longer.
const MAX_LINES: usize = 6;
/// How many of the stages are named.
const NAMED: usize = 3;

/// What a render came to.
pub struct Summary<'a> {
    /// What it cost.
    pub stats: &'a RenderStats,
    /// The integrator and why it was chosen, where the camera names none and rays go beyond the first surface.
    pub integrator: Option<String>,
    /// The samples, where it took several.
    pub outcome: Option<&'a Outcome>,
    /// How many samples a pixel it was to take.
    pub samples: u32,
    /// The error that was asked for.
    pub target: Option<f64>,
    /// The files that hold it.
    pub files: String,
    /// The command that lists the stages that were left out.
    pub plan: String,
    /// A command to go on with.
    pub next: Option<String>,
}

impl Summary<'_> {
    /// The lines, the most important first.
    pub fn lines(&self) -> Vec<String> {
        let stats = self.stats;
        let time = told(Duration::from_secs_f64(stats.milliseconds / 1e3));
        let came = format!(
            "{} × {} pixels, {}, {} rays in {time}",
            stats.width,
            stats.height,
            self.samples_each(),
            count(stats.rays)
        );
        let mut lines = Vec::new();
        let both = format!("{}: {came}", self.files);
        if both.chars().count() <= WIDEST {
            lines.push(both);
        } else {
            lines.extend([self.files.clone(), came]);
        }
        lines.extend(self.slowest());
        let (ran, says) = match stats.left_out.len() {
            0 => (format!("{} stages ran, all that are on offer", stats.stages.len()), "lists them"),
            left => (format!("{} stages ran, {left} left out", stats.stages.len()), "says why"),
        };
        // A command that is cut off cannot be run.
        let with_command = format!("{ran}: {} {says}", self.plan);
        let is_whole = with_command.chars().count() <= WIDEST;
        lines.push(if is_whole { with_command } else { format!("{ran}: `plan` with the same options {says}") });
        lines.extend(self.integrator.iter().map(|chosen| format!("no integrator is named, so {chosen}")));
        lines.extend(self.ended());
        lines.extend(
            self.next.iter().map(|next| format!("try next: {next}")).filter(|line| line.chars().count() <= WIDEST),
        );
        lines.truncate(MAX_LINES);
        lines.iter().map(|line| cut(line)).collect()
    }

    fn samples_each(&self) -> String {
        match self.outcome {
            None | Some(Outcome { samples: 1, achieved: None, .. }) => "1 sample each".into(),
            Some(Outcome { achieved: Some(found), .. }) => {
                let (mean, fewest, max) = found.samples;
                format!("{mean:.1} samples each ({fewest} to {max})")
            }
            Some(outcome) => format!("{} samples each", outcome.samples),
        }
    }

    /// The stages that took most of the time; none where nothing was left to do.
    fn slowest(&self) -> Option<String> {
        let all: f64 = self.stats.stages.iter().map(|stage| stage.milliseconds).sum();
        if all <= 0.0 {
            return None;
        }
        let mut stages: Vec<_> = self.stats.stages.iter().collect();
        stages.sort_by(|one, other| other.milliseconds.total_cmp(&one.milliseconds));
        let percent = |milliseconds: f64| 100.0 * milliseconds / all;
        let named = stages.iter().take(NAMED).map(|stage| (stage.stage, percent(stage.milliseconds)));
        let named =
            named.filter(|(_, percent)| *percent >= 0.5).map(|(stage, percent)| format!("{stage} {percent:.0} %"));
        Some(format!("slowest stages: {}", named.collect::<Vec<_>>().join(", ")))
    }

    /// What a limit of time and a target of error came to.
    fn ended(&self) -> Vec<String> {
        let Some(outcome) = self.outcome else { return Vec::new() };
        let mut lines = Vec::new();
        if outcome.out_of_time {
            let of = if self.samples == OPEN_END { String::new() } else { format!(" of {}", self.samples) };
            lines.push(format!("the time is up: {}{of} samples a pixel in {}", outcome.samples, told(outcome.time)));
        }
        if let (Some(found), Some(target)) = (outcome.achieved, self.target) {
            lines.push(format!(
                "error {target} asked, {:.4} measured; {} of {} pixels are above it, {} of them for want of samples",
                found.error, found.above, found.pixels, found.cut_short
            ));
        }
        lines
    }

    /// The same for a program.
    pub fn data<'s>(&'s self, files: &[String], warnings: &'s [String]) -> impl Serialize + 's {
        let achieved = self.outcome.and_then(|outcome| outcome.achieved);
        Data {
            stats: self.stats,
            files: files.to_vec(),
            samples: self.outcome.map_or(1, |outcome| outcome.samples),
            out_of_time: self.outcome.is_some_and(|outcome| outcome.out_of_time),
            error: achieved.zip(self.target).map(|(found, asked)| ErrorData {
                asked,
                measured: found.error,
                pixels: found.pixels,
                pixels_above: found.above,
                pixels_cut_short: found.cut_short,
                mean_samples: found.samples.0,
                fewest_samples: found.samples.1,
                most_samples: found.samples.2,
            }),
            warnings,
        }
    }
}

#[derive(Serialize)]
struct Data<'a> {
    #[serde(flatten)]
    stats: &'a RenderStats,
    files: Vec<String>,
    samples: u32,
    out_of_time: bool,
    error: Option<ErrorData>,
    warnings: &'a [String],
}

#[derive(Serialize)]
struct ErrorData {
    asked: f64,
    measured: f64,
    pixels: u64,
    pixels_above: u64,
    pixels_cut_short: u64,
    mean_samples: f64,
    fewest_samples: u32,
    most_samples: u32,
}

/// A large number as a person says it.
fn count(number: u64) -> String {
    match number as f64 {
        few if few < 1e4 => number.to_string(),
        thousands if thousands < 1e6 => format!("{:.0} thousand", thousands / 1e3),
        millions if millions < 1e9 => format!("{:.1} million", millions / 1e6),
        billions => format!("{:.1} billion", billions / 1e9),
    }
}

/// A line that is not too wide; of a wider one the end is left, where a path has its file's name.
fn cut(line: &str) -> String {
    let length = line.chars().count();
    if length <= WIDEST {
        return line.into();
    }
    let half = (WIDEST - 1) / 2;
    let letters = || line.chars();
    letters().take(half).chain(['…']).chain(letters().skip(length - half)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use pinhole::look::StageStats;
    use pinhole::render::Achieved;

    fn stats(stages: usize) -> RenderStats {
        let stage = |number: usize| StageStats {
            stage: ["Sample lights", "Intersect spheres", "Transform rays to world space", "Classify"][number % 4],
            rows: 1,
            milliseconds: number as f64,
            nanoseconds_per_row: None,
        };
        RenderStats {
            scene: "05_pinhole".into(),
            width: 480,
            height: 270,
            threads: 2,
            milliseconds: 41.3,
            megarays_per_second: 1.0,
            rays: 243_512,
            film_bytes: 0,
            film_bytes_per_pixel: 0.0,
            table_bytes: 0,
            column_bytes_per_tile: 0,
            peak_memory_bytes: None,
            rejected_samples: 0,
            stages: (0..stages).map(stage).collect(),
            left_out: vec![("Spread".into(), "nothing is matte".into())],
        }
    }

    fn summary<'a>(stats: &'a RenderStats, outcome: Option<&'a Outcome>) -> Summary<'a> {
        Summary {
            stats,
            integrator: None,
            outcome,
            samples: 64,
            target: None,
            files: "out/05_pinhole.png and .exr".into(),
            plan: "pinhole plan 5".into(),
            next: Some("pinhole trace 5 --pixel 1,1".into()),
        }
    }

    #[test]
    fn a_plain_render_is_told_in_four_lines() {
        assert_eq!(
            summary(&stats(5), None).lines(),
            [
                "out/05_pinhole.png and .exr: 480 × 270 pixels, 1 sample each, 244 thousand rays in 41 ms",
                "slowest stages: Sample lights 40 %, Classify 30 %, Transform rays to world space 20 %",
                "5 stages ran, 1 left out: pinhole plan 5 says why",
                "try next: pinhole trace 5 --pixel 1,1",
            ]
        );
    }

    #[test]
    fn a_command_is_told_whole_or_not_at_all() {
        let plan = |options: &str| format!("pinhole plan 5 --set 'lamp.name=\"{options}\"'");
        for (letters, told) in [(40, plan(&"x".repeat(40))), (60, "`plan` with the same options".into())] {
            let lines = Summary { plan: plan(&"x".repeat(letters)), ..summary(&stats(5), None) }.lines();
            assert_eq!(lines[2], format!("5 stages ran, 1 left out: {told} says why"));
        }
    }

    #[test]
    fn no_summary_is_longer_or_wider_than_promised() {
        let found = Achieved { error: 0.0213, pixels: 129_600, above: 12, cut_short: 3, samples: (13.24, 4, 64) };
        let outcome = Outcome { out_of_time: true, samples: 12, achieved: Some(found), ..Outcome::default() };
        let stats = stats(3);
        let long = Summary {
            target: Some(0.02),
            files: format!("{}/picture.png", "folder/".repeat(40)),
            ..summary(&stats, Some(&outcome))
        };
        let lines = long.lines();
        assert_eq!(lines.len(), 6, "{lines:#?}");
        assert!(lines.iter().all(|line| line.chars().count() <= 120), "{lines:#?}");
        assert!(lines[0].ends_with("/picture.png"), "{}", lines[0]);
        assert!(lines[1].contains("13.2 samples each (4 to 64)"), "{}", lines[1]);
        assert_eq!(lines[4], "the time is up: 12 of 64 samples a pixel in 0 ms");
        let told = "error 0.02 asked, 0.0213 measured; 12 of 129600 pixels are above it, 3 of them for want of samples";
        assert_eq!(lines[5], told);
    }

    #[test]
    fn an_integrator_that_nobody_named_is_told() {
        let integrator = Some("path tracing: light from the sky, 1 coloured background: \"sky\"".into());
        let lines = Summary { integrator, ..summary(&stats(5), None) }.lines();
        assert_eq!(
            lines[3],
            "no integrator is named, so path tracing: light from the sky, 1 coloured background: \"sky\""
        );
        assert_eq!(lines.len(), 5);
    }

    #[test]
    fn counts_read_as_they_are_said() {
        let counts = [0, 9_999, 12_345, 1_250_000, 3_000_000_000].map(count);
        assert_eq!(counts, ["0", "9999", "12 thousand", "1.2 million", "3.0 billion"]);
    }
}
