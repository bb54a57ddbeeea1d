//! The reader's program after each step, compiled and run, and with mistakes put into it.

use pinhole_lab::yours::{Comparison, compare_picture, program_after};
use std::fs;
use std::path::Path;
use std::process::Command;

/// A chapter, what its program says there, and what is put in its place.
pub type Edit = (u32, &'static str, &'static str);

/// Mistakes, each of which shows in the picture.
pub const MISTAKES: [Edit; 44] = [
    (5, "camera_direction(x as f64 + 0.5, y as f64 + 0.5)", "camera_direction(x as f64, y as f64)"),
    (17, "x as f64 + right, y as f64 + down", "x as f64 + right - 0.5, y as f64 + down - 0.5"),
    (5, "times(irradiance / PI)", "times(irradiance)"),
    (5, "/ to_light.dot(to_light);", "/ to_light.dot(to_light).sqrt();"),
    (5, "(ANGLE / 2.0)", "ANGLE"),
    (5, "let up = 1.0 - 2.0 * y / HEIGHT as f64;", "let up = 2.0 * y / HEIGHT as f64 - 1.0;"),
    (5, "(2.0 * x - WIDTH as f64) / HEIGHT as f64", "(2.0 * x - WIDTH as f64) / WIDTH as f64"),
    (5, "V(half * right, half * up, -1.0)", "V(half * right, half * up, 1.0)"),
    (5, "|(t, _)| t < 1.0", "|(t, _)| t < 0.0"),
    (5, "sphere.colour.times(", "V(1.0, 1.0, 1.0).times("),
    (5, ".clamp(0.0, 1.0).sqrt()", ".clamp(0.0, 1.0)"),
    (5, "byte(r), byte(g), byte(b)", "byte(b), byte(g), byte(r)"),
    (5, "INTENSITY * cosine", "INTENSITY"),
    (9, "V(0.0, 1.0, 0.0).cross(back)", "back.cross(V(0.0, 1.0, 0.0))"),
    (9, ".sub(back)", ".add(back)"),
    (9, "const EYE: V = V(2.5, 1.4, 1.4);", "const EYE: V = V(0.0, 0.0, 0.0);"),
    (9, "back.cross(to_the_right)", "to_the_right.cross(back)"),
    (9, "EYE.sub(TARGET).unit()", "EYE.sub(TARGET)"),
    (10, "point.add(normal.times(1e-9))", "point.sub(normal.times(1e-9))"),
    (10, "in LAMPS {", "in LAMPS.into_iter().take(1) {"),
    (10, ".times(1.0 / PI)", ""),
    (10, "hit.0 > 1.0", "hit.0 < 1.0"),
    (10, "light.powf(1.0 / 2.4)", "light"),
    (13, "(height - normal.dot(origin))", "(normal.dot(origin) - height)"),
    (13, "    Thing(Block { low: V(-2.8, -1.0, -4.5), high: V(-1.4, 0.8, -3.1) }, V(0.3, 0.4, 0.8)),\n", ""),
    (13, "match along > 0.0", "match along < 0.0"),
    (13, "V(0.0, 1.0, 0.0)),\n                (low.2", "V(1.0, 0.0, 0.0)),\n                (low.2"),
    (17, "sum.times(1.0 / SAMPLES as f64)", "sum.times(2.0 / SAMPLES as f64)"),
    (17, "2.0_f64.powi(64)", "2.0_f64.powi(61)"),
    (19, "2.0 * normal.dot(direction)", "normal.dot(direction)"),
    (19, "                weight = weight.by(colour);\n", ""),
    (19, "direction.sub(normal.times(2.0", "direction.add(normal.times(2.0"),
    (20, "{ 1.0 / index } else { index }", "{ index } else { 1.0 / index }"),
    (20, "random.next() < reflected", "random.next() < 0.0"),
    (20, "origin = point.sub(normal.times(1e-9));", "origin = point.add(normal.times(1e-9));"),
    (20, "normal.times(eta * cosine - beyond)", "normal.times(eta * cosine + beyond)"),
    (21, "cosine * cosine_there * area", "cosine * area"),
    (21, "4.0 * PI * radius", "2.0 * PI * radius"),
    (21, "|hit| hit.0 < 1.0 - 1e-9", "|hit| hit.0 < 0.0"),
    (25, "                lamps_count = false;\n", ""),
    (25, "                weight = weight.by(colour);\n                sum", "                sum"),
    (25, "        weight = weight.times(1.0 / survives);\n", ""),
    (25, "normal.add(random.direction())", "random.direction()"),
    (25, "return sum.add(weight.by(V(0.5, 0.7, 1.0)));", "return sum;"),
];

/// Programs that are right, and look unlike the book's.
pub const RIGHT: [Edit; 10] = [
    (17, "Random((y * WIDTH + x) as u64)", "Random(977 * (y * WIDTH + x) as u64 + 5)"),
    (17, "const SAMPLES: usize = 64;", "const SAMPLES: usize = 100;"),
    (10, "LAMPS {", "LAMPS.into_iter().rev() {"),
    (13, "SCENE.iter().filter_map", "SCENE.iter().rev().filter_map"),
    (
        25,
        "normal.add(random.direction())",
        "{ let d = random.direction(); let d = if d.dot(normal) < 0.0 { d.times(-1.0) } else { d }; weight = weight.times(2.0 * d.dot(normal)); d }",
    ),
    (25, "const SAMPLES: usize = 64;", "const SAMPLES: usize = 200;"),
    (25, "weight.0.max(weight.1).max(weight.2).min(1.0)", "((weight.0 + weight.1 + weight.2) / 3.0).min(1.0)"),
    (20, "random.next() < reflected", "random.next() > 1.0 - reflected"),
    (21, "let outward = random.direction();", "let outward = random.direction().times(-1.0);"),
    (9, "let upward = back.cross(to_the_right);", "let upward = V(0.0, 1.0, 0.0).sub(back.times(back.1)).unit();"),
];

/// What is said of a picture that is not pinhole's; none of one that is.
pub fn said(found: &Comparison) -> Option<&'static str> {
    match *found {
        Comparison::Same { .. } => None,
        Comparison::Shifted { .. } => Some("it is shifted"),
        Comparison::Differs { looks_like, .. } => Some(looks_like.unwrap_or(NOT_NAMED)),
    }
}

/// What is said of a picture that differs for a reason that is not known.
pub const NOT_NAMED: &str = "told, not named";

/// What is found of the picture of a chapter's program, edited.
pub fn found((chapter, old, new): Edit) -> Comparison {
    let program = program_after(chapter).expect("applies");
    assert_eq!(program.matches(old).count().min(1), 1, "{chapter} has no {old}");
    let (size, bytes) = picture(&program.replace(old, new));
    compare_picture(chapter, size, &bytes).expect("renders")
}

/// Compiles a program as a reader does, runs it, and reads the picture that it wrote.
pub fn picture(program: &str) -> ([usize; 2], Vec<[u8; 3]>) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let source = folder.path().join("main.rs");
    fs::write(&source, program).expect("written");
    let compiler = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let words = ["-O", "--edition", "2024", "-A", "warnings", "main.rs", "-o", "one_page"];
    let told = Command::new(compiler).args(words).current_dir(folder.path()).output().expect("a compiler");
    assert!(told.status.success(), "{}", String::from_utf8_lossy(&told.stderr));
    let program = folder.path().join(Path::new("one_page"));
    assert!(Command::new(program).current_dir(folder.path()).status().expect("runs").success());
    let text = fs::read_to_string(folder.path().join("picture.ppm")).expect("a picture");
    let numbers: Vec<usize> = text.split_whitespace().skip(1).map(|word| word.parse().expect("a number")).collect();
    let byte = |part: usize| u8::try_from(part).expect("a byte");
    let pixels = numbers[3..].chunks_exact(3).map(|own| [byte(own[0]), byte(own[1]), byte(own[2])]).collect();
    ([numbers[0], numbers[1]], pixels)
}
