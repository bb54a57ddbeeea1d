use super::options::{resolution, samples, workers};
use clap::Args;
use pinhole::scene::Resolution;
use pinhole_lab::report::ensemble::FEWEST;
use std::ffi::OsString;
use std::path::PathBuf;

/// What says how to measure, or what else.
const MEASURING: [&str; 6] = ["against", "quick", "size", "threads", "write", "naive"];

#[derive(Args, Clone, Default)]
pub struct ReportErrors {
    /// A chapter: its stem, its number or its name (17_sampling, 17, sampling); a scene file, ending in .ron; or all
    #[arg(value_name = "CHAPTER")]
    pub subject: String,
    /// Compare with this: sampler=NAME, filter=NAME, lights=NAME, method=NAME, a chapter or a scene
    /// file; may be given several times
    #[arg(long, value_name = "WHAT")]
    pub against: Vec<String>,
    /// Four sample counts of 8 seeds instead of five of 16
    #[arg(long)]
    pub quick: bool,
    /// How many pixels the image has (default: the scene's shape, about 5,000 pixels)
    #[arg(long, value_name = "WxH", allow_hyphen_values = true, value_parser = resolution)]
    pub size: Option<Resolution>,
    /// How many workers render the timed runs (default: 1)
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = workers)]
    pub threads: Option<u16>,
    /// Keep the report in the chapter's folder, as report.json
    #[arg(long)]
    pub write: bool,
    /// Measure nothing: print what is kept in the chapter's folder
    #[arg(long, conflicts_with_all = MEASURING)]
    pub kept: bool,
    /// Measure nothing but what naive measurements give, beside what is right
    #[arg(long, conflicts_with_all = ["against", "quick", "threads", "write"])]
    pub naive: bool,
    /// With --kept: draw the plot to this SVG instead
    // clap lets go of `requires` where what is required conflicts with another argument, so these are named as well.
    #[arg(short, long, value_name = "FILE", requires = "kept", conflicts_with_all = MEASURING)]
    pub output: Option<PathBuf>,
    /// With --kept: against samples instead of time
    #[arg(long, requires = "kept", conflicts_with_all = MEASURING)]
    pub samples_axis: bool,
}

impl ReportErrors {
    /// The command line, as it can be typed again.
    pub fn command_line(&self) -> String {
        let mut words = format!("cargo run --release -- report {}", self.subject);
        self.against.iter().for_each(|against| words += &format!(" --against {against}"));
        if let Some(Resolution { width, height }) = self.size {
            words += &format!(" --size {width}x{height}");
        }
        if self.quick {
            words += " --quick";
        }
        words
    }
}

#[derive(Args)]
pub struct MeasureAnew {
    /// A chapter: its stem, its number or its name (05_pinhole, 5, pinhole), or all, whether they ask for it or not
    pub chapter: Option<String>,
    /// Say what would be measured and why, and measure nothing
    #[arg(long)]
    pub dry_run: bool,
}

#[derive(Args)]
pub struct TryMethods {
    /// A chapter: its stem, its number or its name (39_both_ends, 39, both_ends); or a scene file, ending in .ron
    #[arg(value_name = "CHAPTER")]
    pub subject: OsString,
    /// Rays through each pixel of a picture (default: 16, or 4 with --quick)
    #[arg(short = 'n', long, value_name = "N", allow_hyphen_values = true, value_parser = samples)]
    pub samples: Option<u32>,
    /// Pictures by each method, each with a seed of its own (default: 16, or 8 with --quick)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(FEWEST as i64..=1024))]
    pub seeds: Option<u32>,
    /// How many pixels the image has (default: the scene's shape, about 5,000 pixels)
    #[arg(long, value_name = "WxH", allow_hyphen_values = true, value_parser = resolution)]
    pub size: Option<Resolution>,
    /// Fewer samples and seeds
    #[arg(long)]
    pub quick: bool,
}
