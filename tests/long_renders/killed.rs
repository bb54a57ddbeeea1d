//! The program is killed at random moments and begun again with `--resume`.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

const COMMAND: [&str; 12] = [
    "render",
    "05_pinhole",
    "--size",
    "64x36",
    "--samples",
    "2500",
    "--threads",
    "1",
    "--write-every",
    "20ms",
    "--layers",
    "position,variance",
];

fn pinhole(folder: &Path, more: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pinhole"));
    command.current_dir(folder).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command.args(COMMAND).args(more);
    command
}

fn run(folder: &Path, more: &[&str]) -> Output {
    pinhole(folder, more).output().expect("the program starts")
}

fn picture(folder: &Path) -> [Vec<u8>; 2] {
    ["exr", "png"].map(|ending| fs::read(folder.join("out/05_pinhole").with_extension(ending)).expect("a picture"))
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("the program speaks UTF-8")
}

/// A number from 0 to below 1 from another.
fn scattered(number: u64) -> f64 {
    let mixed = (number + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    ((mixed ^ mixed >> 29).wrapping_mul(0xBF58_476D_1CE4_E5B9) >> 40) as f64 / (1_u64 << 24) as f64
}

fn kill_after(mut child: Child, wait: Duration) -> bool {
    thread::sleep(wait);
    let still_ran = child.try_wait().expect("it can be asked").is_none();
    child.kill().expect("killed, or over already");
    child.wait().expect("it ends");
    still_ran
}

#[test]
fn ten_kills_at_random_moments_change_no_bit() {
    let began = Instant::now();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let whole = run(folder.path(), &[]);
    assert!(whole.status.success(), "{}", text(&whole.stderr));
    let expected = picture(folder.path());
    let took = began.elapsed();

    let folder = tempfile::tempdir().expect("a temporary folder");
    let (mut killed, mut continued, mut pace) = (0, 0, 1.0);
    for number in 0..10 {
        // Long enough on average for a tenth of the render, short enough that some end before anything is written.
        let wait = took.mul_f64(pace * (0.02 + 0.18 * scattered(number)));
        let more: &[&str] = if number == 0 { &[] } else { &["--resume"] };
        let child = pinhole(folder.path(), more).spawn().expect("the program starts");
        let in_time = kill_after(child, wait);
        // The first run may have been slow, where the machine was busy with something else.
        pace *= if in_time { 1.0 } else { 0.5 };
        killed += u32::from(in_time);
        let checkpoint = folder.path().join("out/05_pinhole.checkpoint");
        continued += u32::from(checkpoint.exists());
        let parts = fs::read_dir(folder.path().join("out")).map(|entries| entries.count()).unwrap_or(0);
        eprintln!("killed after {wait:?}; {parts} files");
    }
    let last = run(folder.path(), &["--resume"]);
    assert!(last.status.success(), "{}", text(&last.stderr));
    assert!(text(&last.stderr).contains("continuing from out/05_pinhole.checkpoint"), "{}", text(&last.stderr));
    assert!(picture(folder.path()) == expected, "another picture than that of one run");
    assert!(killed >= 5 && continued >= 5, "{killed} killed, {continued} with a checkpoint");
    eprintln!("kills: {killed} of 10 while it ran, {continued} with a checkpoint; {:?} altogether", began.elapsed());
}

#[test]
fn ctrl_c_writes_what_there_is_and_says_how_to_go_on_and_more_samples_continue_a_finished_render() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let more = ["-o", "picture.exr", "--samples"];
    let mut child = pinhole(folder.path(), &["-o", "picture.exr"]).spawn().expect("the program starts");
    let kept = folder.path().join("picture.checkpoint");
    while !kept.exists() && child.try_wait().expect("it runs or has ended").is_none() {
        thread::sleep(Duration::from_millis(10));
    }
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    if sent.is_ok_and(|sent| sent.success()) {
        let ended = child.wait_with_output().expect("it ends");
        if ended.status.code() == Some(130) {
            let said = text(&ended.stderr);
            assert!(said.contains("picture.exr and .checkpoint hold what there is"), "{said}");
            assert!(folder.path().join("picture.exr").exists() && folder.path().join("picture.checkpoint").exists());
            eprint!("{said}");
        }
    } else {
        child.kill().expect("killed");
        child.wait().expect("it ends");
    }

    let render = |folder: &Path, samples: &str, resume: &[&str]| {
        let words = [&more[..2], resume].concat();
        let mut command = Command::new(env!("CARGO_BIN_EXE_pinhole"));
        command.current_dir(folder).stdin(Stdio::null());
        command.args(["render", "05_pinhole", "--size", "64x36", "--write-every", "1ms", "--samples", samples]);
        let ended = command.args(words).output().expect("the program starts");
        assert!(ended.status.success(), "{}", text(&ended.stderr));
        (text(&ended.stderr), fs::read(folder.join("picture.exr")).expect("a picture"))
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (_, expected) = render(folder.path(), "24", &[]);
    let (_, fewer) = render(folder.path(), "9", &[]);
    assert!(fewer != expected);
    let (said, after) = render(folder.path(), "24", &["--resume"]);
    assert!(said.contains("continuing from picture.checkpoint, 9 samples a pixel"), "{said}");
    assert!(after == expected, "9 samples and 15 more are not 24");
    fs::remove_file(folder.path().join("picture.checkpoint")).expect("there");
    let (said, after) = render(folder.path(), "24", &["--resume"]);
    assert!(said.contains("there is no picture.checkpoint to continue from, so the render begins anew"), "{said}");
    assert!(after == expected);
}
