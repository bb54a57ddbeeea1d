//! The program as a reader comes to know it: what they type first, what they see, what is on disk afterwards.

#[path = "command_line/exported.rs"]
mod exported;
#[path = "command_line/exposed.rs"]
mod exposed;
#[cfg(unix)]
#[path = "command_line/frames.rs"]
mod frames;
#[cfg(unix)]
#[path = "command_line/lost.rs"]
mod lost;
#[path = "command_line/meant.rs"]
mod meant;
#[path = "command_line/model.rs"]
pub mod model;
#[cfg(unix)]
#[path = "command_line/moments.rs"]
mod moments;
#[cfg(unix)]
#[path = "command_line/names.rs"]
mod names_shown;
#[path = "command_line/parts.rs"]
mod parts;
#[path = "command_line/said.rs"]
mod said;

use pinhole::film::{Curve, png_bytes};
use pinhole::render::{Execution, render};
use pinhole::scene::Resolution;
use pinhole::{Chapter, Overrides, SamplingOverrides};
use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

fn pinhole(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pinhole"));
    // As `cargo run` starts it, wherever the test was started from.
    command.current_dir(folder).stdin(Stdio::null()).env("CARGO", "cargo");
    command
}

fn run(folder: &Path, words: &[&str]) -> Output {
    pinhole(folder).args(words).output().expect("the program starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("the program speaks UTF-8")
}

fn names(folder: &Path) -> Vec<String> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let name = |entry: fs::DirEntry| entry.file_name().to_string_lossy().into_owned();
    let mut names: Vec<String> = entries.map(|entry| name(entry.expect("listed"))).collect();
    names.sort();
    names
}

/// A chapter's images come with the program, so that it may be copied and started anywhere.
#[test]
fn a_chapter_with_images_renders_in_any_folder() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let done = run(folder.path(), &["render", "16", "--size", "16x9", "--quiet", "-o", "picture.png"]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    assert_eq!(names(folder.path()), ["picture.png"]);
}

/// The whole cover takes the optimised build half a minute; here it is stopped as soon as there is something to see.
#[test]
#[cfg(unix)]
fn the_first_command_shows_the_cover_long_before_it_is_done() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut child = pinhole(folder.path()).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("it starts");
    let (out, began) = (folder.path().join("out"), Instant::now());
    while !names(&out).contains(&"cover.checkpoint".into()) {
        assert!(child.try_wait().expect("known").is_none(), "it ended without a checkpoint");
        assert!(began.elapsed() < Duration::from_secs(120), "nothing to see after two minutes");
        thread::sleep(Duration::from_millis(50));
    }
    let seen = began.elapsed();
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("sent").success());
    assert_eq!(child.wait().expect("it ends").code(), Some(130));
    let mut said = String::new();
    child.stderr.take().expect("piped").read_to_string(&mut said).expect("UTF-8");
    assert!(said.contains("out/cover.png") && said.contains("--resume continues"), "{said}");
    assert_eq!(names(&out), ["cover.checkpoint", "cover.exr", "cover.png"]);
    let picture = image::open(out.join("cover.png")).expect("a PNG").into_rgb8();
    assert_eq!(picture.dimensions(), (960, 540));
    assert!(picture.pixels().any(|pixel| pixel.0 != [0; 3]), "it is black");
    eprintln!("the first picture of the cover after {seen:.1?} in this build");
}

#[test]
fn a_render_tells_what_ran_and_its_hints_work_as_typed() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let first = run(folder.path(), &["render", "cover", "--size", "32x18", "--samples", "2"]);
    assert!(first.status.success(), "{}", text(&first.stderr));
    assert_eq!(names(&folder.path().join("out")), ["cover.exr", "cover.png"]);
    let said = text(&first.stdout);
    for words in ["32 × 18 pixels, 2 samples each", "out/cover.png and .exr: ", "slowest stages: ", " left out: "] {
        assert!(said.contains(words), "no \"{words}\" in\n{said}");
    }
    let hints: Vec<&str> =
        said.lines().filter_map(|line| line.split_once("cargo run -- ")).map(|(_, hint)| hint).collect();
    let hints: Vec<&str> = hints.iter().map(|hint| hint.trim_end_matches(" says why")).collect();
    assert_eq!(hints.len(), 2, "{said}");
    for hint in hints {
        let tried = run(folder.path(), &as_typed(hint));
        assert!(tried.status.success() && !tried.stdout.is_empty(), "{hint}: {}", text(&tried.stderr));
    }
}

/// The words of a command; what takes minutes without all optimisation is asked of few pixels, where it goes the same way.
fn as_typed(command: &str) -> Vec<&str> {
    let mut words: Vec<&str> = command.split(' ').collect();
    let whole_cover = words[0] == "render" && words.contains(&"cover");
    if words[0] == "report" || words.contains(&"--samples") || whole_cover {
        words.extend(["--size", "8x5"]);
    }
    words
}

#[test]
fn every_example_in_the_help_works_as_typed() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let help = text(&run(folder.path(), &["--help"]).stdout);
    let examples: Vec<&str> = help.lines().filter_map(|line| line.strip_prefix("  cargo run -- ")).collect();
    assert!(examples.len() >= 5, "{help}");
    for example in examples {
        let tried = run(folder.path(), &as_typed(example));
        assert!(tried.status.success(), "{example}: {}", text(&tried.stderr));
    }
}

#[test]
fn statistics_are_json_and_nothing_else() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let told = run(folder.path(), &["render", "5", "--size", "96x54", "--stats"]);
    let stats: serde_json::Value = serde_json::from_slice(&told.stdout).expect("JSON");
    assert_eq!(stats["width"], 96);
    let stages = stats["stages"].as_array().expect("stages");
    let camera_rays = stages.iter().find(|stage| stage["stage"] == "Transform rays to world space").expect("a stage");
    assert_eq!(camera_rays["rows"], 96 * 54);
    assert!(stages.iter().all(|stage| stage["milliseconds"].as_f64().is_some_and(|time| time >= 0.0)));
    assert!(told.stderr.is_empty(), "{}", text(&told.stderr));
}

#[test]
fn ctrl_c_leaves_no_file_behind() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut stopped = 0;
    for wait in [150, 300, 450] {
        let mut child = pinhole(folder.path())
            .args(["render", "10", "--size", "3840x2160", "--threads", "1"])
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts");
        thread::sleep(Duration::from_millis(wait));
        let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
        if !sent.is_ok_and(|sent| sent.success()) {
            let _ = child.wait();
            continue;
        }
        let pressed = Instant::now();
        let ended = child.wait().expect("it ends");
        let mut said = String::new();
        child.stderr.take().expect("piped").read_to_string(&mut said).expect("UTF-8");
        assert!(pressed.elapsed() < Duration::from_secs(5), "it took {:?} to stop", pressed.elapsed());
        if ended.code() == Some(130) {
            stopped += 1;
            assert!(said.contains("stopped; no file was left half written"), "{said}");
            assert!(names(&folder.path().join("out")).is_empty(), "{:?}", names(&folder.path().join("out")));
        }
    }
    eprintln!("{stopped} of 3 renders were stopped by Ctrl-C before they were done");
    assert!(stopped > 0 || cfg!(not(unix)), "no render was stopped");
}

#[test]
fn a_closed_pipe_is_an_end_and_no_failure() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut child =
        pinhole(folder.path()).args(["plan", "cover"]).stdout(Stdio::piped()).spawn().expect("the program starts");
    drop(child.stdout.take());
    assert!(child.wait().expect("it ends").success());
}

fn chapter(name: &str) -> Chapter {
    chapters::all().into_iter().find(|chapter| chapter.name == name).expect("a chapter")
}

/// The mean linear light of each of 16 × 9 blocks of a PNG: red, green, blue.
fn blocks(png: &[u8]) -> Vec<[f64; 3]> {
    let image = image::load_from_memory(png).expect("a PNG").into_rgb8();
    let side = image.width() / 16;
    assert_eq!(image.dimensions(), (16 * side, 9 * side));
    let linear = |byte: u8| match f64::from(byte) / 255.0 {
        low if low <= 0.04045 => low / 12.92,
        high => libm::pow((high + 0.055) / 1.055, 2.4),
    };
    let mut sums = vec![[0.0; 3]; 16 * 9];
    for (x, y, pixel) in image.enumerate_pixels() {
        let sum = &mut sums[(y / side * 16 + x / side) as usize];
        sum.iter_mut().zip(pixel.0).for_each(|(sum, byte)| *sum += linear(byte) / f64::from(side * side));
    }
    sums
}

/// `.ci/run` renders the whole cover and compares it with the kept one to the last bit; here a small one of few samples
/// must show the same, block by block.
///
/// A block has 225 pixels of 16 samples, and what a PNG cuts off at the lamp's image in a mirror differs with the noise:
/// a quarter of a block's light is twice what the worst block shows.
#[test]
fn the_readme_opens_with_the_cover_that_pinhole_renders_now() {
    let cover = chapter("cover");
    let asked = Overrides {
        resolution: Some(Resolution { width: 240, height: 135 }),
        sampling: SamplingOverrides { samples: Some(16), ..SamplingOverrides::default() },
        ..Overrides::default()
    };
    let now = render(&cover.world(&asked), &cover.stages(), &Execution::default(), &()).expect("renders");
    let now = blocks(&png_bytes(&now.film, Curve::Srgb).expect("encodes"));
    let kept = fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("chapters/cover/cover.png")).expect("kept");
    let mut worst = 0.0_f64;
    for (at, (now, kept)) in now.iter().zip(blocks(&kept)).enumerate() {
        for (now, kept) in now.iter().zip(kept) {
            let off = (now - kept).abs() / (kept + 0.004);
            worst = worst.max(off);
            assert!(
                off < 0.25,
                "the README shows another cover than pinhole renders, in block {},{}: {now} is {kept}; look at both, then\n  \
                 cargo run --release -- render cover --quiet -o chapters/cover/cover.png",
                at % 16,
                at / 16
            );
        }
    }
    eprintln!("the kept cover: 144 blocks, the worst {:.1} % from a small one", 100.0 * worst);
}

/// A single path that hits the lamp must not whiten a pixel: none is brighter than all its neighbours by a quarter of the
/// range.
#[test]
fn the_kept_cover_has_no_white_specks() {
    let kept = Path::new(env!("CARGO_MANIFEST_DIR")).join("chapters/cover/cover.png");
    let picture = image::open(kept).expect("a PNG").into_luma8();
    let luma = |x: u32, y: u32| i16::from(picture.get_pixel(x, y).0[0]);
    let (mut specks, mut worst) = (Vec::new(), 0);
    for (x, y) in (1..picture.height() - 1).flat_map(|y| (1..picture.width() - 1).map(move |x| (x, y))) {
        let square = (y - 1..=y + 1).flat_map(|row| (x - 1..=x + 1).map(move |column| (column, row)));
        let around = square.filter(|&at| at != (x, y)).map(|(column, row)| luma(column, row));
        let above = luma(x, y) - around.max().expect("eight neighbours");
        worst = worst.max(above);
        if above >= 64 {
            specks.push((x, y));
        }
    }
    assert!(specks.is_empty(), "{} white specks on the kept cover, at {specks:?}", specks.len());
    eprintln!("the kept cover: no pixel is brighter than all its neighbours by more than {worst} of 255");
}

#[test]
fn the_readme_s_commands_are_commands() {
    let readme = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md")).expect("kept");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let typed = readme.lines().filter_map(|line| line.strip_prefix("cargo run --release -- "));
    let mut tried = 0;
    for words in
        typed.map(|line| line.split('#').next().unwrap_or("").trim()).filter(|words| !words.starts_with("extremes"))
    {
        // It shows its scene until it is stopped; tests/view.rs looks at it.
        if words.starts_with("view ") {
            continue;
        }
        let told = run(folder.path(), &as_typed(words));
        assert!(told.status.success(), "{words}: {}", text(&told.stderr));
        tried += 1;
    }
    assert!(tried >= 4, "the README's list of commands is gone");
}
