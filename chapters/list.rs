//! Lists what chapters ask their readers to write and the figures they draw: every folder that has the files is one.

mod folders;

use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let root = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    let chapters = root.join("chapters");
    folders::run_again_for(&chapters, &["check.rs", "figures.rs"])?;
    let asking = folders::with_file(&chapters, "check.rs")?;
    let drawing = folders::with_file(&chapters, "figures.rs")?;
    let own = |stem: &str, module: &str| chapters.join(stem).join(format!("{module}.rs"));
    let mut functions = Vec::new();
    for stem in &asking {
        functions.push(asked_for(&fs::read_to_string(own(stem, "check"))?).to_owned());
    }

    fs::write(out.join("checks.rs"), modules(&asking, "check", "", &own))?;

    let figures = each(&drawing, |stem| format!("chapter_{stem}::figures::figures({stem:?})"));
    let figures = format!("pub fn all() -> Vec<pinhole_lab::figure::Figure> {{\n    [{figures}].concat()\n}}\n");
    let about = "/// The figures of all chapters, in the order of the book.\n";
    fs::write(out.join("figures.rs"), modules(&drawing, "figures", "", &own) + about + &figures)?;

    // Nothing else is compiled with what readers write, so that the answer to an edit is there at once.
    let check = "pub use pinhole_cli::checks::chapter_CHAPTER::check;";
    let mut function = functions.iter();
    let exercises = each(&asking, |stem| {
        let written = function.next().map_or("", String::as_str);
        format!("({stem:?}, chapter_{stem}::check::exercise(chapter_{stem}::exercise::{written}))")
    });
    let exercise = "Vec<(&'static str, pinhole_lab::exercise::Exercise)>";
    let exercises = format!("pub fn all() -> {exercise} {{\n    vec![{exercises}]\n}}\n");
    let about = "/// Each chapter that asks something, with the function as the reader has it now.\n";
    fs::write(out.join("exercises.rs"), modules(&asking, "exercise", check, &own) + about + &exercises)?;

    let answers = each(&asking, |stem| format!("({stem:?}, chapter_{stem}::answers::answers)"));
    let answers = format!("pub const ALL: &[(&str, fn() -> Answers)] = &[{answers}];\n");
    let in_tests = |stem: &str, folder: &str| root.join("tests").join(folder).join(format!("{stem}.rs"));
    let beside = format!("{check}\n    pub use super::Answers;");
    fs::write(out.join("answers.rs"), modules(&asking, "answers", &beside, &in_tests) + &answers)
}

/// A module a chapter with one file, and with what stands beside it, where CHAPTER is the chapter.
fn modules(stems: &[String], module: &str, beside: &str, file: &dyn Fn(&str, &str) -> PathBuf) -> String {
    let of = |stem: &String| {
        let (beside, file): (_, &Path) = (beside.replace("CHAPTER", stem), &file(stem, module));
        let about = format!("/// Of chapter {stem}.\npub mod chapter_{stem}");
        format!("{about} {{\n    {beside}\n    #[path = {file:?}]\n    pub mod {module};\n}}\n\n")
    };
    stems.iter().map(of).collect()
}

/// What is made of each chapter, with commas.
fn each(stems: &[String], of: impl FnMut(&String) -> String) -> String {
    stems.iter().map(of).collect::<Vec<_>>().join(", ")
}

/// The name of the function that a chapter asks for: the first text after it makes the exercise.
fn asked_for(check: &str) -> &str {
    let made = check.split("Exercise::").nth(1).unwrap_or_default();
    made.split('"').nth(1).unwrap_or_default()
}
