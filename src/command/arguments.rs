use super::called::called;
use super::format::Format;
use super::options::{MAX_PARTS, RenderOptions, STYLES, SamplingOptions, SceneOptions, pixel, size, workers};
use super::report_arguments::{MeasureAnew, ReportErrors, TryMethods};
use super::span::span;
use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use pinhole::Size;
use pinhole::look::convention::Mistake;
use pinhole::scene::TracePixel;
use pinhole_lab::measure::extremes::Group;
use std::ffi::OsString;
use std::path::PathBuf;
use std::time::Duration;

/// pinhole: a ray tracing book you can run
#[derive(Parser)]
#[command(name = "pinhole", version, styles = STYLES, max_term_width = 100)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Option<Command>,
    /// Print tables for a person, or one JSON value for a program
    #[arg(long, global = true, value_enum, default_value_t, hide_possible_values = true, value_name = "text|json")]
    pub format: Format,
}

/// What stands below the commands: what happens without one, and commands to begin with.
pub fn after_help() -> String {
    let tries = [
        "list",
        "render 05_pinhole --size 960x540",
        "render cover --view surface",
        "plan 04_orthographic",
        "trace cover --pixel 480,300",
        "extremes shapes --rays 500",
        "sweep 05_pinhole",
        "report 18 --quick",
        "export 05_pinhole",
        "check",
        "render 5 --mine",
        "render 10 --naive shadow-rays-from-the-hit",
    ];
    let tries: Vec<String> = tries.iter().map(|words| format!("  {}", called(words))).collect();
    format!(
        "Without a command, the cover scene is rendered to out/cover.png and out/cover.exr; a chapter or a scene file alone \
         is rendered too.\n\nThings to try:\n{}",
        tries.join("\n")
    )
}

#[derive(Subcommand)]
pub enum Command {
    /// List the chapters
    List,
    /// Render a chapter's scene or a scene file, or paint one of its columns
    Render(RenderChapter),
    /// Add the parts of a picture that `render --part` made up to the picture that one machine would have rendered
    Merge(MergeParts),
    /// Write a job that renders a picture in parts on Slurm, by Open Job Description or by GNU parallel; or run it here
    Farm(FarmOut),
    /// Print which stages a chapter's scene needs, which are left out, and why
    Plan(PlanChapter),
    /// Print the warnings that a render would begin with; without a scene, those of scenes gone wrong
    Preflight(TryPreflight),
    /// Print what a scene's camera sees across each axis of the image, in degrees
    Angles(PlanChapter),
    /// Follow one pixel from raster to light, and print what every stage wrote for it
    Trace(TraceChapter),
    /// Look at a scene in the browser: move the camera, paint columns, trace pixels, switch stages, edit, save
    View(ViewScene),
    /// Render what a program asks for on standard input, line by line: the book's live figures
    #[command(hide = true)]
    Live(LiveFigures),
    /// Try the methods where numbers are hardest, beside the naive ones and exact arithmetic
    Extremes(TryExtremes),
    /// Compare whole renders with closed forms, and print each one's standard error
    ClosedForms(TryClosedForms),
    /// Render a chapter's scene in other units, elsewhere, turned, through other angles, in other sizes
    Sweep(SweepChapter),
    /// Write a chapter's scene as a scene file, to be edited and rendered
    Export(ExportScene),
    /// Measure what a chapter's stages cost, and how exact what they write is
    Cost(CostOfChapter),
    /// Measure error against run time: many samples, many seeds, a reference, intervals
    Report(ReportErrors),
    /// Try the methods that may find a scene's light, and say which one to render it by, and why
    Methods(TryMethods),
    /// Measure anew what is kept beside the chapters: costs, reports, curves, where stages or film have changed
    Measure(MeasureAnew),
    /// Check the function that a chapter asks you to write; without a chapter, list them and how far you are
    Check(CheckExercise),
    /// Compare the picture that your own program wrote with pinhole's of the same scene; without it, draw that
    Yours(CompareYours),
    /// Draw a figure of the book from its chapter's scene; without a name, list the figures
    Figure(DrawFigure),
    /// Draw an image that a chapter reads from a file; without a name, list them
    Draw(DrawImage),
    /// Print what to type in other programs to get a scene's camera there, and how to come back
    Conventions(CompareConventions),
    /// Show on a page what the tests found to differ from the kept snapshots; accept or reject it
    Review(ReviewSnapshots),
    /// Measure how far a picture is from another, both PNG or both EXR
    Compare(CompareImages),
    /// Print a script that lets a shell complete this program's words
    Completions {
        /// The shell that reads it
        shell: Shell,
    },
}

#[derive(Args)]
#[command(args_conflicts_with_subcommands = true)]
pub struct ReviewSnapshots {
    #[command(subcommand)]
    pub action: Option<ReviewAction>,
    /// Only this chapter: its stem, its number or its name (05_pinhole, 5, pinhole)
    pub chapter: Option<String>,
    /// Show the page as it would look with a mutation of one stage (all: a table of all mutations)
    #[arg(long, value_name = "MUTATION")]
    pub mutate: Option<String>,
    /// Write one picture instead of the page
    #[arg(long, requires = "mutate")]
    pub picture: Option<Picture>,
    /// With --mutate all: a drawing instead of a table
    #[arg(long, requires = "mutate")]
    pub gallery: bool,
    /// Where to write (default: out/review/index.html)
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// The folder of chapters (default: the one beside the source)
    #[arg(long, value_name = "FOLDER", global = true)]
    pub chapters: Option<PathBuf>,
}

#[derive(Subcommand)]
pub enum ReviewAction {
    /// Keep the snapshots that wait, as `cargo insta accept` does
    Accept {
        /// A chapter, or all; may be left out where only one waits
        chapter: Option<String>,
    },
    /// Throw the snapshots that wait away, as `cargo insta reject` does
    Reject {
        /// A chapter, or all; may be left out where only one waits
        chapter: Option<String>,
    },
}

#[derive(Clone, Copy, ValueEnum)]
pub enum Picture {
    /// What is kept
    Before,
    /// What is computed
    Now,
    /// How far the two are from each other
    Difference,
}

#[derive(Args)]
pub struct CompareImages {
    /// The image that is taken for right, PNG or EXR
    pub reference: PathBuf,
    /// The image that is measured, of the same kind and size
    pub image: PathBuf,
    /// Where to write a PNG of the difference
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// The same as --format json
    #[arg(long, hide = true)]
    pub json: bool,
}

#[derive(Args)]
pub struct CompareYours {
    /// The chapter after whose step your program is; without it, the chapters that have one
    pub chapter: Option<String>,
    /// The picture.ppm that your program wrote
    pub picture: Option<PathBuf>,
    /// Your program, in which the mistake is looked for; src/main.rs or main.rs beside the picture unless said
    #[arg(long, value_name = "FILE", requires = "picture")]
    pub source: Option<PathBuf>,
    /// Where to write pinhole's picture of the scene, as a PNG
    #[arg(short, long, value_name = "FILE", conflicts_with = "picture")]
    pub output: Option<PathBuf>,
    /// Print the whole program as it is after the chapter's step
    #[arg(long, conflicts_with_all = ["picture", "output"])]
    pub program: bool,
}

#[derive(Args)]
pub struct TryPreflight {
    /// A chapter or a scene file; without it, small scenes with something wrong
    pub chapter: Option<OsString>,
    #[command(flatten)]
    pub options: SceneOptions,
}

#[derive(Args)]
pub struct TryClosedForms {
    /// Only those whose name holds this text
    #[arg(long, value_name = "TEXT", default_value = "")]
    pub case: String,
    /// Take this many times the samples that give each number to 1 %; 100 times as many give it to 0.1 %
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub times: u32,
    /// Another seed, other random numbers
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub seed: u64,
}

#[derive(Args)]
pub struct TryExtremes {
    /// One of the groups, such as shapes, film or material (default: all); another word lists them
    #[arg(value_parser = |word: &str| word.parse::<Group>())]
    pub group: Option<Group>,
    /// Only the cases whose name holds this text; with a + in it, each part, as in cones:+leave
    #[arg(long, value_name = "TEXT", default_value = "")]
    pub case: String,
    /// How many rays each case tries
    #[arg(long, value_name = "N", default_value_t = 100_000, value_parser = clap::value_parser!(u64).range(1..=1_000_000_000))]
    pub rays: u64,
    /// Write the tables as a page too, with pictures (such as out/extremes/index.html)
    #[arg(long, value_name = "FILE")]
    pub page: Option<PathBuf>,
}

#[derive(Args)]
pub struct SweepChapter {
    /// A chapter: its stem, its number or its name (05_pinhole, 5, pinhole); or a scene file (scene.ron)
    pub chapter: OsString,
}

#[derive(Args)]
pub struct CheckExercise {
    /// A chapter: its stem, its number or its name (05_pinhole, 5, pinhole)
    pub chapter: Option<String>,
}

#[derive(Args)]
pub struct CostOfChapter {
    /// A chapter: its stem, its number or its name (05_pinhole, 5, pinhole), or all
    pub chapter: String,
    /// Keep what was measured in the chapter's folder, as costs.txt
    #[arg(long)]
    pub write: bool,
}

#[derive(Args)]
pub struct CompareConventions {
    /// A chapter: its stem, its number or its name (05_pinhole, 5, pinhole); or a scene file, ending in .ron
    pub chapter: OsString,
    /// How many pixels the image has: 960x540, 1080p, a width alone such as 960, or a part such as 50%
    #[arg(long, value_name = "SIZE", allow_hyphen_values = true, value_parser = size)]
    pub size: Option<Size>,
    /// Render what is seen if a word of another program is read as pinhole's: mirrored, upside-down, backwards, too-narrow,
    /// too-wide or rolled
    #[arg(long, value_name = "WORD", value_parser = |word: &str| word.parse::<Mistake>())]
    pub mistake: Option<Mistake>,
    /// Convert this many cameras to each program's terms and back, and print how far they have moved
    #[arg(long, value_name = "N", conflicts_with = "mistake", value_parser = clap::value_parser!(u64).range(1..=100_000_000))]
    pub round_trips: Option<u64>,
    /// Where to write the picture, ending in .png (default: in out/)
    #[arg(short, long, value_name = "FILE", requires = "mistake")]
    pub output: Option<PathBuf>,
}

#[derive(Args)]
pub struct DrawFigure {
    /// The figure's name, such as 05_pinhole
    pub name: Option<String>,
    /// Where to write the SVG (default: out/<name>.svg)
    #[arg(short, long, value_name = "FILE", requires = "name")]
    pub output: Option<PathBuf>,
}

#[derive(Args)]
pub struct DrawImage {
    /// The image's file name, such as card.png
    pub name: Option<String>,
    /// Where to write it (default: out/<name>)
    #[arg(short, long, value_name = "FILE", requires = "name")]
    pub output: Option<PathBuf>,
}

#[derive(Args)]
pub struct ExportScene {
    /// A chapter: its stem, its number or its name (05_pinhole, 5, pinhole)
    pub chapter: OsString,
    /// Where to write, ending in .ron; what is there stays (default: printed)
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    #[command(flatten)]
    pub sampling: SamplingOptions,
}

#[derive(Args)]
pub struct RenderChapter {
    /// A chapter: its stem, its number or its name (05_pinhole, 5, pinhole); a scene file, ending in .ron; or - for one on
    /// standard input
    pub chapter: OsString,
    /// Where to write, as with --output
    #[arg(value_name = "OUT")]
    pub to: Option<PathBuf>,
    /// Render the scene file again whenever it is saved, until Ctrl-C
    #[arg(long, conflicts_with = "stats")]
    pub watch: bool,
    /// Render the chapter with the function that you have written for its exercise in place of pinhole's, beside pinhole's
    /// picture and the difference (default: to out/, as 05_mine.png; with --output, your picture alone)
    #[arg(long, conflicts_with_all = ["watch", "set", "naive"])]
    pub mine: bool,
    #[command(flatten)]
    pub options: RenderOptions,
}

#[derive(Args)]
pub struct MergeParts {
    /// The chapter, scene file or model file that was rendered, with the options that it was rendered with
    pub chapter: OsString,
    /// The parts (default: those beside the picture)
    #[arg(value_name = "PART")]
    pub parts: Vec<PathBuf>,
    /// Render so many pieces of each part again, chosen at random, and refuse a part of which one differs
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    pub verify: usize,
    #[command(flatten)]
    pub options: RenderOptions,
}

#[derive(Args)]
pub struct FarmOut {
    /// A chapter, a scene file or a model file, with all options of a render
    pub chapter: OsString,
    /// In how many parts
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_PARTS)))]
    pub parts: u32,
    /// For what: slurm, openjd or parallel
    #[arg(long, value_enum, value_name = "WORD", required_unless_present = "local")]
    pub to: Option<Engine>,
    /// Render the parts on this machine, each by a process of its own, and merge them
    #[arg(long, conflicts_with = "to")]
    pub local: bool,
    /// Hand the job to the scheduler, watch it, and merge the parts as they arrive
    #[arg(long, requires = "to")]
    pub submit: bool,
    /// How long a part may take before it is stopped, kept and begun again where it was
    #[arg(long, value_name = "TIME", default_value = "1h", value_parser = span)]
    pub limit: Duration,
    #[command(flatten)]
    pub options: RenderOptions,
}

/// What runs the parts of a picture on several machines.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Engine {
    /// Slurm: an array of jobs
    Slurm,
    /// Open Job Description: a template
    Openjd,
    /// GNU parallel: a line
    Parallel,
}

#[derive(Args)]
pub struct PlanChapter {
    /// A chapter: its stem, its number or its name (05_pinhole, 5, pinhole); or a scene file, ending in .ron
    pub chapter: OsString,
    #[command(flatten)]
    pub options: SceneOptions,
}

#[derive(Args)]
pub struct TraceChapter {
    /// A chapter: its stem, its number or its name (05_pinhole, 5, pinhole); or a scene file, ending in .ron
    pub chapter: OsString,
    /// The pixel, counted from 0 at the top left corner
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, value_parser = pixel)]
    pub pixel: TracePixel,
    /// Which of its samples, counted from 0
    #[arg(long, value_name = "K", default_value_t = 0)]
    pub sample: u32,
    /// Print every bounce of a long path, not only the first and the last few
    #[arg(long)]
    pub all: bool,
    #[command(flatten)]
    pub options: SceneOptions,
}

#[derive(Args)]
pub struct ViewScene {
    /// A chapter: its stem, its number or its name (05_pinhole, 5, pinhole); a scene file, ending in .ron; or a model file
    /// (default: the cover)
    pub chapter: Option<OsString>,
    /// How many pixels the image has: 960x540, 1080p, a width alone such as 960, or a part such as 50%
    #[arg(long, value_name = "SIZE", allow_hyphen_values = true, value_parser = size)]
    pub size: Option<Size>,
    /// How many workers render at most (default: RAYON_NUM_THREADS, or as many as the machine has cores)
    #[arg(short = 'j', long, value_name = "N", allow_hyphen_values = true, value_parser = workers)]
    pub threads: Option<u16>,
    /// A picture of the same size to compare with: .exr, or .png, which holds 8 bits and nothing brighter than white
    #[arg(long, value_name = "FILE")]
    pub reference: Option<PathBuf>,
    /// The port of this machine to be answered at (default: one that is free)
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    pub port: u16,
    /// Print the address, and open no browser
    #[arg(long)]
    pub no_open: bool,
}

#[derive(Args)]
pub struct LiveFigures {
    /// Print the values of this chapter's scene that --value names, and end
    #[arg(requires = "value")]
    pub chapter: Option<OsString>,
    /// A value, such as camera.perspective_camera.fov
    #[arg(long, value_name = "ENTITY.COMPONENT.FIELD", requires = "chapter")]
    pub value: Vec<String>,
}

impl RenderChapter {
    /// The options, with the file that was named without one.
    pub fn options(&self) -> RenderOptions {
        let mut options = self.options.clone();
        options.output.extend(self.to.clone());
        options
    }
}
