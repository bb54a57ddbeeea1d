//! Whether the pictures of `render N --mine`, as they are written by default, show the mistakes that `check` names; they are
//! kept in out/mine.
//!
//! `cargo bench --bench mine`, or with the numbers of chapters behind a `--`; some minutes.
#![allow(clippy::print_stdout, reason = "a bench prints what it found")]
#![allow(clippy::disallowed_methods, reason = "a reader may call any function")]
#![allow(dead_code, reason = "the answers that are right are for the tests")]

#[path = "../exercises/answers.rs"]
mod answers;

#[path = "../exercises/shown.rs"]
mod shown;

use pinhole::Overrides;
use pinhole_lab::exercise::{PicturePair, Seen, sheet};
use shown::{Scenes, Shown, mistakes_of};
use std::fs;
use std::time::Instant;

fn main() -> std::io::Result<()> {
    let chosen: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let chapters = chapters::all();
    let (mut mistakes, mut visible) = (0, 0);
    fs::create_dir_all("out/mine")?;
    println!("  the largest difference of a pixel and of a block's mean, of 255; pixels that differ by more than 3");
    for (name, answers) in answers::ALL {
        let number = &name[..2];
        if !chosen.is_empty() && !chosen.iter().any(|word| word == number) {
            continue;
        }
        let Some(chapter) = chapters.iter().find(|chapter| chapter.name == *name) else { continue };
        let began = Instant::now();
        let right = Shown::of(chapter, &answers().solution, &Overrides::default());
        let seconds = began.elapsed().as_secs_f64();
        if let Shown::Pictures(pairs, seen) = &right {
            fs::write(format!("out/mine/{number}_right.png"), sheet(pairs)?)?;
            println!("{name}: {seconds:.1} s; right: {}", told(pairs, seen));
        }
        let all = mistakes_of(chapter, *answers, &[Overrides::default()], Scenes::All);
        for (at, (what, shown)) in all.iter().enumerate() {
            let is = if shown.is_shown() { "shown" } else { "NOT SHOWN" };
            let told = match shown {
                Shown::Pictures(pairs, seen) => {
                    fs::write(format!("out/mine/{number}_{at}.png"), sheet(pairs)?)?;
                    let most = |of: fn(&Seen) -> f64| seen.iter().map(of).fold(0.0, f64::max);
                    let (largest, block) = (most(|seen| f64::from(seen.largest)), most(|seen| seen.block));
                    let part = 100.0 * most(|seen| seen.part_over_3);
                    format!("{largest:>3} {block:>5.1} {part:>5.1} %  {}", told(pairs, seen))
                }
                Shown::Sentence(told) => told.clone(),
            };
            println!("  {is:<9} {what:<40}  {told}");
        }
        let count = all.iter().filter(|(_, shown)| shown.is_shown()).count();
        println!("  {count} of {} are shown", all.len());
        (mistakes, visible) = (mistakes + all.len(), visible + count);
    }
    println!(
        "{visible} of {mistakes} mistakes are shown, {:.1} %",
        100.0 * f64::from(visible as u32) / f64::from(mistakes as u32)
    );
    Ok(())
}

/// A sentence for each scene.
fn told(pairs: &[(&str, PicturePair)], seen: &[Seen]) -> String {
    let one = |((what, _), seen): (&(&str, PicturePair), &Seen)| format!("[{what}] {}", seen.sentence());
    pairs.iter().zip(seen).map(one).collect::<Vec<_>>().join("; ")
}
