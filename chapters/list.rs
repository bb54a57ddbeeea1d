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
    fs::write(out.join("exercises.rs"), exercises(&chapters, &asking))?;
    fs::write(out.join("solutions.rs"), solutions(&chapters, &asking))?;
    fs::write(out.join("figures.rs"), figures(&chapters, &folders::with_file(&chapters, "figures.rs")?))
}

/// A module a chapter with the reader's function and the question, and the function `all`.
fn exercises(chapters: &Path, stems: &[String]) -> String {
    let mut text = String::new();
    for stem in stems {
        let (stub, question) = (file(chapters, stem, "exercise"), file(chapters, stem, "question"));
        let mine = chapters.join(stem).join("mine.rs").exists().then(|| file(chapters, stem, "mine"));
        let modules = format!("{stub}\n    {question}\n    {}", mine.unwrap_or_default());
        let _ = writeln!(text, "/// What chapter {stem} asks.\npub mod chapter_{stem} {{\n    {modules}\n}}\n");
    }
    let each = stems.iter().map(|stem| format!("({stem:?}, chapter_{stem}::question::yours())")).collect::<Vec<_>>();
    let _ = writeln!(text, "/// Each chapter that asks something, with the function as the reader has it now.");
    let _ = writeln!(text, "pub fn all() -> Vec<(&'static str, pinhole_lab::exercise::Exercise)> {{");
    let _ = writeln!(text, "    vec![{}]\n}}", each.join(", "));
    text
}

/// The same with the solution and typical mistakes, for tests.
fn solutions(chapters: &Path, stems: &[String]) -> String {
    let mut text = String::new();
    for stem in stems {
        let question = format!("pub use super::super::listed::chapter_{stem}::question;");
        let (solution, mistakes) = (file(chapters, stem, "solution"), file(chapters, stem, "mistakes"));
        let _ = writeln!(text, "pub mod chapter_{stem} {{\n    {question}\n    {solution}\n    {mistakes}\n}}\n");
    }
    let each =
        stems.iter().map(|stem| format!("({stem:?}, chapter_{stem}::mistakes::solved, chapter_{stem}::mistakes::all)"));
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
