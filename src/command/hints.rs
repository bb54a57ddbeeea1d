use super::subject::Subject;
use crate::plan::view_names;
use std::fmt::Write;

/// Three commands that a reader may type next, each of which works as it stands.
pub fn try_next(subject: &Subject<'_>, width: u32, height: u32) -> String {
    let name = subject.name();
    let name = if name.contains(' ') { format!("\"{name}\"") } else { name.to_string() };
    let offer = subject.offer();
    let views = view_names(&offer);
    let view = ["surface", "hit", "world", "ndc", "raster"].into_iter().find(|word| views.contains(word));
    let mut hints = String::from("try next:\n");
    let _ = writeln!(hints, "  cargo run --release -- trace {name} --pixel {},{}", width / 2, height * 3 / 5);
    let _ = writeln!(hints, "  cargo run --release -- render {name} --view {}", view.unwrap_or("raster"));
    let _ = writeln!(hints, "  cargo run --release -- plan {name}");
    hints
}
