//! Scene files, images and checkpoints that were damaged at random, given to the program's own commands.

use super::fuzz;
use cpu_time::ProcessTime;
use fuzz::Dice;
use image::{DynamicImage, ImageBuffer, ImageFormat, Rgb};
use pinhole::render::peak_memory;
use pinhole_cli::command;
use std::fmt;
use std::fs;
use std::io::Cursor;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// A command that takes more of the processor is slow.
const SLOW: Duration = Duration::from_secs(2);
/// A command that holds more memory at once is large, in bytes.
const LARGE: u64 = 1 << 30;

/// What is damaged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Scene,
    Texture,
    Compared,
    Checkpoint,
}

/// Whole files, to be damaged in copies.
pub struct Bases {
    folder: PathBuf,
    scenes: Vec<String>,
    images: Vec<(&'static str, Vec<u8>)>,
    checkpoint: Vec<u8>,
    chapters: Vec<pinhole::Chapter>,
}

/// How many commands ran, how they ended, and what must not have happened.
#[derive(Default)]
pub struct Counts {
    files: u64,
    commands: u64,
    refused: u64,
    /// Commands that did what they were asked, by what was damaged: scene, texture, compared image, checkpoint.
    pub done: [u64; 4],
    pub panics: Vec<String>,
    pub slow: Vec<String>,
    pub large: Vec<String>,
    slowest: Duration,
    largest: u64,
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} files, {} commands, {} of them refused, {:?} done by kind; {} panics {:?}, {} over {SLOW:?} {:?}, {} over 1 GiB {:?}; the slowest \
             took {:?} of the processor, the largest {} MiB",
            self.files,
            self.commands,
            self.refused,
            self.done,
            self.panics.len(),
            self.panics,
            self.slow.len(),
            self.slow,
            self.large.len(),
            self.large,
            self.slowest,
            self.largest >> 20
        )
    }
}

impl Counts {
    /// Whether nothing happened that must not.
    pub fn hold(&self) -> bool {
        self.panics.is_empty() && self.slow.is_empty() && self.large.is_empty()
    }
}

impl Bases {
    /// Exported chapters, images of every format that is read, and a checkpoint; all in a folder that is there.
    pub fn in_folder(folder: &Path) -> Self {
        let mut bases = Self {
            folder: folder.into(),
            scenes: fuzz::bases(),
            images: images(),
            checkpoint: Vec::new(),
            chapters: chapters::all(),
        };
        for (name, bytes) in &bases.images {
            fs::write(bases.folder.join(name), bytes).expect("written");
        }
        fs::write(bases.folder.join("sampled.ron"), SAMPLED).expect("written");
        let words = bases.render("sampled.ron", &["--write-every", "1ms"]);
        bases.run(&words).expect("the undamaged scene renders");
        bases.checkpoint = fs::read(bases.folder.join("out.checkpoint")).expect("a checkpoint");
        bases
    }

    fn path(&self, name: &str) -> String {
        self.folder.join(name).display().to_string()
    }

    fn render(&self, scene: &str, more: &[&str]) -> Vec<String> {
        let (scene, out) = (self.path(scene), self.path("out.exr"));
        let mut words: Vec<String> = ["render", &scene, "--size", "16x9", "-q", "-o", &out].map(String::from).into();
        words.extend(more.iter().map(|&word| word.into()));
        words
    }

    fn run(&self, words: &[String]) -> command::Result {
        command::run_with_notes(&self.chapters, words, &mut std::io::sink(), &mut std::io::sink())
    }

    /// Damages a file as this seed says and gives it to every command that reads its kind.
    pub fn try_seed(&self, seed: u64, counts: &mut Counts) {
        let mut dice = Dice(seed ^ 0x5EED);
        let (kind, commands) = match seed % 8 {
            0..=3 => (Kind::Scene, self.damage_scene(seed)),
            4 => (Kind::Texture, self.damage_texture(&mut dice)),
            5 | 6 => (Kind::Compared, self.damage_compared(&mut dice)),
            _ => (Kind::Checkpoint, self.damage_checkpoint(&mut dice)),
        };
        counts.files += 1;
        for words in commands {
            self.try_command(&format!("{seed} {kind:?} {}", words[0]), kind, &words, counts);
        }
    }

    fn try_command(&self, what: &str, kind: Kind, words: &[String], counts: &mut Counts) {
        forget_peak();
        let started = ProcessTime::now();
        let ended = catch_unwind(AssertUnwindSafe(|| self.run(words)));
        let (time, memory) = (started.elapsed(), peak_memory().unwrap_or(0));
        counts.commands += 1;
        match ended {
            Err(_) => counts.panics.push(what.into()),
            Ok(Err(refused)) => {
                counts.refused += 1;
                let told = refused.to_string();
                assert!(!told.is_empty() && told.chars().count() <= 2200, "{what}: {told}");
                assert!(!told.chars().any(|letter| letter.is_control() && letter != '\n'), "{what}: {told:?}");
            }
            Ok(Ok(())) => counts.done[kind as usize] += 1,
        }
        if time > SLOW {
            counts.slow.push(format!("{what} {time:?}"));
        }
        if memory > LARGE {
            counts.large.push(format!("{what} {} MiB", memory >> 20));
        }
        counts.slowest = counts.slowest.max(time);
        counts.largest = counts.largest.max(memory);
    }

    fn damage_scene(&self, seed: u64) -> Vec<Vec<String>> {
        fs::write(self.folder.join("damaged.ron"), fuzz::case(&self.scenes, seed)).expect("written");
        let scene = self.path("damaged.ron");
        let words = |words: &[&str]| -> Vec<String> { words.iter().map(|&word| word.into()).collect() };
        vec![
            words(&["plan", &scene]),
            self.render("damaged.ron", &["--samples", "1", "--time", "1s"]),
            words(&["trace", &scene, "--size", "16x9", "--pixel", "8,4"]),
            words(&["preflight", &scene, "--size", "16x9"]),
        ]
    }

    fn damage_texture(&self, dice: &mut Dice) -> Vec<Vec<String>> {
        let name = self.damage_image(dice);
        let scene = if dice.below(2) == 0 || name.ends_with("png") {
            format!(
                "[(perspective_camera: (), placement: (position: (0, 0, 4))), (sphere: (), matte: (), image_texture: \
                 (file: \"{name}\")), (point_light: (), placement: (position: (2, 3, 4)))]"
            )
        } else {
            format!("[(perspective_camera: (), placement: (position: (0, 0, 4))), (environment: (file: \"{name}\"))]")
        };
        fs::write(self.folder.join("textured.ron"), scene).expect("written");
        vec![self.render("textured.ron", &[])]
    }

    fn damage_compared(&self, dice: &mut Dice) -> Vec<Vec<String>> {
        let name = self.damage_image(dice);
        let whole = if name.ends_with("png") { self.images[0].0 } else { "scan.exr" };
        let (damaged, whole) = (self.path(&name), self.path(whole));
        vec![vec!["compare".into(), whole, damaged]]
    }

    fn damage_checkpoint(&self, dice: &mut Dice) -> Vec<Vec<String>> {
        let mut bytes = self.checkpoint.clone();
        damage(dice, &mut bytes);
        if dice.below(4) > 0 {
            mend_checkpoint(&mut bytes);
        }
        fs::write(self.folder.join("out.checkpoint"), bytes).expect("written");
        vec![self.render("sampled.ron", &["--resume"])]
    }

    /// Writes a damaged copy of one of the images, and says what it is called.
    fn damage_image(&self, dice: &mut Dice) -> String {
        let (name, whole) = &self.images[dice.below(self.images.len())];
        let mut bytes = whole.clone();
        damage(dice, &mut bytes);
        if name.ends_with("png") && dice.below(4) > 0 {
            mend_sums(&mut bytes);
        }
        let ending = name.rsplit('.').next().unwrap_or(name);
        let name = format!("damaged.{ending}");
        fs::write(self.folder.join(&name), bytes).expect("written");
        name
    }
}

/// Four samples a pixel, so that there is something to keep.
const SAMPLED: &str = "[(perspective_camera: (), sampling: (samples: 4), placement: (position: (0, 0, 4))), \
    (sphere: (), matte: ()), (point_light: (), placement: (position: (2, 3, 4)))]";

/// From here on the most memory that the process holds is counted anew, where the system can do that.
fn forget_peak() {
    let _ = fs::write("/proc/self/clear_refs", "5");
}

/// An image of each kind that is read: PNG of 8 and 16 bits, HDR, EXR of scan lines and of tiles.
fn images() -> Vec<(&'static str, Vec<u8>)> {
    let [width, height] = [24, 16];
    let shade = |x: u32, y: u32| [x as f32 / width as f32, y as f32 / height as f32, 0.3];
    let light = ImageBuffer::from_fn(width, height, |x, y| Rgb(shade(x, y)));
    let deep = ImageBuffer::from_fn(width, height, |x, y| Rgb(shade(x, y).map(|part| (part * 65_535.0) as u16)));
    let plain = ImageBuffer::from_fn(width, height, |x, y| Rgb(shade(x, y).map(|part| (part * 255.0) as u8)));
    let encoded = |image: DynamicImage, format| {
        let mut bytes = Cursor::new(Vec::new());
        image.write_to(&mut bytes, format).expect("encodes");
        bytes.into_inner()
    };
    let exr = |encoding: exr::prelude::Encoding| {
        use exr::prelude::{Image, SpecificChannels, WritableImage};
        let channels = SpecificChannels::rgb(|at: exr::prelude::Vec2<usize>| {
            let [r, g, b] = shade(at.0 as u32, at.1 as u32);
            (r, g, b)
        });
        let size = (width as usize, height as usize);
        let attributes = exr::prelude::LayerAttributes::named("light");
        let image = Image::from_layer(exr::prelude::Layer::new(size, attributes, encoding, channels));
        let mut bytes = Cursor::new(Vec::new());
        image.write().non_parallel().to_buffered(&mut bytes).expect("encodes");
        bytes.into_inner()
    };
    use exr::prelude::Encoding;
    vec![
        ("plain.png", encoded(plain.into(), ImageFormat::Png)),
        ("deep.png", encoded(deep.into(), ImageFormat::Png)),
        ("light.hdr", encoded(light.into(), ImageFormat::Hdr)),
        ("scan.exr", exr(Encoding::FAST_LOSSLESS)),
        ("zip.exr", exr(Encoding::SMALL_LOSSLESS)),
        ("piz.exr", exr(Encoding::SMALL_FAST_LOSSLESS)),
        ("plain.exr", exr(Encoding::UNCOMPRESSED)),
    ]
}

/// Damages a file in up to three places; some stay whole, so that what was damaged before is told from what is always
/// refused.
fn damage(dice: &mut Dice, bytes: &mut Vec<u8>) {
    for _ in 0..dice.below(8).min(dice.below(4)) {
        // Headers are short, and most of what can go wrong stands in them.
        let within = if dice.below(3) == 0 { bytes.len().min(400) } else { bytes.len() };
        let at = dice.below(within + 1);
        let end = (at + dice.below(24)).min(bytes.len());
        let number =
            [0, 1, u32::MAX, i32::MAX as u32, 0x8000_0000, 0x4000_0000, 65_536, dice.roll() as u32][dice.below(8)];
        let number = if dice.below(2) == 0 { number.to_le_bytes() } else { number.to_be_bytes() };
        match dice.below(8) {
            0 => bytes.truncate(at),
            1 => drop(bytes.drain(at..end)),
            2 => {
                let part = bytes[at..end].to_vec();
                let to = dice.below(bytes.len() + 1);
                bytes.splice(to..to, part);
            }
            3 | 4 if at + 4 <= bytes.len() => bytes[at..at + 4].copy_from_slice(&number),
            5 if at < bytes.len() => bytes[at] = dice.roll() as u8,
            6 => bytes.extend((0..dice.below(64)).map(|_| dice.roll() as u8)),
            _ if at < bytes.len() => bytes[at] ^= 1 << dice.below(8),
            _ => {}
        }
    }
}

/// Gives a checkpoint the check sum at its end that it ought to have, so that what stands in it is looked at.
fn mend_checkpoint(bytes: &mut [u8]) {
    const WORD: usize = 20;
    if let Some(end) = bytes.len().checked_sub(4).filter(|&end| end > WORD) {
        let sum = crc32fast::hash(&bytes[WORD..end]);
        bytes[end..].copy_from_slice(&sum.to_le_bytes());
    }
}

/// Gives the chunks of a PNG the check sums that they ought to have, so that what stands in them is read.
fn mend_sums(png: &mut [u8]) {
    let mut at = 8;
    while let Some(head) = png.get(at..at + 4) {
        let length = u32::from_be_bytes([head[0], head[1], head[2], head[3]]) as usize;
        let Some(end) = at.checked_add(8).and_then(|start| start.checked_add(length)) else { return };
        if end + 4 > png.len() {
            return;
        }
        let sum = crc32fast::hash(&png[at + 4..end]);
        png[end..end + 4].copy_from_slice(&sum.to_be_bytes());
        at = end + 4;
    }
}
