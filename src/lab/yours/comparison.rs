//! Whether a picture of bytes shows what another one of light shows, block by block.

use super::scene::{picture_of, scene_after, variants};
use pinhole::Error;
use pinhole::film::{Film, srgb_from_linear};
use pinhole::scene::Sampling;

/// The sides of a block, in pixels.
const BLOCK: [usize; 2] = [16, 10];
/// Standard errors beyond which a block differs: of 2,430 numbers, noise brings one there once in a million pictures.
const SIGNIFICANT: f64 = 6.5;
/// What rounding to bytes, and edges that f32 and f64 see a hair apart, may change in the mean of a block, in bytes.
const ROUNDING: f64 = 1.0;
/// Light that counts as none, where parts of it are told.
const DARK: f64 = 1e-3;

/// What is found of a picture.
#[derive(Clone, Debug, PartialEq)]
pub enum Comparison {
    /// It is the same.
    Same {
        /// The part of its light by which a block would have to differ to be told, for the block in the middle of all.
        resolved: f64,
    },
    /// It differs.
    Differs {
        /// In how many blocks.
        blocks: usize,
        /// Of how many.
        of: usize,
        /// By how much of the light, all in all: below 0 if it is too dark.
        brightness: f64,
        /// The middle of the block that differs most, in pixels from the upper left corner.
        most: [usize; 2],
        /// What it looks like, where that is known.
        looks_like: Option<&'static str>,
    },
}

/// The light of a picture, pixel by pixel from its upper left corner, none of it beyond white.
type Pixels = Vec<[f64; 3]>;

/// What becomes of the light where the bytes of a right picture are not written as they should be.
const BYTES: [(&str, fn(&Pixels, [usize; 2]) -> Pixels); 9] = [
    ("left and right are exchanged.", |own, [width, _]| {
        own.chunks(width).flat_map(|line| line.iter().rev().copied()).collect()
    }),
    ("it is upside down.", |own, [width, _]| own.chunks(width).rev().flatten().copied().collect()),
    ("it is turned by half a turn.", |own, _| own.iter().rev().copied().collect()),
    ("red and blue are exchanged.", |own, _| own.iter().map(|&[r, g, b]| [b, g, r]).collect()),
    ("everything is twice as bright, the sky, too: what is the sum divided by?", |own, _| {
        each(own, |light| 2.0 * light)
    }),
    ("everything is half as bright, the sky, too: what is the sum divided by?", |own, _| {
        each(own, |light| 0.5 * light)
    }),
    ("it is too wide: does x reach as far as y, whatever the picture's shape?", |own, [width, height]| {
        let from = |x: usize| {
            (width as f64 / 2.0 + (x as f64 + 0.5 - width as f64 / 2.0) * height as f64 / width as f64) as usize
        };
        (0..own.len()).map(|at| own[at / width * width + from(at % width)]).collect()
    }),
    ("the curve of the screen is missing.", |own, _| each(own, linear_from_srgb)),
    ("the curve of the screen is applied twice.", |own, _| each(own, srgb_from_linear)),
];

/// What becomes of each part of the light; beyond white there is none.
fn each(own: &Pixels, change: fn(f64) -> f64) -> Pixels {
    own.iter().map(|pixel| pixel.map(|light| change(light).min(1.0))).collect()
}

/// Compares the picture of a reader's program after a chapter with pinhole's of the same scene.
///
/// Errors: those of a render; a picture of another size, or for a chapter before the fifth.
pub fn compare_picture(chapter: u32, [width, height]: [usize; 2], bytes: &[[u8; 3]]) -> Result<Comparison, Error> {
    let right = picture_of(&scene_after(chapter))?;
    if [right.width as usize, right.height as usize] != [width, height] {
        let told =
            format!("the picture has {width} × {height} pixels, and pinhole's has {} × {}", right.width, right.height);
        return Err(Error::Usage(told));
    }
    let size = [width, height];
    // Before chapter 10 brings the curve of screens, the curve is a square root.
    let light = |byte: u8| {
        let part = f64::from(byte) / 255.0;
        if chapter < 10 { part * part } else { linear_from_srgb(part) }
    };
    let own: Pixels = bytes.iter().map(|pixel| pixel.map(light)).collect();
    let right = light_of(&right);
    let found = compared(&own, &right, size);
    let all = found.len();
    let apart: Vec<&Block> = found.iter().filter(|block| block.differs()).collect();
    let Some(most) = apart.iter().max_by(|a, b| a.off.total_cmp(&b.off)) else {
        let mut resolved: Vec<f64> = found.iter().map(|block| block.resolved).collect();
        resolved.sort_by(f64::total_cmp);
        return Ok(Comparison::Same { resolved: resolved[all / 2] });
    };
    let light = |pixels: &Pixels| pixels.iter().flatten().sum::<f64>();
    Ok(Comparison::Differs {
        blocks: apart.len(),
        of: all,
        brightness: light(&own) / light(&right) - 1.0,
        most: most.middle,
        looks_like: looks_like(chapter, &own, &right, size, apart.len())?,
    })
}

/// The mistake whose picture this is: the one that leaves the fewest blocks apart, if those are few.
fn looks_like(
    chapter: u32,
    own: &Pixels,
    right: &Pixels,
    size: [usize; 2],
    apart: usize,
) -> Result<Option<&'static str>, Error> {
    let left = |wrong: &Pixels| compared(own, wrong, size).iter().filter(|block| block.differs()).count();
    let mut best = (apart / 10, None);
    let mut keep = |what, left| {
        if left <= best.0 && (left < best.0 || best.1.is_none()) {
            best = (left, Some(what));
        }
    };
    for (what, change) in BYTES {
        keep(what, left(&change(right, size)));
    }
    // The same for the curve that is a square root.
    let roots: [fn(f64) -> f64; 2] = [|light| light * light, f64::sqrt];
    for ((what, _), change) in BYTES[BYTES.len() - 2..].iter().zip(roots).filter(|_| chapter < 10) {
        keep(what, left(&each(right, change)));
    }
    for variant in variants().into_iter().filter(|own| (own.from..own.until).contains(&chapter)) {
        let mut world = scene_after(chapter);
        (variant.change)(&mut world);
        // Enough to be told from the others.
        world.query::<&mut Sampling>().iter_mut(&mut world).for_each(|mut own| own.samples = own.samples.min(32));
        keep(variant.looks_like, left(&light_of(&picture_of(&world)?)));
    }
    Ok(best.1)
}

/// The light of a film.
fn light_of(film: &Film) -> Pixels {
    let place = |at: u32| film.mean(at % film.width, at / film.width);
    (0..film.width * film.height).map(|at| place(at).map(|light| f64::from(light).clamp(0.0, 1.0))).collect()
}

/// The light that a screen makes of a byte, both as parts of the whole.
fn linear_from_srgb(part: f64) -> f64 {
    if part <= 0.04045 { part / 12.92 } else { libm::pow((part + 0.055) / 1.055, 2.4) }
}

/// How far one block's mean is off in the worst of its three colours, in what it may be off.
struct Block {
    middle: [usize; 2],
    off: f64,
    resolved: f64,
}

impl Block {
    fn differs(&self) -> bool {
        self.off > 1.0
    }
}

/// Compares two pictures block by block; the scatter of the differences within a block is their noise.
fn compared(own: &Pixels, right: &Pixels, [width, height]: [usize; 2]) -> Vec<Block> {
    let mut blocks = Vec::new();
    for top in (0..height).step_by(BLOCK[1]) {
        for left in (0..width).step_by(BLOCK[0]) {
            let lines = top..(top + BLOCK[1]).min(height);
            let places: Vec<usize> =
                lines.flat_map(|y| (left..(left + BLOCK[0]).min(width)).map(move |x| y * width + x)).collect();
            let count = places.len() as f64;
            let mut block = Block { middle: [left + BLOCK[0] / 2, top + BLOCK[1] / 2], off: 0.0, resolved: 0.0 };
            for channel in 0..3 {
                let apart = |at: &usize| own[*at][channel] - right[*at][channel];
                let mean = places.iter().map(apart).sum::<f64>() / count;
                let squares = places.iter().map(|at| (apart(at) - mean) * (apart(at) - mean)).sum::<f64>();
                let light = places.iter().map(|at| right[*at][channel]).sum::<f64>() / count;
                // By how much a byte's step changes light of this strength.
                let step = linear_from_srgb(srgb_from_linear(light) + 1.0 / 255.0) - light;
                let allowed = ROUNDING * step + SIGNIFICANT * (squares / (count - 1.0) / count).sqrt();
                block.off = block.off.max(mean.abs() / allowed);
                block.resolved = block.resolved.max(allowed / light.max(DARK));
            }
            blocks.push(block);
        }
    }
    blocks
}
