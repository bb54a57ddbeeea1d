//! Scene files made at random: by changing exported ones, and by a grammar that knows the words.

use crate::scenes;
use cpu_time::ThreadTime;
use pinhole::plan::Census;
use pinhole::scene::{Resolution, SceneFile, scene_text, words};
use pinhole::{Overrides, plan};
use scenes::Setup;
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::time::Duration;

/// What became of one file.
pub enum End {
    Mistake,
    Refused,
    NoPlan,
    Rendered,
    Panic,
}

/// How many ended in each way; the seeds of those that must not be.
#[derive(Default)]
pub struct Counts {
    pub mistakes: u64,
    pub refused: u64,
    pub no_plan: u64,
    pub rendered: u64,
    pub panics: Vec<u64>,
    pub slow: Vec<u64>,
    slowest: Duration,
}

impl Counts {
    pub fn add(&mut self, seed: u64, (end, time): (End, Duration)) {
        match end {
            End::Mistake => self.mistakes += 1,
            End::Refused => self.refused += 1,
            End::NoPlan => self.no_plan += 1,
            End::Rendered => self.rendered += 1,
            End::Panic => self.panics.push(seed),
        }
        if time > Duration::from_secs(1) {
            self.slow.push(seed);
        }
        self.slowest = self.slowest.max(time);
    }
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} with a slip, {} refused, {} without a plan, {} rendered, {} panics {:?}, {} over 1 s {:?}, slowest {:?}",
            self.mistakes,
            self.refused,
            self.no_plan,
            self.rendered,
            self.panics.len(),
            self.panics,
            self.slow.len(),
            self.slow,
            self.slowest
        )
    }
}

/// The files that are changed: every chapter but the long cover, and scenes with all kinds of entities.
pub fn bases() -> Vec<String> {
    let chapters = chapters::all().into_iter().skip(1);
    let texts = chapters.filter_map(|c| scene_text(&c.world(&Overrides::default())).ok());
    // The images of chapter 16 are named from the current folder, for these files stand in none.
    let mut bases: Vec<String> = texts.map(|text| text.replace("file: \"", "file: \"chapters/16_textures/")).collect();
    for eye in scenes::EYES {
        let setup = Setup { eye, ..Setup::default() };
        bases.extend(
            [scenes::full(setup), scenes::turned(setup), scenes::shining(setup)]
                .iter()
                .filter_map(|world| scene_text(world).ok()),
        );
    }
    bases
}

/// Random numbers: splitmix64.
pub struct Dice(pub u64);

impl Dice {
    pub fn roll(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, sides: usize) -> usize {
        (self.roll() % sides.max(1) as u64) as usize
    }

    fn pick<'t>(&mut self, from: &[&'t str]) -> &'t str {
        from[self.below(from.len())]
    }
}

const NUMBERS: &[&str] = &[
    "0",
    "-0.0",
    "1",
    "-1",
    "0.5",
    "2.0",
    "1e300",
    "-1e300",
    "1e-300",
    "1e18",
    "1e19",
    "1e-19",
    "NaN",
    "inf",
    "-inf",
    "179.9",
    "180",
    "1e999",
    "4294967295",
    "4294967296",
    "65536",
    "0x10",
    "1_0",
    "1e",
    "--1",
    "3",
    "89.9999",
    "1.7976931348623157e308",
    "5e-324",
    "99999999999999999999999999999999999999999999",
];
const PIECES: &[&str] = &[
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ",",
    ":",
    "\"",
    "'",
    "\\",
    "//",
    "/*",
    "*/",
    "r#\"",
    "#",
    "\n",
    "\0",
    "\u{feff}",
    "é",
    "(((((((((((((((((((((",
    "true",
    "None",
    "Some(1)",
    "name: \"ball\",",
    "parent: \"ball\",",
    "material: \"gold\",",
    "disabled: true,",
    "()",
    "sphere: (),",
    "matte: (),",
    "..",
    "b'a'",
    "\u{200e}",
    "\u{1}0\u{1}",
];
const FIELDS: &[&str] = &[
    "fov",
    "axis",
    "view_height",
    "radius",
    "normal",
    "intensity",
    "casts_shadows",
    "eye",
    "target",
    "up",
    "position",
    "orientation",
    "scale",
    "width",
    "height",
    "colour",
    "column",
];
const NAMES: &[&str] = &["a", "b", "c", "ball", "gold", ""];

/// A file of this seed.
pub fn case(bases: &[String], seed: u64) -> Vec<u8> {
    let mut dice = Dice(seed);
    let text = if dice.below(3) == 0 { grown(&mut dice) } else { bases[dice.below(bases.len())].clone() };
    let changes = if dice.below(4) == 0 { 0 } else { 1 + dice.below(3) };
    let mut bytes = text.into_bytes();
    for _ in 0..changes {
        change(&mut dice, &mut bytes);
    }
    bytes
}

/// Changes a file in one place.
fn change(dice: &mut Dice, bytes: &mut Vec<u8>) {
    let at = dice.below(bytes.len() + 1);
    let end = (at + dice.below(40)).min(bytes.len());
    let number_at = |bytes: &[u8], from: usize| {
        let start = from + bytes[from..].iter().position(u8::is_ascii_digit)?;
        let length = bytes[start..].iter().position(|byte| !(byte.is_ascii_digit() || *byte == b'.'))?;
        Some(start..start + length)
    };
    match dice.below(12) {
        0 => bytes.truncate(at),
        1 => drop(bytes.drain(at..end)),
        2 => {
            let piece = bytes[at..end].to_vec();
            let to = dice.below(bytes.len() + 1);
            bytes.splice(to..to, piece);
        }
        3 => drop(bytes.splice(at..at, dice.pick(PIECES).bytes())),
        4 if at < bytes.len() => bytes[at] = dice.roll() as u8,
        5 => drop(bytes.splice(at..at, dice.pick(FIELDS).bytes())),
        6..=10 => {
            if let Some(range) = number_at(bytes, at) {
                bytes.splice(range, dice.pick(NUMBERS).bytes());
            }
        }
        _ => {
            let words: Vec<&str> = words().chain(["name", "parent", "material", "disabled"]).collect();
            let word = dice.pick(&words);
            if let Some(colon) = bytes[at..].iter().position(|byte| *byte == b':').map(|colon| at + colon) {
                let start = bytes[..colon].iter().rposition(|byte| !byte.is_ascii_lowercase() && *byte != b'_');
                bytes.splice(start.map_or(0, |start| start + 1)..colon, word.bytes());
            }
        }
    }
}

/// A file by the grammar: mostly well formed, seldom with meaning.
fn grown(dice: &mut Dice) -> String {
    let mut text = String::from("[");
    if dice.below(8) > 0 {
        text.push_str("(name: \"eye\", perspective_camera: (), placement: (position: (0, 1, 5))),");
    }
    for _ in 0..dice.below(6) {
        text.push('(');
        if dice.below(3) > 0 {
            text.push_str(&format!("name: \"{}\",", dice.pick(NAMES)));
        }
        for relation in ["parent", "material"] {
            if dice.below(6) == 0 {
                text.push_str(&format!("{relation}: \"{}\",", dice.pick(NAMES)));
            }
        }
        if dice.below(4) > 0 {
            text.push_str(dice.pick(&["sphere: (),", "plane: (),", "point_light: (),", "background: (),"]));
            text.push_str(dice.pick(&["matte: (),", "matte: (),", ""]));
        }
        for _ in 0..dice.below(3) {
            let all: Vec<&str> = words().collect();
            text.push_str(&format!("{}: {},", dice.pick(&all), value(dice)));
        }
        text.push_str("),");
    }
    text.push(']');
    text
}

fn value(dice: &mut Dice) -> String {
    let mut fields = String::from("(");
    for _ in 0..dice.below(3) {
        let [a, b, c, d] = [(); 4].map(|()| dice.pick(NUMBERS));
        let value = match dice.below(5) {
            0 | 1 => a.to_string(),
            2 | 3 => format!("({a}, {b}, {c})"),
            _ => format!("({a}, {b}, {c}, {d})"),
        };
        fields.push_str(&format!("{}: {value},", dice.pick(FIELDS)));
    }
    fields + ")"
}

/// Reads, checks, plans and renders a file of 4 × 4 pixels, and says how far it came and how much time of the processor it took.
pub fn outcome(bytes: &[u8]) -> (End, Duration) {
    let started = ThreadTime::now();
    let end = catch_unwind(AssertUnwindSafe(|| try_all(bytes))).unwrap_or(End::Panic);
    (end, started.elapsed())
}

fn try_all(bytes: &[u8]) -> End {
    let file = match SceneFile::parse_bytes(Path::new("scene.ron"), bytes.to_vec()) {
        Ok(file) => file,
        Err(problem) => {
            let told = problem.to_string();
            assert!(!told.contains('\n') && told.chars().count() < 500, "{told}");
            return End::Mistake;
        }
    };
    let mut world = file.world();
    let census = &Census::of(&world);
    if let Err(scene_error) = pinhole::extract::validate(census) {
        let told = scene_error.to_string();
        assert!(!told.contains('\n'), "{told}");
        let place = file.place_of(|world| pinhole::extract::validate(&Census::of(world)).err());
        assert!(place.is_some() || told.starts_with("the scene: camera is missing"), "no place for: {told}");
        return End::Refused;
    }
    let text = scene_text(&world);
    if let Ok(text) = &text {
        let again = SceneFile::parse(Path::new("scene.ron"), text.clone()).expect("what was written can be read");
        assert_eq!(scene_text(&again.world()).as_ref(), Ok(text), "written again");
    }
    if plan::plan(census, &scenes::offer()).is_err() {
        return End::NoPlan;
    }
    Overrides { resolution: Some(Resolution { width: 4, height: 4 }), ..Overrides::default() }
        .put_on_camera(&mut world);
    match scenes::film_by(&world, &scenes::offer(), &scenes::one_world()) {
        Ok(_) => End::Rendered,
        Err(_) => End::Refused,
    }
}
