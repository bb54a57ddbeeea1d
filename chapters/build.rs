//! Lists the chapters: every folder here that has a `main.rs` is one, so a new chapter is entered nowhere.

mod folders;

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let here = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    folders::run_again_for(&here, &[])?;
    fs::write(out.join("chapters.rs"), listed(&here, &folders::with_file(&here, "main.rs")?))
}

/// The modules, the function `all`, and the macro `for_each_chapter`.
fn listed(here: &Path, stems: &[String]) -> String {
    let mut text = String::new();
    for stem in stems {
        let file = here.join(stem).join("main.rs");
        let _ = writeln!(text, "#[path = {file:?}]\npub mod chapter_{stem};\n");
    }
    let calls = stems.iter().map(|stem| format!("chapter_{stem}::chapter()"));
    let _ = writeln!(text, "/// All chapters, the cover first.\npub fn all() -> Vec<pinhole::Chapter> {{");
    let _ = writeln!(text, "    vec![{}]\n}}\n", calls.collect::<Vec<_>>().join(", "));
    let names = stems.iter().map(|stem| format!("chapter_{stem}")).collect::<Vec<_>>().join(" ");
    let _ = writeln!(text, "/// Calls a macro with the names of all chapters' modules, in order.\n#[macro_export]");
    let _ = writeln!(text, "macro_rules! for_each_chapter {{\n    ($call:ident) => {{ $call! {{ {names} }} }};\n}}");
    text
}
