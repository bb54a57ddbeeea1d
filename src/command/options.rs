//! The options that several commands have in common.

use super::called::quoted;
use super::span::span;
use clap::Args;
use clap::builder::styling::{AnsiColor, Styles};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use pinhole::extract::MAX_SAMPLES;
use pinhole::film::{LayerNames, Part, Split};
use pinhole::rays::Tile;
use pinhole::scene::{Exposure, Filter, Layers, Resolution, Sampler, ToneMapping, TracePixel};
use pinhole::{Overrides, SamplingOverrides, Size};
use pinhole_lab::naive::methods::{METHODS, NaiveMethod};
use std::path::PathBuf;
use std::time::Duration;

/// The last frame that a film may have.
const MAX_FRAME: u32 = 9_999_999;
/// At how many moments a frame is rendered unless that is said.
pub const MOMENTS: u32 = 16;
/// The greatest number of parts.
pub const MAX_PARTS: u32 = 1_000_000;

#[derive(Args, Clone, Default)]
pub struct SceneOptions {
    /// How many pixels the image has: 960x540, 1080p, a width alone such as 960, or a part such as 50%
    #[arg(long, value_name = "SIZE", allow_hyphen_values = true, value_parser = size)]
    pub size: Option<Size>,
    /// How wide the image is, in pixels; the scene says how high, unless --height does
    #[arg(long, value_name = "PIXELS", conflicts_with = "size", allow_hyphen_values = true, value_parser = side)]
    pub width: Option<u32>,
    /// How high the image is, in pixels; the scene says how wide, unless --width does
    #[arg(long, value_name = "PIXELS", conflicts_with = "size", allow_hyphen_values = true, value_parser = side)]
    pub height: Option<u32>,
    /// Paint this column instead of the picture (raster, ndc, screen, camera, world, hit, surface, light, …)
    #[arg(long, value_name = "COLUMN")]
    pub view: Option<String>,
    #[command(flatten)]
    pub sampling: SamplingOptions,
    /// Take as many samples of each pixel as bring its relative standard error down to E (such as 0.01)
    #[arg(long, value_name = "E", allow_hyphen_values = true, value_parser = error)]
    pub error: Option<f64>,
    /// Keep more of every pixel than its light: position,normal,albedo,depth_along_ray,entity,… or all
    #[arg(long, value_name = "LAYERS", value_parser = Layers::of_words)]
    pub layers: Option<Layers>,
    /// Make the picture brighter by so many stops, each a factor of two, or by as many as fit its light: auto, or auto
    /// and stops beside it, such as auto-1; an EXR stays as it is
    #[arg(long, value_name = "STOPS", allow_hyphen_values = true, value_parser = exposure)]
    pub exposure: Option<Exposure>,
    /// Bring light brighter than white into the picture: reinhard, aces, pbr-neutral, agx or none; an EXR stays as it is
    #[arg(long, value_name = "WORD", value_parser = |word: &str| one_of(word, "tone mapping", &ToneMapping::ALL))]
    pub tone_map: Option<ToneMapping>,
    /// Set a value of the scene, such as camera.perspective_camera.fov=62: an entity by its name, a component, a field;
    /// may be given several times
    #[arg(long, value_name = "ENTITY.COMPONENT.FIELD=VALUE")]
    pub set: Vec<String>,
}

#[derive(Args, Clone, Default)]
pub struct SamplingOptions {
    /// Rays through each pixel, such as 64 or 4k (default: what the scene says, or one through its centre; 16 where
    /// another of the options of sampling is given)
    #[arg(short = 'n', long, alias = "spp", value_name = "N", allow_hyphen_values = true, value_parser = samples)]
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
    /// How many workers render at most (default: RAYON_NUM_THREADS, or as many as the machine has cores)
    #[arg(short = 'j', long, value_name = "N", allow_hyphen_values = true, value_parser = workers)]
    pub threads: Option<u16>,
    /// Where to write, ending in .png or .exr, or - for a PNG on standard output; may be given several times (default:
    /// both kinds, in out/)
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,
    /// How many bits of a PNG each of red, green and blue has: 8 or 16 (default: 8)
    #[arg(long, value_name = "BITS", value_parser = bits)]
    pub bits: Option<u8>,
    /// Whether that was chosen for the reader, who has named no file
    #[arg(skip)]
    pub output_is_chosen: bool,
    /// Take samples for so long, such as 500ms, 10s or 2m
    #[arg(long, value_name = "TIME", value_parser = span)]
    pub time: Option<Duration>,
    /// Run a naive method of the book in place of pinhole's, and write both pictures and their difference
    #[arg(long, value_name = "NAME", conflicts_with = "resume", value_parser = naive_method())]
    pub naive: Option<&'static NaiveMethod>,
    /// Render only a part of the image, such as 320,180,96,54: the first pixel from the left and from the top, then width
    /// and height, as Mitsuba's crop_offset and crop_size; an EXR says where in the image it is
    #[arg(long, value_name = "X,Y,WIDTH,HEIGHT", allow_hyphen_values = true, conflicts_with = "naive", value_parser = crop)]
    pub crop: Option<Tile>,
    /// Smooth the picture along its surfaces, the less the more samples there are; the EXR keeps the unsmoothed one beside
    /// it, as the layer noisy, and the layers that guide the filter
    #[arg(long, conflicts_with_all = ["view", "naive"])]
    pub denoise: bool,
    /// Whose names the EXR's channels have, so that other programs find them: pinhole, blender, pbrt or oidn
    #[arg(long, value_name = "WORD", default_value = "pinhole", hide_default_value = true,
          value_parser = |word: &str| one_of(word, "way to name layers", &LayerNames::ALL))]
    pub layer_names: LayerNames,
    /// Continue from the checkpoint beside the picture, to the same bits as if it had not been stopped
    #[arg(long)]
    pub resume: bool,
    /// Write the picture and its checkpoint this often while samples are taken (default: for 5 % of the time at most)
    #[arg(long, value_name = "TIME", value_parser = span)]
    pub write_every: Option<Duration>,
    /// Compute one part of the picture, such as 3/64, and leave it in a file beside the picture, for `merge`
    #[arg(long, value_name = "I/N", conflicts_with_all = ["time", "naive"], value_parser = part)]
    pub part: Option<[u32; 2]>,
    /// How the picture is divided into parts: by tiles, samples, both, or as chosen for the number of parts
    #[arg(long, value_name = "WORD", requires = "part", value_parser = |word: &str| one_of(word, "split", &Split::ALL))]
    pub split: Option<Split>,
    /// Render these frames of a film, such as 0..47, both ends included: by the keys of a scene file or a model's animation
    #[arg(long, value_name = "A..B", conflicts_with_all = ["time", "naive", "openjd", "split"], value_parser = frames)]
    pub frames: Option<[u32; 2]>,
    /// How many frames a unit of time has, which is a second in models
    #[arg(long, value_name = "N", default_value_t = 24.0, hide_default_value = true, value_parser = rate)]
    pub fps: f64,
    /// At how many moments a frame is rendered, each with its part of the samples, where something changes while the shutter
    /// is open that does not just move along a straight line: 1 leaves that blur out (default: 16)
    #[arg(long, value_name = "N", requires = "frames", default_value_t = MOMENTS, hide_default_value = true,
          allow_hyphen_values = true, value_parser = moments)]
    pub moments: u32,
    /// The one of them that this picture is, which leaves a mark when it is done
    #[arg(skip)]
    pub frame: Option<u32>,
    /// With --part, print how far it is in the words that Open Job Description reads
    #[arg(long, requires = "part")]
    pub openjd: bool,
    /// The older form of --format json
    #[arg(long, hide = true, conflicts_with_all = ["quiet", "verbose"])]
    pub stats: bool,
    /// Print what every stage took, and why the others were left out
    #[arg(short, long, conflicts_with = "quiet")]
    pub verbose: bool,
    /// Print nothing but where the picture is and what to beware of, and take no times
    #[arg(short, long)]
    pub quiet: bool,
    /// Trace no test rays before rendering, which would warn of a picture that is black, clipped or slow
    #[arg(long)]
    pub no_preflight: bool,
}

impl SceneOptions {
    pub fn asked(&self, statistics: bool) -> Overrides {
        Overrides {
            resolution: None,
            size: self.pixels(),
            view: self.view.clone(),
            statistics,
            sampling: self.sampling.asked(),
            endless: false,
            error: self.error,
            layers: self.layers.clone(),
            exposure: self.exposure,
            tone_mapping: self.tone_map,
        }
    }
}

impl SceneOptions {
    fn pixels(&self) -> Option<Size> {
        match (self.width, self.height) {
            (Some(width), Some(height)) => Some(Size::Pixels(Resolution { width, height })),
            (Some(width), None) => Some(Size::Width(width)),
            (None, Some(height)) => Some(Size::Height(height)),
            (None, None) => self.size,
        }
    }

    /// Whether another number of pixels is asked for.
    pub fn sets_resolution(&self) -> bool {
        self.pixels().is_some()
    }

    /// What to type for the same number of pixels.
    pub fn typed_size(&self) -> String {
        match self.pixels() {
            None => String::new(),
            Some(Size::Pixels(Resolution { width, height })) => format!(" --size {width}x{height}"),
            Some(Size::Width(width)) => format!(" --width {width}"),
            Some(Size::Height(height)) => format!(" --height {height}"),
            Some(Size::Percent(percent)) => format!(" --size {percent}%"),
        }
    }

    /// What to type so that another command has the same stages to plan.
    pub fn typed(&self) -> String {
        let SamplingOptions { samples, seed, sampler, filter } = self.sampling;
        let sampler = sampler.and_then(|own| word_of(own, &Sampler::ALL));
        let filter = filter.and_then(|own| word_of(own, &Filter::ALL));
        let layers = self.layers.as_ref().map(|layers| {
            let words: Vec<&str> = layers.kinds.iter().map(|kind| kind.word()).collect();
            words.join(",")
        });
        [
            ("view", self.view.as_deref().map(quoted)),
            ("samples", samples.map(|samples| samples.to_string())),
            ("seed", seed.map(|seed| seed.to_string())),
            ("sampler", sampler.map(String::from)),
            ("filter", filter.map(String::from)),
            ("error", self.error.map(|error| error.to_string())),
            ("layers", layers),
            ("exposure", self.exposure.map(typed_exposure)),
            ("tone-map", self.tone_map.and_then(|own| word_of(own, &ToneMapping::ALL)).map(String::from)),
        ]
        .into_iter()
        .filter_map(|(name, value)| Some(format!(" --{name} {}", value?)))
        .chain([self.typed_settings()])
        .collect()
    }

    /// What to type so that another command sees the same scene.
    pub fn typed_settings(&self) -> String {
        self.set.iter().map(|setting| format!(" --set {}", quoted(setting))).collect()
    }
}

impl RenderOptions {
    /// The part that is asked for, or the whole as one.
    pub fn part(&self) -> Part {
        let [number, of] = self.part.unwrap_or([1, 1]);
        Part { number, of, split: self.split.unwrap_or_default() }
    }

    pub fn asked(&self, statistics: bool) -> Overrides {
        Overrides { endless: self.time.is_some(), ..self.scene.asked(statistics) }
    }
}

impl SamplingOptions {
    pub fn asked(&self) -> SamplingOverrides {
        SamplingOverrides { samples: self.samples, seed: self.seed, sampler: self.sampler, filter: self.filter }
    }
}

/// How the help is coloured, as cargo's is.
pub const STYLES: Styles = Styles::styled()
    .header(AnsiColor::Green.on_default().bold())
    .usage(AnsiColor::Green.on_default().bold())
    .literal(AnsiColor::Cyan.on_default().bold())
    .placeholder(AnsiColor::Cyan.on_default());

pub fn resolution(text: &str) -> Result<Resolution, String> {
    pixels(text).ok_or("a size is two whole numbers of pixels with an x between, such as 960x540".into())
}

/// A size as it is typed: `960x540`, `1080p`, `960` for a width, `50%`.
pub fn size(text: &str) -> Result<Size, String> {
    let refused = || {
        "a size is two whole numbers of pixels with an x between, such as 960x540; 1080p; a width alone, such as 960; or \
         a part, such as 50%"
    };
    let text = text.trim();
    if let Some(part) = text.strip_suffix('%') {
        let percent = part.trim_end().parse().ok().filter(|percent| *percent > 0.0 && *percent <= 1e6);
        return percent.map(Size::Percent).ok_or(refused().into());
    }
    if let Some(height) = text.strip_suffix(['p', 'P']).and_then(|height| height.parse::<u32>().ok()) {
        let width = (f64::from(height) * 16.0 / 9.0).round() as u32;
        return Ok(Size::Pixels(Resolution { width, height }));
    }
    let alone = || text.parse().ok().map(Size::Width);
    pixels(text).map(Size::Pixels).or_else(alone).ok_or(refused().into())
}

/// The naive methods by name, each with what it does.
fn naive_method() -> impl TypedValueParser<Value = &'static NaiveMethod> {
    let known = METHODS.iter().map(|method| PossibleValue::new(method.name).help(method.about));
    PossibleValuesParser::new(known).try_map(|name| METHODS.iter().find(|method| method.name == name).ok_or("unknown"))
}

fn side(text: &str) -> Result<u32, String> {
    text.trim().parse().map_err(|_| "a side of an image is a whole number of pixels, such as 960".into())
}

fn pixels(text: &str) -> Option<Resolution> {
    let (width, height) = ['x', 'X', '×'].into_iter().find_map(|between| pair(text, between))?;
    Some(Resolution { width, height })
}

pub fn pixel(text: &str) -> Result<TracePixel, String> {
    let (x, y) = pair(text, ',').ok_or("a pixel is two whole numbers with a comma between, such as 48,27")?;
    Ok(TracePixel { x, y })
}

/// A part of an image.
fn crop(text: &str) -> Result<Tile, String> {
    let numbers: Option<Vec<u32>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[x, y, width, height]) => Ok(Tile { x, y, width, height }),
        _ => Err("a part is four whole numbers of pixels with commas between, such as 320,180,96,54".into()),
    }
}

pub fn workers(text: &str) -> Result<u16, String> {
    let number = text.trim().parse().ok().filter(|number| (1..=1024).contains(number));
    number.ok_or("a number of workers is a whole number from 1 to 1024".into())
}

/// A number of samples as it is typed: `64`, `4k` for 4000, or `1e3`.
pub fn samples(text: &str) -> Result<u32, String> {
    let text = text.trim();
    let number = match text.strip_suffix(['k', 'K']) {
        Some(thousands) => thousands.parse::<f64>().map(|thousands| thousands * 1e3),
        None => text.parse(),
    };
    let range = 1.0..=f64::from(MAX_SAMPLES);
    let number = number.ok().filter(|number| range.contains(number) && number.fract() == 0.0);
    let refused = || format!("a number of samples is a whole number from 1 to {MAX_SAMPLES}, such as 64 or 4k");
    number.map(|number| number as u32).ok_or_else(refused)
}

/// Which part of how many, such as `3/64`.
fn part(text: &str) -> Result<[u32; 2], String> {
    let numbers = text.split_once('/').map(|(number, of)| (number.trim().parse(), of.trim().parse()));
    match numbers {
        Some((Ok(number), Ok(of))) if number >= 1 && number <= of && of <= MAX_PARTS => Ok([number, of]),
        _ => Err(format!("a part is its number and how many there are, such as 3/64, up to {MAX_PARTS}")),
    }
}

/// The first and the last of some frames, such as `0..47`.
fn frames(text: &str) -> Result<[u32; 2], String> {
    let numbers =
        text.split_once("..").map(|(first, last)| (first.trim().parse(), last.trim_start_matches('=').trim().parse()));
    match numbers {
        Some((Ok(first), Ok(last))) if first <= last && last <= MAX_FRAME => Ok([first, last]),
        _ => Err(format!("frames are the first and the last with .. between, such as 0..47, up to {MAX_FRAME}")),
    }
}

fn moments(text: &str) -> Result<u32, String> {
    let number = text.trim().parse().ok().filter(|number| (1..=MAX_SAMPLES).contains(number));
    number.ok_or(format!("a number of moments is a whole number from 1 to {MAX_SAMPLES}, such as 16"))
}

fn rate(text: &str) -> Result<f64, String> {
    let rate = text.trim().parse::<f64>().ok().filter(|rate| *rate > 0.0 && *rate <= 1e6);
    rate.ok_or("a number of frames in a unit of time is above 0 and at most 1000000, such as 24".into())
}

fn error(text: &str) -> Result<f64, String> {
    text.trim().parse().map_err(|_| "an error is a number above 0 and at most 1, such as 0.01".into())
}

/// An exposure as it is typed: `1.5`, `-2`, `auto`, `auto+1`.
fn exposure(text: &str) -> Result<Exposure, String> {
    let (automatic, stops) = match text.trim().strip_prefix("auto") {
        Some("") => return Ok(Exposure { stops: 0.0, automatic: true }),
        Some(beside) => (true, beside.starts_with(['+', '-']).then_some(beside)),
        None => (false, Some(text.trim())),
    };
    let stops = stops.and_then(|stops| stops.parse().ok());
    let refused = "an exposure is a number of stops, such as 1.5 or -2, or auto, or both, such as auto+1";
    stops.map(|stops| Exposure { stops, automatic }).ok_or(refused.into())
}

fn typed_exposure(Exposure { stops, automatic }: Exposure) -> String {
    match (automatic, stops) {
        (true, 0.0) => "auto".into(),
        (true, stops) => format!("auto{stops:+}"),
        (false, stops) => stops.to_string(),
    }
}

fn bits(text: &str) -> Result<u8, String> {
    text.trim().parse().ok().filter(|bits| [8, 16].contains(bits)).ok_or("a PNG has 8 bits or 16".into())
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

fn word_of<T: PartialEq>(value: T, all: &[(&'static str, T)]) -> Option<&'static str> {
    all.iter().find(|(_, own)| *own == value).map(|(word, _)| *word)
}

fn pair(text: &str, between: char) -> Option<(u32, u32)> {
    let (first, second) = text.split_once(between)?;
    Some((first.trim().parse().ok()?, second.trim().parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_size_is_what_a_person_types() {
        let own = Resolution { width: 480, height: 270 };
        let of = |text: &str| size(text).map(|size| size.of(own)).map(|own| [own.width, own.height]);
        for (text, expected) in [
            ("960x540", [960, 540]),
            ("1920×1080", [1920, 1080]),
            ("1920 × 1080", [1920, 1080]),
            ("8X4", [8, 4]),
            ("1080p", [1920, 1080]),
            ("96", [96, 54]),
            ("50%", [240, 135]),
            ("0.001 %", [1, 1]),
            ("200%", [960, 540]),
            ("0x5", [0, 5]),
        ] {
            assert_eq!(of(text), Ok(expected), "{text}");
        }
        for bad in ["", "x", "960x", "-1x5", "1.5x5", "99999999999x5", "0%", "-5%", "NaN%", "%", "p", "wide", "1e9%"] {
            assert!(size(bad).is_err(), "{bad}");
        }
        assert_eq!(Size::Height(54).of(own), Resolution { width: 96, height: 54 });
        assert_eq!(Size::Width(1).of(Resolution { width: 0, height: 0 }), Resolution { width: 1, height: 1 });
    }

    #[test]
    fn an_exposure_is_typed_back_as_it_was_typed() {
        for (text, stops, automatic) in [
            ("1.5", 1.5, false),
            ("-2", -2.0, false),
            ("auto", 0.0, true),
            ("auto+1", 1.0, true),
            ("auto-0.5", -0.5, true),
        ] {
            assert_eq!(exposure(text), Ok(Exposure { stops, automatic }), "{text}");
            assert_eq!(typed_exposure(Exposure { stops, automatic }), text);
        }
        for bad in ["", "bright", "autofocus", "auto1", "auto+", "1 stop", "+-1"] {
            assert!(exposure(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn a_crop_is_four_numbers() {
        assert_eq!(crop("13, 7,40,30"), Ok(Tile { x: 13, y: 7, width: 40, height: 30 }));
        for bad in ["", "1,2,3", "1,2,3,4,5", "-1,2,3,4", "1,2,3.5,4", "1x2+3+4", "a,b,c,d"] {
            assert!(crop(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn a_number_of_samples_may_be_told_in_thousands() {
        assert_eq!(["1", "64", "1k", "4K", "1e3", "0.5k"].map(samples), [1, 64, 1000, 4000, 1000, 500].map(Ok));
        for bad in ["0", "-1", "1.5", "k", "NaN", "inf", "1e30", "many", "1.0005k"] {
            assert!(samples(bad).is_err(), "{bad}");
        }
    }
}
