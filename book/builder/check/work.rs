//! How long a page takes, by the work that it holds: what is read, what is written, and the exercises.
//!
//! A word rate alone says little of mathematics, where a line of six symbols may take longer than a paragraph. So each
//! kind of work has a rate of its own, and [`RATES`] says them to the reader.

use super::directive::{Directive, parse};
use super::pattern::unread;
use super::scan::{Scan, blank_spans};
use super::{Page, listing, parts};
use std::ops::Add;

/// Words in a minute: Carver's rate for a text that one means to remember.
const WORDS: f64 = 138.0;
/// Minutes for a formula on a line of its own, and for one within a sentence.
const FORMULA: f64 = 2.0;
const SYMBOL: f64 = 1.0 / 6.0;
/// Minutes for a picture.
const PICTURE: f64 = 1.0;
/// Lines of code in a minute, read.
const READ: f64 = 4.0;
/// Lines of code in a minute, typed and understood, and minutes to run them, to look and to mend.
const TYPED: f64 = 3.0;
const RUN: f64 = 10.0;
/// Minutes for the function to write.
const FUNCTION: f64 = 20.0;
/// Minutes for an exercise of one star, two and three.
const STARS: [f64; 3] = [5.0, 15.0, 60.0];

/// The rates, in a sentence of markdown.
pub fn rates() -> String {
    let [one, two, three] = STARS;
    format!(
        "{WORDS} words of prose in a minute; {FORMULA} minutes for a formula on a line of its own, {:.0} seconds for one \
         within a sentence; {PICTURE} minute for a picture; {READ} lines of code in a minute to read, {TYPED} to type, and \
         {RUN} minutes to run what was typed, to look at it and to mend it; {FUNCTION} minutes for the function; {one}, {two} \
         and {three} minutes for an exercise of ★, ★★ and ★★★",
        60.0 * SYMBOL
    )
}

/// Minutes of work.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// To read what is visible.
    pub reading: usize,
    /// To write the function.
    pub function: usize,
    /// To type the step of the reader's own program, and to try it.
    pub step: usize,
    /// To do all the exercises.
    pub exercises: usize,
}

impl Work {
    /// What a page asks for.
    pub fn of(page: &Page) -> Self {
        let scan = Scan::new(&page.text);
        let (mut reading, mut function, mut step) = (0.0, 0.0, 0.0);
        let (mut is_formula, mut is_exercise) = (false, false);
        for (line, _) in unread(&scan).filter(|(_, is_unread)| !is_unread) {
            match (parse(line.text), line.fence) {
                (Some(Ok(Directive::Include { path, anchor })), Some(_)) => {
                    let lines = listing::shown(page, path, anchor).map_or(0, |text| text.lines().count()) as f64;
                    match path.rsplit('/').next() {
                        Some("exercise.rs") => function += FUNCTION,
                        // A step in several parts is run once.
                        Some("yours.step" | "one_page.rs" | "monte_carlo.rs") => {
                            step += if step > 0.0 { 0.0 } else { RUN };
                            step += lines / TYPED;
                        }
                        _ => reading += lines / READ,
                    }
                }
                (Some(Ok(Directive::Figure { caption, .. })), None) => reading += PICTURE + prose(caption),
                (None, Some(fence)) if ["rust", "text"].contains(&scan.fences[fence].info) => {
                    let is_line = !line.text.trim_start().starts_with("```");
                    reading += if is_line { 1.0 / READ } else { 0.0 };
                }
                (None, None) => {
                    let marks = line.text.matches("$$").count();
                    reading += FORMULA * marks as f64 / 2.0;
                    // The time of an exercise holds that to read it.
                    if line.text.starts_with("## ") {
                        is_exercise = line.text == "## Exercises";
                    }
                    if !is_exercise && !is_formula && marks == 0 {
                        reading += prose(line.text);
                    }
                    is_formula ^= marks % 2 == 1;
                }
                _ => {}
            }
        }
        let levels = parts::exercises(page).1.into_iter().map(|exercise| exercise.level.chars().count());
        let exercises: f64 = levels.map(|stars| STARS[stars.clamp(1, STARS.len()) - 1]).sum();
        let [reading, function, step, exercises] =
            [reading, function, step, exercises].map(|minutes| f64::round(minutes) as usize);
        Self { reading, function, step, exercises }
    }

    /// To write what the page asks for.
    pub fn writing(self) -> usize {
        self.function + self.step
    }

    /// The minutes in a line, as whoever opens the page wants them: to the next five.
    pub fn at_a_glance(self) -> String {
        let about = |minutes: usize| (minutes + 2) / 5 * 5;
        let with = match (self.function > 0, self.step > 0) {
            (true, true) => ", with the function and the step",
            (true, false) => ", with the function",
            (false, true) => ", with the program",
            (false, false) => "",
        };
        let more = match about(self.exercises) {
            0 => String::new(),
            more => format!("; all exercises, {more} more"),
        };
        format!("About {} minutes{with}{more}.", about(self.reading + self.writing()))
    }

    /// The minutes in a sentence.
    pub fn told(self) -> String {
        let (Self { reading, exercises, .. }, writing) = (self, self.writing());
        format!("Minutes: {reading} to read, {writing} to write, {exercises} for all exercises.")
    }
}

impl Add for Work {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            reading: self.reading + other.reading,
            function: self.function + other.function,
            step: self.step + other.step,
            exercises: self.exercises + other.exercises,
        }
    }
}

/// Minutes for a line of prose, or a row of a table.
fn prose(line: &str) -> f64 {
    if line.trim_start().starts_with('<') || line.starts_with("|--") {
        return 0.0;
    }
    let words = blank_spans(line).split_whitespace().filter(|word| word.chars().any(char::is_alphanumeric)).count();
    words as f64 / WORDS + SYMBOL * (line.matches('$').count() / 2) as f64
}

#[cfg(test)]
mod tests {
    use super::super::made_up;
    use super::*;

    fn work(text: &str) -> Work {
        Work::of(&made_up("01_a.md", text))
    }

    #[test]
    fn each_kind_of_work_has_its_time() {
        let words = "word ".repeat(1380);
        assert_eq!(work(&words).reading, 10);
        assert_eq!(work(&format!("<details>\n{words}\n</details>\n")).reading, 0, "what is folded is not read");
        assert_eq!(work("$$a$$\n\n$$\nb\n$$\n").reading, 4);
        assert_eq!(work(&"$a$ and $b$\n".repeat(30)).reading, 10);
        assert_eq!(work(&format!("```rust\n{}```\n", "a();\n".repeat(40))).reading, 10);
        assert_eq!(work("{{#figure render 1 | A}}\n").reading, 1);
        let typed = work("```rust\n{{#include Cargo.toml}}\n{{#include x/exercise.rs:a}}\n```\n");
        assert_eq!((typed.function, typed.step), (20, 0));
        let step = "<details class=\"step\">\n\n```rust\n{{#include x/yours.step:a}}\n```\n\n```rust\n{{#include x/yours.step:b}}\n```\n\n</details>\n";
        assert_eq!(work(step), Work { step: 10, ..Work::default() }, "a step that is folded is typed, and run once");
        let glance = Work { reading: 31, function: 20, step: 22, exercises: 80 }.at_a_glance();
        assert_eq!(glance, "About 75 minutes, with the function and the step; all exercises, 80 more.");
        assert_eq!(work("a\n").at_a_glance(), "About 0 minutes.");
        let exercises = "## Exercises\n\n1. ★ A.\n2. ★★ B.\n3. ★★★ C.\n";
        assert_eq!(work(exercises), Work { exercises: 80, ..Work::default() });
        assert_eq!(work("a\n").writing(), 0);
    }
}
