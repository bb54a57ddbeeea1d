//! Whether a picture of bytes shows what another one of light shows, block by block.

use super::known::{Mistaken, Picture, few};
use super::scene::{SIZE, film_after, picture_of, sample_at_most, scene_after, variants};
use pinhole::Error;
use pinhole::extract::linear_from_srgb;
use pinhole::film::{Film, srgb_from_linear};
use std::cell::OnceCell;
use std::time::{Duration, Instant};

/// The sides of a block, in pixels.
const BLOCK: [usize; 2] = [16, 10];
/// Standard errors beyond which a number differs: with normal noise, one of the 2,430 of a picture does in one picture of
/// millions.
const SIGNIFICANT: f64 = 6.5;
/// What rounding to bytes, and edges that f32 and f64 see a hair apart, may change in the mean of a block, in bytes.
const ROUNDING: f64 = 1.0;
/// The shift of a picture that is told, in pixels.
const SHIFT: f64 = 0.1;
/// The part of the difference that a shift must explain where blocks differ: of an edge that is shifted by half a pixel, it
/// explains a quarter, for half of the pixels along it have changed altogether.
const EXPLAINED: f64 = 0.15;
/// The part of a block that noise makes white in one picture only, at most; there, light beyond white was lost, and nobody
/// knows how much.
const SPECKLED: f64 = 0.5;
/// How many small mistakes that make the same picture are told, at most.
const MANY: usize = 3;
/// The part of the pixels that differ that a mistake must make as they are.
const SAME: f64 = 0.97;
/// How much less that may be where two mistakes are taken to make the same picture.
const ALIKE: f64 = 2e-3;
/// Of how many mistakes that come nearest the whole picture is made.
const NEAR: usize = 12;
/// How long one may take.
const LATE: Duration = Duration::from_secs(30);
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
    /// It is the same but for its edges, which lie as if it were shifted.
    Shifted {
        /// To the right and downward, in pixels.
        by: [f64; 2],
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
        looks_like: Option<String>,
    },
}

/// The light of a picture, pixel by pixel from its upper left corner, none of it beyond white.
type Pixels = Vec<[f64; 3]>;

/// How light becomes a part of 255, and how it comes back.
struct Curve {
    part_from_light: fn(f64) -> f64,
    light_from_part: fn(f64) -> f64,
}

impl Curve {
    /// That of the program: before chapter 10 brings the curve of screens, it is a square root.
    fn after(chapter: u32) -> Self {
        match chapter {
            ..10 => Self { part_from_light: f64::sqrt, light_from_part: |part| part * part },
            10.. => Self { part_from_light: srgb_from_linear, light_from_part: linear_from_srgb },
        }
    }
}

/// What becomes of a right picture that is written in another way than it should be, and what that looks like.
const REWRITTEN: [(&str, fn(&Pixels, &Curve) -> Pixels); 9] = [
    ("left and right are exchanged.", |right, _| {
        right.chunks(SIZE[0]).flat_map(|line| line.iter().rev().copied()).collect()
    }),
    ("it is upside down.", |right, _| right.chunks(SIZE[0]).rev().flatten().copied().collect()),
    ("it is turned by half a turn.", |right, _| right.iter().rev().copied().collect()),
    ("red and blue are exchanged.", |right, _| right.iter().map(|&[r, g, b]| [b, g, r]).collect()),
    ("everything is twice as bright, the sky, too: what is the sum divided by?", |right, _| {
        each(right, |light| 2.0 * light)
    }),
    ("everything is half as bright, the sky, too: what is the sum divided by?", |right, _| {
        each(right, |light| 0.5 * light)
    }),
    ("it is too wide: does x reach as far as y, whatever the picture's shape?", |right, _| {
        let [width, height] = SIZE.map(|side| side as f64);
        let from = |x: usize| (width / 2.0 + (x as f64 + 0.5 - width / 2.0) * height / width) as usize;
        (0..right.len()).map(|at| right[at / SIZE[0] * SIZE[0] + from(at % SIZE[0])]).collect()
    }),
    ("the curve of the screen is missing.", |right, curve| each(right, curve.light_from_part)),
    ("the curve of the screen is applied twice.", |right, curve| each(right, curve.part_from_light)),
];

/// What becomes of each part of the light; beyond white there is none.
fn each(pixels: &Pixels, change: fn(f64) -> f64) -> Pixels {
    pixels.iter().map(|pixel| pixel.map(|light| change(light).min(1.0))).collect()
}

/// pinhole's picture of the scene that a reader's program shows after a chapter, and those of mistakes, each made when it
/// is first asked for.
pub struct Expected {
    chapter: u32,
    curve: Curve,
    right: Pixels,
    rewritten_or_changed: OnceCell<Vec<LooksLike>>,
    mistaken: OnceCell<Option<Tried>>,
}

/// What is said of mistakes that make a picture, and in how many other lines there are such.
type Made = Option<(String, usize)>;

/// What a picture looks like, the picture, and in how many blocks it is not as the right one.
type LooksLike = (String, Pixels, usize);

/// The mistakes that were put into the program: they, how few of the pixels were rendered, the right program's picture of
/// those, and that of each mistake.
struct Tried {
    mistaken: Mistaken,
    every: usize,
    right: Picture,
    pictures: Vec<(usize, Picture)>,
}

impl Tried {
    fn after(chapter: u32) -> Option<Self> {
        let mistaken = Mistaken::after(chapter)?;
        // One pixel of so many in both directions; its random numbers are its own, so that it is as in the whole picture.
        let every = match chapter {
            ..17 | 33.. => 4,
            28..30 => 24,
            30.. => 12,
            _ => 8,
        };
        let began = Instant::now();
        let right = mistaken.right(every)?;
        // Some mistakes make it slow, and with some it never ends.
        let patience = 8 * began.elapsed() + Duration::from_millis(200);
        let all: Vec<usize> = (0..mistaken.told.len()).collect();
        let pictures = mistaken.pictures(&all, every, patience);
        Some(Self { mistaken, every, right, pictures })
    }
}

/// Of the pixels in which one of two pictures is not as the right one, the part in which they are the same.
fn agreement((_, one): &Picture, (_, other): &Picture, (_, right): &Picture) -> f64 {
    let is_apart = |one: [u8; 3], other: [u8; 3]| (0..3).any(|part| one[part].abs_diff(other[part]) > 1);
    let (mut spoken, mut same) = (0, 0);
    for ((one, other), right) in one.iter().zip(other).zip(right) {
        if one != right && is_apart(*one, *right) || other != right && is_apart(*other, *right) {
            spoken += 1;
            same += u32::from(one == other || !is_apart(*one, *other));
        }
    }
    f64::from(same) / f64::from(spoken.max(1))
}

impl Expected {
    /// The picture after a chapter.
    ///
    /// Errors: those of a render.
    pub fn after(chapter: u32) -> Result<Self, Error> {
        let right = light_of(&film_after(chapter, u32::MAX)?);
        let (rewritten_or_changed, mistaken) = <(OnceCell<_>, OnceCell<_>)>::default();
        Ok(Self { chapter, curve: Curve::after(chapter), right, rewritten_or_changed, mistaken })
    }

    /// Compares the picture that a reader's program wrote; `waits` is called before known mistakes are made in the program,
    /// which takes a while.
    ///
    /// Errors: a picture of another size; those of a render.
    pub fn compare(&self, picture: &Picture, waits: &mut dyn FnMut()) -> Result<Comparison, Error> {
        let ([width, height], bytes) = picture;
        if [*width, *height] != SIZE {
            let told =
                format!("the picture has {width} × {height} pixels, and pinhole's has {} × {}", SIZE[0], SIZE[1]);
            return Err(Error::Usage(told));
        }
        let (readers, right) = (pixels_of(bytes, &self.curve), &self.right);
        let found = blocks(&readers, right, &self.curve);
        let apart: Vec<&Block> = found.iter().filter(|block| block.differs()).collect();
        let Some(most) = apart.iter().max_by(|a, b| a.off.total_cmp(&b.off)) else {
            let mut resolved: Vec<f64> = found.iter().map(|block| block.resolved).collect();
            resolved.sort_by(f64::total_cmp);
            let same = Comparison::Same { resolved: resolved[resolved.len() / 2] };
            return Ok(shift(&readers, right, 0.0).map_or(same, |by| Comparison::Shifted { by }));
        };
        waits();
        let looks_like = match self.made(picture) {
            Some((told, 0)) => Some(told),
            // What everything looks like says more than one of many lines.
            made => {
                let of_all = self.closest(&readers, apart.len(), self.rewritten_or_changed()?);
                let brighter = [self.brighter(&readers)];
                let brighter = self.closest(&readers, apart.len(), &brighter);
                let likest = [of_all, brighter].into_iter().flatten().min_by_key(|found| found.0);
                let likest = likest.and_then(|(left, all)| Some((left, (*all.first()?).to_owned())));
                let is_exact = |likest: &Option<(usize, String)>| likest.as_ref().is_some_and(|(left, _)| *left == 0);
                let near =
                    if made.is_some() || is_exact(&likest) { None } else { self.near(picture, &readers, apart.len()) };
                let likest = [likest, near].into_iter().flatten().min_by_key(|found| found.0);
                likest.map(|found| found.1).or(made.map(|(told, _)| told))
            }
        };
        if looks_like.is_none()
            && let Some(by) = shift(&readers, right, EXPLAINED)
        {
            return Ok(Comparison::Shifted { by });
        }
        let light = |pixels: &Pixels| pixels.iter().flatten().sum::<f64>();
        let brightness = light(&readers) / light(right) - 1.0;
        Ok(Comparison::Differs { blocks: apart.len(), of: found.len(), brightness, most: most.middle, looks_like })
    }

    /// The mistakes that were put into the program, once.
    fn tried(&self) -> Option<&Tried> {
        self.mistaken.get_or_init(|| Tried::after(self.chapter)).as_ref()
    }

    /// What is said of the mistakes in the program that make this very picture, as those with the same random numbers do.
    fn made(&self, picture: &Picture) -> Made {
        let Tried { mistaken, every, right, pictures } = self.tried()?;
        let agreeing = |pictures: &[(usize, Picture)], every: usize, right: &Picture, least: f64| {
            let readers = few(picture, every);
            let those = pictures.iter().filter(|(_, own)| own.0 == right.0);
            let mut all: Vec<(f64, usize)> =
                those.map(|(mistake, wrong)| (agreement(&readers, wrong, right), *mistake)).collect();
            all.sort_by(|one, other| other.0.total_cmp(&one.0));
            let best = all.first().map_or(1.0, |best| best.0);
            all.retain(|(part, _)| *part >= least && *part >= best - ALIKE);
            all.into_iter().map(|(_, mistake)| mistake).collect::<Vec<_>>()
        };
        let mut same = agreeing(pictures, *every, right, 0.9 * SAME);
        if !same.is_empty() {
            same.truncate(NEAR);
            let more = (*every / 4).max(2);
            same = agreeing(&mistaken.pictures(&same, more, LATE), more, &mistaken.right(more)?, SAME);
        }
        self.told(&same)
    }

    /// What is said of the mistakes that come near the picture, as those with other random numbers do, and in how many blocks
    /// that differs.
    fn near(&self, picture: &Picture, readers: &Pixels, apart: usize) -> Option<(usize, String)> {
        let Tried { mistaken, every, right, pictures } = self.tried()?;
        let readers_few = few(picture, *every);
        let distance = |(_, (_, wrong)): &&(usize, Picture)| -> u64 {
            let parts = readers_few.1.as_flattened().iter().zip(wrong.as_flattened());
            parts.map(|(one, other)| u64::from(one.abs_diff(*other)).pow(2)).sum()
        };
        let mut near: Vec<&(usize, Picture)> = pictures.iter().filter(|(_, own)| own.0 == right.0).collect();
        near.sort_by_cached_key(distance);
        near.truncate(if *every > 12 { 0 } else { NEAR });
        let near: Vec<usize> = near.into_iter().map(|(mistake, _)| *mistake).collect();
        let pictures: Vec<LooksLike> = mistaken
            .pictures(&near, 1, LATE)
            .into_iter()
            .filter(|(_, (size, _))| *size == SIZE)
            .map(|(mistake, (_, bytes))| self.looks_like(mistake.to_string(), pixels_of(&bytes, &self.curve)))
            .collect();
        let (left, all) = self.closest(readers, apart, &pictures)?;
        let all: Vec<usize> = all.into_iter().filter_map(|mistake| mistake.parse().ok()).collect();
        self.told(&all).filter(|(_, others)| *others == 0).map(|(told, _)| (left, told))
    }

    /// What is said of mistakes that make the same picture, the likely ones first: what is known, or the lines.
    fn told(&self, mistakes: &[usize]) -> Made {
        let told = &self.tried()?.mistaken.told;
        let mut mistakes = mistakes.to_vec();
        mistakes.sort_unstable();
        let mut lines: Vec<(usize, &str)> = Vec::new();
        for (told, line) in mistakes.iter().filter_map(|&at| told.get(at)) {
            match line {
                None => return Some((told.clone(), 0)),
                Some(line) if lines.iter().any(|(other, _)| other == line) => {}
                Some(line) => lines.push((*line, told)),
            }
        }
        let others = lines.len().saturating_sub(MANY);
        let all: Vec<&str> = lines.into_iter().take(MANY).map(|(_, told)| told).collect();
        let more = if others > 0 {
            format!("; {others} other lines with a mistake make the same picture")
        } else {
            String::new()
        };
        (!all.is_empty()).then(|| (format!("as if {}{more}.", all.join("; or as if ")), others))
    }

    /// What the picture looks like that leaves the fewest blocks apart, if those are few; it must itself be apart from the
    /// right one about as far as the reader's is. With it, in how many blocks they still differ.
    fn closest<'a>(&self, readers: &Pixels, apart: usize, mistakes: &'a [LooksLike]) -> Option<(usize, Vec<&'a str>)> {
        let alike = mistakes.iter().filter(|(_, _, alone)| 2 * alone >= apart && *alone <= 3 * apart);
        let all: Vec<(usize, &str)> =
            alike.map(|(what, wrong, _)| (self.differing(readers, wrong), what.as_str())).collect();
        let least = all.iter().map(|found| found.0).min()?;
        // Noise alone may set one block apart.
        let is_few = least <= (apart / 10).max(usize::from(apart > 4));
        is_few.then(|| (least, all.into_iter().filter(|found| found.0 == least).map(|found| found.1).collect()))
    }

    fn differing(&self, one: &Pixels, other: &Pixels) -> usize {
        blocks(one, other, &self.curve).iter().filter(|block| block.differs()).count()
    }

    fn looks_like(&self, told: String, wrong: Pixels) -> LooksLike {
        let alone = self.differing(&wrong, &self.right);
        (told, wrong, alone)
    }

    /// The right picture as bright as the reader's, where neither is white.
    fn brighter(&self, readers: &Pixels) -> LooksLike {
        let pairs = || readers.iter().flatten().zip(self.right.iter().flatten());
        let (own, right) = pairs()
            .filter(|(own, right)| **own < 1.0 && **right < 1.0)
            .fold((0.0, 0.0), |sum, (own, right)| (sum.0 + own, sum.1 + right));
        let factor = own / right;
        let told = format!(
            "everything is {factor:.3} times as bright, the sky, too: what is the sum divided by, and of how many?"
        );
        self.looks_like(told, self.right.iter().map(|pixel| pixel.map(|light| (factor * light).min(1.0))).collect())
    }

    /// The picture written in other ways than it should be, and those of other scenes.
    fn rewritten_or_changed(&self) -> Result<&[LooksLike], Error> {
        if let Some(all) = self.rewritten_or_changed.get() {
            return Ok(all);
        }
        let rewritten = REWRITTEN
            .iter()
            .map(|(what, rewrite)| Ok(self.looks_like((*what).to_owned(), rewrite(&self.right, &self.curve))));
        let variants = variants().into_iter().filter(|variant| (variant.from..variant.until).contains(&self.chapter));
        let changed = variants.map(|variant| {
            let mut world = scene_after(self.chapter);
            (variant.change)(&mut world);
            // Enough to be told from the others.
            sample_at_most(&mut world, 32);
            Ok(self.looks_like(variant.looks_like.to_owned(), light_of(&picture_of(&world)?)))
        });
        let all = rewritten.chain(changed).collect::<Result<_, Error>>()?;
        Ok(self.rewritten_or_changed.get_or_init(|| all))
    }
}

/// The light of a picture of bytes.
fn pixels_of(bytes: &[[u8; 3]], curve: &Curve) -> Pixels {
    let light = |byte: u8| (curve.light_from_part)(f64::from(byte) / 255.0);
    bytes.iter().map(|pixel| pixel.map(light)).collect()
}

/// By how many pixels a picture is shifted to the right and downward, where that is told and explains this part of the
/// squared difference.
///
/// A small shift takes from each pixel its gradient times the shift: what is shifted is a least-squares fit of the
/// difference by the gradient, and its standard error the one that holds where noise is not the same everywhere (White
/// 1980).
fn shift(readers: &Pixels, right: &Pixels, explains: f64) -> Option<[f64; 2]> {
    let [width, height] = SIZE;
    let inside = || (1..height - 1).flat_map(|y| (1..width - 1).map(move |x| y * width + x));
    let numbers = || inside().flat_map(|at| [0, 1, 2].map(|channel| (at, channel)));
    let apart = |(at, channel): (usize, usize)| readers[at][channel] - right[at][channel];
    let mut explained = 0.0;
    let by = [1, width].map(|step| {
        let gradient = |(at, channel): (usize, usize)| 0.5 * (right[at - step][channel] - right[at + step][channel]);
        let squares: f64 = numbers().map(|at| gradient(at) * gradient(at)).sum();
        let fit = numbers().map(|at| gradient(at) * apart(at)).sum::<f64>() / squares.max(f64::MIN_POSITIVE);
        let left = |at| gradient(at) * (apart(at) - fit * gradient(at));
        let noise = numbers().map(|at| left(at) * left(at)).sum::<f64>().sqrt();
        explained += fit * fit * squares;
        if fit.abs() > SHIFT && fit.abs() * squares > SIGNIFICANT * noise { fit } else { 0.0 }
    });
    let all: f64 = numbers().map(|at| apart(at) * apart(at)).sum();
    (by != [0.0; 2] && explained >= explains * all).then_some(by)
}

/// The light of a film.
fn light_of(film: &Film) -> Pixels {
    let place = |at: u32| film.mean(at % film.width, at / film.width);
    (0..film.width * film.height).map(|at| place(at).map(|light| f64::from(light).clamp(0.0, 1.0))).collect()
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
fn blocks(readers: &Pixels, right: &Pixels, curve: &Curve) -> Vec<Block> {
    let [width, height] = SIZE;
    let mut blocks = Vec::new();
    for top in (0..height).step_by(BLOCK[1]) {
        for left in (0..width).step_by(BLOCK[0]) {
            let lines = top..(top + BLOCK[1]).min(height);
            let places: Vec<usize> =
                lines.flat_map(|y| (left..(left + BLOCK[0]).min(width)).map(move |x| y * width + x)).collect();
            let count = places.len() as f64;
            let mut block = Block { middle: [left + BLOCK[0] / 2, top + BLOCK[1] / 2], off: 0.0, resolved: 0.0 };
            for channel in 0..3 {
                let apart = |at: &usize| readers[*at][channel] - right[*at][channel];
                let mean = places.iter().map(apart).sum::<f64>() / count;
                let squares = places.iter().map(|at| (apart(at) - mean) * (apart(at) - mean)).sum::<f64>();
                let light = places.iter().map(|at| right[*at][channel]).sum::<f64>() / count;
                // By how much a byte's step changes light of this strength.
                let step = (curve.light_from_part)((curve.part_from_light)(light) + 1.0 / 255.0) - light;
                let white = |at: &&usize| (readers[**at][channel] >= 1.0) != (right[**at][channel] >= 1.0);
                let speckled = places.iter().filter(white).count() as f64 / count;
                let lost = if speckled < SPECKLED { speckled } else { 0.0 };
                let allowed = ROUNDING * step + SIGNIFICANT * (squares / (count - 1.0) / count).sqrt() + lost;
                block.off = block.off.max(mean.abs() / allowed);
                block.resolved = block.resolved.max(allowed / light.max(DARK));
            }
            blocks.push(block);
        }
    }
    blocks
}
