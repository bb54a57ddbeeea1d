//! The program as a reader meets it: what they type first, what they see, what is on disk afterwards.

use pinhole::film::{Curve, png_bytes};
use pinhole::render::{Execution, render};
use pinhole::{Asked, Chapter};
use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

#[path = "../chapters/mod.rs"]
mod chapters;

fn pinhole(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pinhole"));
    command.current_dir(folder).stdin(Stdio::null());
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

#[test]
fn the_first_command_renders_the_cover_and_its_three_hints_work_as_typed() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let first = run(folder.path(), &[]);
    assert!(first.status.success(), "{}", text(&first.stderr));
    assert_eq!(names(&folder.path().join("out")), ["cover.exr", "cover.png"]);
    let said = text(&first.stdout);
    for words in ["what ran", "what was left out, and why", "960 × 540 pixels", "wrote out/cover.png and out/cover.exr"]
    {
        assert!(said.contains(words), "no \"{words}\" in\n{said}");
    }
    let hints: Vec<&str> =
        said.lines().filter_map(|line| line.trim().strip_prefix("cargo run --release -- ")).collect();
    assert_eq!(hints.len(), 3, "{said}");
    for hint in hints {
        let tried = run(folder.path(), &hint.split(' ').collect::<Vec<_>>());
        assert!(tried.status.success() && !tried.stdout.is_empty(), "{hint}: {}", text(&tried.stderr));
    }
}

/// The words of a command; what takes minutes without all optimisation is asked of few pixels, where it goes the same way.
fn as_typed(command: &str) -> Vec<&str> {
    let mut words: Vec<&str> = command.split(' ').collect();
    if words[0] == "report" || words.contains(&"--samples") {
        words.extend(["--size", "8x5"]);
    }
    words
}

#[test]
fn every_example_in_the_help_works_as_typed() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let help = text(&run(folder.path(), &["--help"]).stdout);
    let examples: Vec<&str> = help.lines().filter_map(|line| line.strip_prefix("  cargo run --release -- ")).collect();
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
    let camera_rays = stages.iter().find(|stage| stage["stage"] == "Turn rays into the world").expect("a stage");
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
            .args(["render", "cover", "--size", "3840x2160", "--threads", "1"])
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
            assert!(said.contains("stopped before the picture was done; nothing was written"), "{said}");
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

#[test]
fn the_readme_opens_with_the_cover_that_the_kit_renders_now() {
    let cover = chapter("cover");
    let now = render(&cover.world(&Asked::default()), &cover.stages(), &Execution::default(), &()).expect("renders");
    let now = png_bytes(&now.film, Curve::Srgb).expect("encodes");
    let kept = fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("chapters/cover/cover.png")).expect("kept");
    let pixels = |bytes: &[u8]| image::load_from_memory(bytes).expect("a PNG").into_rgb8();
    assert!(
        pixels(&now) == pixels(&kept),
        "the README shows another cover than the kit renders: look at both, then\n  \
         cargo run --release -- render cover --quiet -o chapters/cover/cover.png"
    );
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
        let told = run(folder.path(), &as_typed(words));
        assert!(told.status.success(), "{words}: {}", text(&told.stderr));
        tried += 1;
    }
    assert!(tried >= 4, "the README's list of commands is gone");
}
