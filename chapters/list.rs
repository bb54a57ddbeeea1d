//! Lists what chapters ask their readers to write and the figures they draw: every folder that has the files is one.

mod folders;

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let chapters = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default()).join("chapters");
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    let asking = folders::with_file(&chapters, "question.rs")?;
    folders::run_again_for(&chapters, &["question.rs", "mine.rs", "figures.rs"])?;
    fs::write(out.join("questions.rs"), questions(&chapters, &asking))?;
    fs::write(out.join("exercises.rs"), exercises(&chapters, &asking)?)?;
    fs::write(out.join("solutions.rs"), solutions(&chapters, &asking))?;
    fs::write(out.join("figures.rs"), figures(&chapters, &folders::with_file(&chapters, "figures.rs")?))
}

/// A module a chapter with what it asks, and how the answer shows in its picture.
fn questions(chapters: &Path, stems: &[String]) -> String {
    let mut text = String::new();
    for stem in stems {
        let question = file(chapters, stem, "question");
        let mine = chapters.join(stem).join("mine.rs").exists().then(|| file(chapters, stem, "mine"));
        let modules = format!("{question}\n    {}", mine.unwrap_or_default());
        let _ = writeln!(text, "/// What chapter {stem} asks.\npub mod chapter_{stem} {{\n    {modules}\n}}\n");
    }
    text
}

/// A module a chapter with the reader's function, and the function `all`, which puts each to its question.
///
/// Nothing else is compiled with what readers write, so that the answer to an edit is there at once.
fn exercises(chapters: &Path, stems: &[String]) -> io::Result<String> {
    let (mut text, mut each) = (String::new(), Vec::new());
    for stem in stems {
        let question = format!("pub use pinhole_cli::questions::chapter_{stem}::question;");
        let stub = file(chapters, stem, "exercise");
        let _ = writeln!(text, "pub mod chapter_{stem} {{\n    {question}\n    {stub}\n}}\n");
        let function = asked_for(&fs::read_to_string(chapters.join(stem).join("question.rs"))?).to_owned();
        each.push(format!("({stem:?}, chapter_{stem}::question::exercise(chapter_{stem}::exercise::{function}))"));
    }
    let _ = writeln!(text, "/// Each chapter that asks something, with the function as the reader has it now.");
    let _ = writeln!(text, "pub fn all() -> Vec<(&'static str, pinhole_lab::exercise::Exercise)> {{");
    let _ = writeln!(text, "    vec![{}]\n}}", each.join(", "));
    Ok(text)
}

/// The name of the function that a question asks for: the first text after it makes the exercise.
fn asked_for(question: &str) -> &str {
    let made = question.split("Exercise::").nth(1).unwrap_or_default();
    made.split('"').nth(1).unwrap_or_default()
}

/// The same with the solution, typical mistakes and what learners answered, for tests.
fn solutions(chapters: &Path, stems: &[String]) -> String {
    let mut text = String::new();
    for stem in stems {
        let question = format!("pub use pinhole_cli::questions::chapter_{stem}::question;");
        let [solution, mistakes, learners] = ["solution", "mistakes", "learners"].map(|own| file(chapters, stem, own));
        let modules = [question, solution, mistakes, learners].join("\n    ");
        let _ = writeln!(text, "pub mod chapter_{stem} {{\n    {modules}\n}}\n");
    }
    let each = stems.iter().map(|stem| {
        let own = format!("chapter_{stem}");
        format!("Solved {{ chapter: {stem:?}, solved: {own}::mistakes::solved, mistakes: {own}::mistakes::all, textbook: {own}::learners::textbook, learners: {own}::learners::all }}")
    });
    let _ = writeln!(text, "pub const ALL: &[Solved] = &[{}];", each.collect::<Vec<_>>().join(", "));
    text
}

/// A module a chapter that draws figures, and the function `all`.
fn figures(chapters: &Path, stems: &[String]) -> String {
    let mut text = String::new();
    for stem in stems {
        let figures = file(chapters, stem, "figures");
        let _ = writeln!(text, "/// The figures of chapter {stem}.\npub mod chapter_{stem} {{\n    {figures}\n}}\n");
    }
    let each = stems.iter().map(|stem| format!("chapter_{stem}::figures::figures({stem:?})")).collect::<Vec<_>>();
    let _ = writeln!(text, "/// The figures of all chapters, in the order of the book.");
    let _ = writeln!(text, "pub fn all() -> Vec<pinhole_lab::figure::Figure> {{");
    let _ = writeln!(text, "    [{}].concat()\n}}", each.join(", "));
    text
}

fn file(chapters: &Path, stem: &str, module: &str) -> String {
    format!("#[path = {:?}]\n    pub mod {module};", chapters.join(stem).join(format!("{module}.rs")))
}
