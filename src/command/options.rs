//! The options that several commands share.

use super::span::span;
use crate::chapter::{Asked, AskedSampling};
use crate::extract::MOST_SAMPLES;
use crate::scene::{Filter, Layers, Resolution, Sampler, TracePixel};
use clap::{Args, Parser};
use std::path::PathBuf;
use std::time::Duration;

#[derive(Args, Clone, Default)]
pub struct SceneOptions {
    /// How many pixels the image has
    #[arg(long, value_name = "WxH", allow_hyphen_values = true, value_parser = resolution)]
    pub size: Option<Resolution>,
    /// Paint this column instead of the picture (raster, ndc, screen, camera, world, hit, surface, light, …)
    #[arg(long, value_name = "COLUMN")]
    pub view: Option<String>,
    #[command(flatten)]
    pub sampling: SamplingOptions,
    /// Take as many samples of each pixel as bring its relative standard error down to E (such as 0.01)
    #[arg(long, value_name = "E", allow_hyphen_values = true)]
    pub error: Option<f64>,
    /// Keep more of every pixel than its light: position,normal,albedo,depth_along_ray,entity,… or all
    #[arg(long, value_name = "LAYERS", value_parser = Layers::of_words)]
    pub layers: Option<Layers>,
}

#[derive(Args, Clone, Default)]
pub struct SamplingOptions {
    /// Rays through each pixel (default: what the scene says, or one through its centre; 16 where another of the
    /// options of sampling is given)
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = samples)]
    pub samples: Option<u32>,
    /// Another seed, other random numbers (default: what the scene says, or 0)
    #[arg(long, value_name = "S", allow_hyphen_values = true, value_parser = seed)]
    pub seed: Option<u64>,
    /// Where the random numbers come from: sobol, stratified or independent (default: what the scene says, or sobol)
    #[arg(long, value_name = "WORD", value_parser = |word: &str| one_of(word, "sampler", &Sampler::ALL))]
    pub sampler: Option<Sampler>,
    /// What a sample counts for: box, tent, gaussian, mitchell or blackman-harris (default: what the scene says, or
    /// gaussian)
    #[arg(long, value_name = "WORD", value_parser = |word: &str| one_of(word, "filter", &Filter::ALL))]
    pub filter: Option<Filter>,
}

#[derive(Args, Clone, Default)]
pub struct RenderOptions {
    #[command(flatten)]
    pub scene: SceneOptions,
    /// How many workers render (default: as many as the machine has cores)
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = workers)]
    pub threads: Option<u16>,
    /// Where to write, ending in .png or .exr (default: both, in out/)
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Take samples for so long, such as 500ms, 10s or 2m
    #[arg(long, value_name = "TIME", value_parser = span)]
    pub time: Option<Duration>,
    /// Continue from the checkpoint beside the picture, to the same bits as if it had not been stopped
    #[arg(long)]
    pub resume: bool,
    /// Write the picture and its checkpoint this often while samples are taken (default: for 5 % of the time at most)
    #[arg(long, value_name = "TIME", value_parser = span)]
    pub write_every: Option<Duration>,
    /// Print time and rays of every stage as JSON, and nothing else
    #[arg(long, conflicts_with = "quiet")]
    pub stats: bool,
    /// Print nothing but where the picture is, and take no times
    #[arg(short, long)]
    pub quiet: bool,
}

/// A chapter's example
#[derive(Parser)]
#[command(version)]
pub struct ExampleArguments {
    #[command(flatten)]
    pub options: RenderOptions,
    /// Follow one pixel from raster to light instead, and print what every stage wrote for it
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, value_parser = pixel)]
    pub trace: Option<TracePixel>,
    /// Which of its samples to follow, counted from 0
    #[arg(long, value_name = "K", default_value_t = 0, requires = "trace")]
    pub sample: u32,
}

impl SceneOptions {
    pub fn asked(&self, statistics: bool) -> Asked {
        Asked {
            resolution: self.size,
            view: self.view.clone(),
            statistics,
            sampling: self.sampling.asked(),
            endless: false,
            error: self.error,
            layers: self.layers.clone(),
        }
    }
}

impl RenderOptions {
    pub fn asked(&self, statistics: bool) -> Asked {
        Asked { endless: self.time.is_some(), ..self.scene.asked(statistics) }
    }
}

impl SamplingOptions {
    pub fn asked(&self) -> AskedSampling {
        AskedSampling { samples: self.samples, seed: self.seed, sampler: self.sampler, filter: self.filter }
    }
}

pub fn resolution(text: &str) -> Result<Resolution, String> {
    let (width, height) =
        pair(text, 'x').ok_or("a size is two whole numbers of pixels with an x between, such as 960x540")?;
    Ok(Resolution { width, height })
}

pub fn pixel(text: &str) -> Result<TracePixel, String> {
    let (x, y) = pair(text, ',').ok_or("a pixel is two whole numbers with a comma between, such as 48,27")?;
    Ok(TracePixel { x, y })
}

pub fn workers(text: &str) -> Result<u16, String> {
    let number = text.trim().parse().ok().filter(|number| (1..=1024).contains(number));
    number.ok_or("a number of workers is a whole number from 1 to 1024".into())
}

fn samples(text: &str) -> Result<u32, String> {
    let number = text.trim().parse().ok().filter(|number| (1..=MOST_SAMPLES).contains(number));
    number.ok_or(format!("a number of samples is a whole number from 1 to {MOST_SAMPLES}"))
}

fn seed(text: &str) -> Result<u64, String> {
    text.trim().parse().map_err(|_| format!("a seed is a whole number from 0 to {}", u64::MAX))
}

fn one_of<T: Copy>(word: &str, kind: &str, all: &[(&str, T)]) -> Result<T, String> {
    let found = all.iter().find(|(own, _)| *own == word).map(|(_, value)| *value);
    found.ok_or_else(|| {
        let words: Vec<&str> = all.iter().map(|(own, _)| *own).collect();
        format!("a {kind} is one of {}", words.join(", "))
    })
}

fn pair(text: &str, between: char) -> Option<(u32, u32)> {
    let (first, second) = text.split_once(between)?;
    Some((first.trim().parse().ok()?, second.trim().parse().ok()?))
}
