//! Whether a picture of bytes shows what another one of light shows, block by block.

use super::known::{Picture, few, known_of, picture_of_program, pictures_of};
use super::located::{Beside, Place};
use super::program::program_after;
use super::scene::{SIZE, film_after, picture_of, sample_at_most, scene_after, variants};
use pinhole::Error;
use pinhole::extract::linear_from_srgb;
use pinhole::film::{Film, srgb_from_linear};
use std::sync::OnceLock;

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
/// The part of the pixels that differ that a mistake must make as they are.
const SAME: f64 = 0.97;
/// Samples a pixel with which two programs are compared whose pictures are the same within noise.
const MORE: usize = 256;
/// Blocks of two such pictures, and how many may differ, since a path that brings much light makes one do so now and then.
const SCALES: [([usize; 2], usize); 3] = [(BLOCK, 4), ([96, 54], 0), (SIZE, 0)];
/// What rounding may change in their mean, in bytes: where one picture has no noise and the other has, half of one.
const HALF: f64 = 0.55;
/// How many bytes two pictures without noise may differ by in a pixel, and in what part of their pixels by more.
const ROUNDED: (u8, f64) = (2, 1e-3);
/// Light that noise may carry beyond white, in two such pictures.
const BRIGHT: f64 = 0.75;
/// How many times the squared error of the book's program one may have that is as good.
const NOISIER: f64 = 4.0;
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

/// What is found of the program that wrote a picture.
#[derive(Clone, Debug, PartialEq)]
pub enum Program {
    /// It is the book's, but for spaces, comments and names.
    Books,
    /// It is not the book's in these places, and nothing shows that it is worse.
    Right(Vec<Place>),
    /// It is the book's as it was after an earlier chapter.
    Earlier(u32),
    /// It does not write the picture, by the end of a sentence.
    Another(String),
    /// With these places as in the book it is right.
    Wrong(Mistake, Vec<Place>),
}

/// What a mistake does to the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mistake {
    /// It shows in the picture as it is.
    Shows,
    /// It shows beside the book's program alone, with more samples, or pixel by pixel where there is no noise: in so much
    /// of the picture.
    Hides(f64),
    /// The light is right, and the squared error so many times that of the book's program with as many samples.
    MakesNoise(f64),
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
    rewritten_or_changed: OnceLock<Vec<LooksLike>>,
    known: OnceLock<Vec<(String, Picture)>>,
}

/// What a picture looks like, the picture, and in how many blocks it is not as the right one.
type LooksLike = (String, Pixels, usize);

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
        Self::with_samples(chapter, u32::MAX)
    }

    /// The same with at most so many samples a pixel.
    ///
    /// Errors: the same.
    pub fn with_samples(chapter: u32, samples: u32) -> Result<Self, Error> {
        let right = light_of(&film_after(chapter, samples)?);
        let (rewritten_or_changed, known) = <(OnceLock<_>, OnceLock<_>)>::default();
        Ok(Self { chapter, curve: Curve::after(chapter), right, rewritten_or_changed, known })
    }

    /// Compares the picture that a reader's program wrote.
    ///
    /// Errors: a picture of another size.
    pub fn compare(&self, picture: &Picture) -> Result<Comparison, Error> {
        let ([width, height], bytes) = picture;
        if [*width, *height] != SIZE {
            let told =
                format!("the picture has {width} × {height} pixels, and pinhole's has {} × {}", SIZE[0], SIZE[1]);
            return Err(Error::Usage(told));
        }
        let (readers, right) = (pixels_of(bytes, &self.curve), &self.right);
        let found = blocks(&readers, right, &self.curve, BLOCK, ROUNDING);
        let apart: Vec<&Block> = found.iter().filter(|block| block.differs()).collect();
        let Some(most) = apart.iter().max_by(|a, b| a.off.total_cmp(&b.off)) else {
            let mut resolved: Vec<f64> = found.iter().map(|block| block.resolved).collect();
            resolved.sort_by(f64::total_cmp);
            let same = Comparison::Same { resolved: resolved[resolved.len() / 2] };
            return Ok(shift(&readers, right, 0.0).map_or(same, |by| Comparison::Shifted { by }));
        };
        let light = |pixels: &Pixels| pixels.iter().flatten().sum::<f64>();
        let brightness = light(&readers) / light(right) - 1.0;
        let most = most.middle;
        Ok(Comparison::Differs { blocks: apart.len(), of: found.len(), brightness, most, looks_like: None })
    }

    /// Looks for what a picture looks like that differs; `waits` is called before known mistakes are made in the program,
    /// which takes a while.
    ///
    /// Errors: those of a render.
    pub fn look_for_known(
        &self,
        picture: &Picture,
        found: &mut Comparison,
        waits: &mut dyn FnMut(),
    ) -> Result<(), Error> {
        let Comparison::Differs { blocks: apart, looks_like, .. } = found else { return Ok(()) };
        let readers = pixels_of(&picture.1, &self.curve);
        *looks_like = self.known_to_make(picture, waits)?;
        if looks_like.is_none() {
            let of_all = self.closest(&readers, *apart, self.rewritten_or_changed()?);
            let brighter = [self.brighter(&readers)];
            let brighter = self.closest(&readers, *apart, &brighter);
            let likest = [of_all, brighter].into_iter().flatten().min_by_key(|found| found.0);
            *looks_like = likest.and_then(|(_, all)| Some((*all.first()?).to_owned()));
        }
        if looks_like.is_none()
            && let Some(by) = shift(&readers, &self.right, EXPLAINED)
        {
            *found = Comparison::Shifted { by };
        }
        Ok(())
    }

    /// A picture with pinhole's light where that is bright: more noise is cut off at white there, and its mean is lower.
    fn without_bright(&self, mut pixels: Pixels) -> Pixels {
        let pairs = pixels.as_flattened_mut().iter_mut().zip(self.right.as_flattened());
        pairs.filter(|(_, right)| **right > BRIGHT).for_each(|(own, right)| *own = *right);
        pixels
    }

    /// What is said of the known mistake that makes this very picture, as one with the same random numbers does.
    fn known_to_make(&self, picture: &Picture, waits: &mut dyn FnMut()) -> Result<Option<String>, Error> {
        // One pixel of so many in both directions; its random numbers are its own, so that it is as in the whole picture.
        let every = match self.chapter {
            ..17 | 33.. => 4,
            28..30 => 24,
            30.. => 12,
            _ => 8,
        };
        let known = match self.known.get() {
            Some(known) => known,
            None => {
                waits();
                let all = known_of(self.chapter).map_err(Error::Usage)?;
                let book = program_after(self.chapter).map_err(Error::Usage)?;
                let programs: Vec<&str> = [&*book].into_iter().chain(all.iter().map(|known| &*known.program)).collect();
                let told = |at: usize| at.checked_sub(1).map_or(String::new(), |at| all[at].looks_like.clone());
                let made = pictures_of(&programs, every).into_iter().map(|(at, picture)| (told(at), picture)).collect();
                self.known.get_or_init(|| made)
            }
        };
        let Some(((told, right), known)) = known.split_first() else { return Ok(None) };
        let readers = few(picture, every);
        let those = known.iter().filter(|(_, own)| told.is_empty() && own.0 == right.0);
        let agreeing = those.map(|(told, wrong)| (agreement(&readers, wrong, right), told));
        let best = agreeing.max_by(|one, other| one.0.total_cmp(&other.0));
        Ok(best.filter(|(part, _)| *part >= SAME).map(|(_, told)| told.clone()))
    }

    /// What is found of the program that wrote a picture, of which this was found; programs are compiled and run for it,
    /// and `waits` is called where that takes long.
    ///
    /// Errors: a chapter whose steps do not fit.
    pub fn look_into(
        &self,
        program: &str,
        picture: &Picture,
        found: &mut Comparison,
        waits: &mut dyn FnMut(),
    ) -> Result<Program, Error> {
        self.look_into_both(program, &|| picture_of_program(program), picture, found, waits)
    }

    /// The same of a program whose own picture may be there.
    ///
    /// Errors: the same.
    pub fn look_into_both(
        &self,
        program: &str,
        own: &dyn Fn() -> Result<Picture, String>,
        picture: &Picture,
        found: &mut Comparison,
        waits: &mut dyn FnMut(),
    ) -> Result<Program, Error> {
        let beside = Beside::new(program, self.chapter).map_err(Error::Usage)?;
        let is_same_picture = matches!(found, Comparison::Same { .. });
        if beside.is_the_books() {
            let another = "is the book's by now, and writes the right picture: run it again";
            return Ok(if is_same_picture { Program::Books } else { Program::Another(another.into()) });
        }
        if let Some(earlier) = beside.earlier(self.chapter) {
            return Ok(Program::Earlier(earlier));
        }
        let own = match own() {
            Ok(own) => own,
            Err(why) => return Ok(Program::Another(ending(&why))),
        };
        let is_same = |(size, bytes): &Picture| {
            let readers = pixels_of(bytes, &self.curve);
            size == &SIZE
                && !blocks(&readers, &self.right, &self.curve, BLOCK, ROUNDING).iter().any(Block::differs)
                && shift(&readers, &self.right, 0.0).is_none()
        };
        let [own, readers] = [&own, picture].map(|(_, bytes)| pixels_of(bytes, &self.curve));
        if own.len() != readers.len() || self.differing(&own, &readers) > 0 {
            return Ok(Program::Another("writes another picture than this one now".into()));
        }
        if !is_same_picture {
            if !beside.is_one_place() {
                waits();
            }
            let places =
                beside.wrong(&|program: &str| picture_of_program(program).is_ok_and(|picture| is_same(&picture)));
            let Some(places) = places else {
                return Ok(Program::Another(
                    "is wrong even with all that differs from the book's as it is there".into(),
                ));
            };
            if let Comparison::Differs { looks_like, .. } = found
                && let Some(known) = known_of(self.chapter)
                    .map_err(Error::Usage)?
                    .into_iter()
                    .find(|known| beside.has_only(&places, &known.program))
            {
                *looks_like = Some(known.looks_like);
            }
            return Ok(Program::Wrong(Mistake::Shows, places));
        }
        waits();
        let shown = |program: &str| picture_of_program(&with_samples(program)).ok();
        let (book, mine) = std::thread::scope(|scope| {
            let book = scope.spawn(|| shown(beside.books()));
            let mine = shown(program);
            (book.join().ok().flatten(), mine)
        });
        let (Some(book), Some(mine)) = (book, mine) else { return Ok(Program::Right(beside.places())) };
        // What is laid out for one number of samples shows another picture with another.
        let light = |(_, bytes): &Picture| self.without_bright(pixels_of(bytes, &self.curve));
        let is_laid_out = mine.0 == SIZE && self.differing(&light(&mine), &self.without_bright(own)) > 0;
        let Some(mistake) = self.worse(&mine, &book).filter(|_| !is_laid_out) else {
            return Ok(Program::Right(beside.places()));
        };
        let is_right = |program: &str| shown(program).is_some_and(|picture| self.worse(&picture, &book).is_none());
        let wrong = beside.wrong(&is_right).map(|places| Program::Wrong(mistake, places));
        Ok(wrong.unwrap_or_else(|| Program::Right(beside.places())))
    }

    /// What is worse in a program's picture than in that of the book's program, both of as many samples.
    fn worse(&self, (size, bytes): &Picture, (_, books): &Picture) -> Option<Mistake> {
        if *size != SIZE {
            return Some(Mistake::Hides(1.0));
        }
        if !(17..33).contains(&self.chapter) {
            let (by, part) = ROUNDED;
            let is_apart = |(one, other): &(&[u8; 3], &[u8; 3])| (0..3).any(|at| one[at].abs_diff(other[at]) > by);
            let apart = bytes.iter().zip(books).filter(is_apart).count() as f64 / bytes.len() as f64;
            return (apart > part).then_some(Mistake::Hides(apart));
        }
        let [own, book] = [bytes, books].map(|bytes| self.without_bright(pixels_of(bytes, &self.curve)));
        for (size, most) in SCALES {
            let blocks = blocks(&own, &book, &self.curve, size, HALF);
            let apart = blocks.iter().filter(|block| block.differs()).count();
            if apart > most {
                return Some(Mistake::Hides(apart as f64 / blocks.len() as f64));
            }
        }
        let error = |pixels: &Pixels| {
            let pairs = pixels.iter().flatten().zip(self.right.iter().flatten());
            pairs.map(|(one, other)| (one - other) * (one - other)).sum::<f64>()
        };
        let noisier = error(&own) / error(&book);
        (noisier > NOISIER).then_some(Mistake::MakesNoise(noisier))
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
        blocks(one, other, &self.curve, BLOCK, ROUNDING).iter().filter(|block| block.differs()).count()
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

/// A program with many samples a pixel, if it takes any.
fn with_samples(program: &str) -> String {
    const SAMPLES: &str = "SAMPLES: usize = ";
    let Some((before, rest)) = program.split_once(SAMPLES) else { return program.into() };
    let Some((_, after)) = rest.split_once(';') else { return program.into() };
    format!("{before}{SAMPLES}{MORE};{after}")
}

/// The first line of what a compiler or a program says, as the end of a sentence.
fn ending(why: &str) -> String {
    let first = why.lines().find(|line| line.contains("error")).or(why.lines().next()).unwrap_or_default();
    format!("cannot be compiled and run by itself: {}", first.trim())
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

/// Compares two pictures in blocks of a size, in whose means rounding may change so many bytes; the scatter of the
/// differences within a block is their noise.
fn blocks(readers: &Pixels, right: &Pixels, curve: &Curve, size: [usize; 2], rounding: f64) -> Vec<Block> {
    let [width, height] = SIZE;
    let mut blocks = Vec::new();
    for top in (0..height).step_by(size[1]) {
        for left in (0..width).step_by(size[0]) {
            let lines = top..(top + size[1]).min(height);
            let places: Vec<usize> =
                lines.flat_map(|y| (left..(left + size[0]).min(width)).map(move |x| y * width + x)).collect();
            let count = places.len() as f64;
            let mut block = Block { middle: [left + size[0] / 2, top + size[1] / 2], off: 0.0, resolved: 0.0 };
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
                let allowed = rounding * step + SIGNIFICANT * (squares / (count - 1.0) / count).sqrt() + lost;
                block.off = block.off.max(mean.abs() / allowed);
                block.resolved = block.resolved.max(allowed / light.max(DARK));
            }
            blocks.push(block);
        }
    }
    blocks
}
