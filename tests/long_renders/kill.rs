//! The program is killed at random moments and begun again with `--resume`, as often as one likes.

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

/// What came of it.
#[derive(Clone, Copy, Debug)]
pub struct Kills {
    /// How many kills there were to be.
    pub asked: u32,
    /// Those that came while the program ran.
    pub killed: u32,
    /// Those after which there was a checkpoint.
    pub continued: u32,
    /// Whether the picture has the same bits as that of one run.
    pub same: bool,
    /// Pictures or checkpoints that could not be read after a kill.
    pub broken: u32,
}

/// The command, with more words.
pub fn pinhole(folder: &Path, more: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pinhole"));
    command.current_dir(folder).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command.args(COMMAND).args(more);
    command
}

/// What it says, once it has ended.
pub fn run(folder: &Path, more: &[&str]) -> Output {
    pinhole(folder, more).output().expect("the program starts")
}

/// The bytes of its two pictures.
pub fn picture(folder: &Path) -> [Vec<u8>; 2] {
    ["exr", "png"].map(|ending| fs::read(folder.join("out/05_pinhole").with_extension(ending)).expect("a picture"))
}

/// What the program has said.
pub fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("the program speaks UTF-8")
}

/// The names of all checkpoints in a folder.
#[allow(dead_code, reason = "the bench has no need of it")]
pub fn checkpoints(folder: &Path) -> Vec<String> {
    let names = fs::read_dir(folder).expect("listed").map(|entry| entry.expect("listed").file_name());
    let names = names.map(|name| name.to_string_lossy().into_owned());
    names.filter(|name| name.ends_with(".checkpoint")).collect()
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

/// Kills the program so often at random moments, resumes it each time, and compares the picture with that of one run.
///
/// Where there are many kills, several renders are killed one after another.
pub fn kills(asked: u32) -> Kills {
    const OF_ONE_RENDER: u32 = 10;
    let began = Instant::now();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let whole = run(folder.path(), &[]);
    assert!(whole.status.success(), "{}", text(&whole.stderr));
    let (expected, took) = (picture(folder.path()), began.elapsed());

    let mut told = Kills { asked, killed: 0, continued: 0, same: true, broken: 0 };
    let mut pace = 1.0;
    for first in (0..asked).step_by(OF_ONE_RENDER as usize) {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let own = OF_ONE_RENDER.min(asked - first);
        for number in 0..own {
            // Long enough on average for a part of the render, short enough that some end before anything is written.
            let wait = took.mul_f64(pace * (0.02 + 1.8 / f64::from(own) * scattered(u64::from(first + number))));
            let more: &[&str] = if number == 0 { &[] } else { &["--resume"] };
            let child = pinhole(folder.path(), more).spawn().expect("the program starts");
            let in_time = kill_after(child, wait);
            // The first run may have been slow, where the machine was busy with something else.
            pace *= if in_time { 1.0 } else { 0.5 };
            told.killed += u32::from(in_time);
            told.continued += u32::from(folder.path().join("out/05_pinhole.checkpoint").exists());
            let png = folder.path().join("out/05_pinhole.png");
            told.broken += u32::from(png.exists() && image::open(&png).is_err());
        }
        let last = run(folder.path(), &["--resume"]);
        assert!(last.status.success(), "{}", text(&last.stderr));
        told.same &= picture(folder.path()) == expected;
    }
    eprintln!("kills: {told:?}; {:?} altogether", began.elapsed());
    told
}
