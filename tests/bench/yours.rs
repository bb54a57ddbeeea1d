//! What `yours` says of the reader's program with mistakes, and of right ones that look unlike the book's.
//!
//! `cargo bench --bench yours`; a few minutes. `-- --latest` tries a set that was written before anybody looked at what
//! was known by then, `-- --right` all that are right; two numbers behind them, from which chapter to which. With
//! `-- --among`, mistakes stand among all that is right and looks unlike the book's.
//! `-- --times` measures the program beside pinhole instead, both on one thread with the same number of samples, and
//! `-- --write` keeps that beside chapter 25.
#![allow(clippy::print_stdout, reason = "a bench prints what it found")]

#[path = "../yours/programs.rs"]
#[allow(dead_code, reason = "the test takes all of a chapter at once")]
mod programs;

#[path = "yours/latest.rs"]
mod latest;

use bevy_ecs::prelude::World;
use pinhole::extract::linear_from_srgb;
use pinhole::film::srgb_from_linear;
use pinhole::scene::Sampling;
use pinhole_lab::report::provenance::Provenance;
use pinhole_lab::yours::{Compiled, Expected, Picture, picture_of, program_after, scene_after, steps};
use programs::{Edit, Found, MISTAKES, RIGHT, edited, found_of};
use std::time::Instant;

/// Pictures of each, of which the fastest counts.
const RUNS: usize = 3;
/// The steps that are timed: a mirror and glass, all paths, many triangles.
const TIMED: [u32; 3] = [20, 25, 30];

fn main() {
    let words: Vec<String> = std::env::args().collect();
    let asks = |word: &str| words.iter().any(|own| own == word);
    if asks("--times") || asks("--write") {
        let table = times();
        println!("{table}");
        if asks("--write") {
            let file = format!("{}/chapters/25_path_tracing/yours.txt", env!("CARGO_MANIFEST_DIR"));
            let text = format!("{table}\n{}\n", Provenance::now(String::new()).measured());
            std::fs::write(file, text).expect("it can be written");
        }
        return;
    }
    // `-- --latest 21 30` tries those of chapters 21 to 30.
    let numbers: Vec<u32> = words.iter().filter_map(|word| word.parse().ok()).collect();
    let chapters = numbers.first().copied().unwrap_or(0)..=numbers.get(1).copied().unwrap_or(99);
    let (mistakes, right) = match () {
        () if asks("--latest") => (&latest::MISTAKES[..], &latest::RIGHT[..]),
        () if asks("--right") => (&[][..], &[&RIGHT[..], &latest::RIGHT[..]].concat()[..]),
        () => (&MISTAKES[..], &RIGHT[..]),
    };
    let of = |edits: &[Edit]| edits.iter().copied().filter(|edit| chapters.contains(&edit.0)).collect::<Vec<_>>();
    let (tried, right) = (of(mistakes), of(right));
    let (among, all_right) = (asks("--among"), [&RIGHT[..], &latest::RIGHT[..]].concat());
    let (mut told, mut named, mut refused, mut without, mut slowest) = (0, 0, 0, 0, 0.0);
    for chapter in steps().into_iter().map(|step| step.number).filter(|chapter| chapters.contains(chapter)) {
        let of_chapter = |edits: &[Edit]| edits.iter().copied().filter(|edit| edit.0 == chapter).collect::<Vec<_>>();
        let expected = Expected::after(chapter).expect("renders");
        let right_here = of_chapter(&all_right);
        let wrong = of_chapter(&tried).into_iter().map(|edit| (edit, true));
        for ((_, old, new), is_wrong) in wrong.chain(of_chapter(&right).into_iter().map(|edit| (edit, false))) {
            let line = format!("{chapter:>2}  {:<50}  {:<40}", old.trim(), new.trim());
            // All that is right and unlike the book's, where the mistake finds its words.
            let mut around = edited(chapter, &[]).expect("applies");
            for (_, find, other) in right_here.iter().filter(|_| among && is_wrong) {
                let unlike = around.replace(find, other);
                around = if unlike.contains(old) { unlike } else { around };
            }
            let program = around.replace(old, new);
            if program == around {
                println!("{line}  nothing to change");
                continue;
            }
            let began = Instant::now();
            let found = match found_of(&expected, &program) {
                Ok(found) => found,
                Err(why) => {
                    without += 1;
                    println!("{line}  no picture: {}", why.lines().next().unwrap_or_default());
                    continue;
                }
            };
            let seconds = began.elapsed().as_secs_f64();
            slowest = f64::max(slowest, seconds);
            let Found { comparison, program: said } = &found;
            if is_wrong {
                told += usize::from(found.is_wrong());
                let is_named = found.names(&around, &program);
                named += usize::from(is_named);
                let mark = if is_named { "named" } else { "NOT NAMED" };
                println!("{line}  {mark}, {seconds:.1} s: {comparison:?} {said:?}");
            } else if found.is_wrong() {
                refused += 1;
                println!("{line}  IS RIGHT: {comparison:?} {said:?}");
            }
        }
    }
    println!("mistakes: {} tried, {told} told, {named} named", tried.len());
    println!("right programs: {} tried, {refused} called wrong", right.len());
    println!("without a picture: {without}; the slowest took {slowest:.1} s");
}

/// Seconds and errors of the reader's program and of pinhole, for each step from the first with samples.
fn times() -> String {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let mut table =
        "seconds on one thread, the least of three, and relMSE against 512 samples of pinhole's\n".to_owned();
    table += "after chapter  samples   yours s  pinhole s     yours relMSE  pinhole relMSE\n";
    for step in steps().iter().filter(|step| TIMED.contains(&step.number)) {
        let program = program_after(step.number).expect("applies");
        let samples = program.split("SAMPLES: usize = ").nth(1).and_then(|rest| rest.split(';').next());
        let samples: u32 = samples.and_then(|samples| samples.parse().ok()).expect("samples");
        let compiled = Compiled::of(&program).expect("compiles");
        let scene = |samples: u32| {
            let mut scene = scene_after(step.number);
            scene
                .query::<&mut Sampling>()
                .iter_mut(&mut scene)
                .for_each(|mut own| (own.samples, own.seed) = (samples, u64::from(samples)));
            scene
        };
        let (right, few) = (light_of(&scene(512)), scene(samples));
        let (mut seconds, mut pictures) = ([f64::INFINITY; 2], [Vec::new(), Vec::new()]);
        for _ in 0..RUNS {
            let (yours, pinhole) =
                (|| light_in(&compiled.picture().expect("a picture")), || one.install(|| light_of(&few)));
            let runs: [&dyn Fn() -> Vec<[f64; 3]>; 2] = [&yours, &pinhole];
            for (which, run) in runs.into_iter().enumerate() {
                let began = Instant::now();
                pictures[which] = run();
                seconds[which] = seconds[which].min(began.elapsed().as_secs_f64());
            }
        }
        let [yours, pinhole] = pictures.map(|picture| rel_mse(&picture, &right));
        let number = step.number;
        table += &format!(
            "{number:>13}  {samples:>7}  {:>8.2}  {:>9.2}  {yours:>15.5}  {pinhole:>14.5}\n",
            seconds[0], seconds[1]
        );
    }
    table
}

/// A picture's light as bytes hold it, so that rounding is the same in both.
fn light_of(scene: &World) -> Vec<[f64; 3]> {
    let film = picture_of(scene).expect("renders");
    let place = |at: u32| film.mean(at % film.width, at / film.width);
    let shown =
        |light: f32| linear_from_srgb((255.0 * srgb_from_linear(f64::from(light).clamp(0.0, 1.0))).round() / 255.0);
    (0..film.width * film.height).map(|at| place(at).map(shown)).collect()
}

fn light_in((_, bytes): &Picture) -> Vec<[f64; 3]> {
    bytes.iter().map(|pixel| pixel.map(|byte| linear_from_srgb(f64::from(byte) / 255.0))).collect()
}

/// The mean of the squared error over the squared light, to which a hundredth of white is added.
fn rel_mse(picture: &[[f64; 3]], right: &[[f64; 3]]) -> f64 {
    let pairs = picture.iter().flatten().zip(right.iter().flatten());
    pairs.map(|(own, right)| (own - right) * (own - right) / (right * right + 1e-4)).sum::<f64>()
        / (3 * right.len()) as f64
}
