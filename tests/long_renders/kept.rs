//! What is kept of a long render whatever comes between: checkpoints of others, a disk that is full, several writers.

use super::kill::{checkpoints, picture, run, text};
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

fn pinhole(folder: &Path, words: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pinhole"));
    command.current_dir(folder).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command.args(words.split(' '));
    command
}

fn ended(folder: &Path, words: &str) -> Output {
    pinhole(folder, words).output().expect("the program starts")
}

fn said(ended: &Output) -> String {
    text(&ended.stderr)
}

/// Waits until something is true of a folder while the program runs.
fn until(child: &mut Child, holds: impl Fn() -> bool) {
    let began = Instant::now();
    while !holds() {
        assert!(child.try_wait().expect("known").is_none(), "it ended too soon");
        assert!(began.elapsed() < Duration::from_secs(60), "it never came true");
        thread::sleep(Duration::from_millis(5));
    }
}

/// A short render once removed whatever was called like its checkpoint, and a render of fewer samples that of more.
#[test]
fn a_checkpoint_of_more_samples_stays_and_is_mentioned() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path();
    let render = |more: &str| ended(path, &format!("render 5 --size 16x9 -q {more}"));
    assert!(render("-n 40 --write-every 1ms -o w.exr").status.success());
    let (full, expected) =
        (fs::read(path.join("w.checkpoint")).expect("kept"), fs::read(path.join("w.exr")).expect("written"));
    for more in
        ["-n 4 -o w.exr", "-n 4 -o w.png", "-n 4 --write-every 1ms -o w.exr", "-n 39 --write-every 1ms -o w.png"]
    {
        let fewer = render(more);
        assert!(fewer.status.success(), "{more}: {}", said(&fewer));
        assert!(said(&fewer).contains("w.checkpoint holds 40 samples a pixel of this very render"), "{}", said(&fewer));
        assert!(fs::read(path.join("w.checkpoint")).expect("kept") == full, "{more}");
    }
    let resumed = render("-n 40 --resume -o w.exr");
    assert!(said(&resumed).contains("continuing from w.checkpoint, 40 samples a pixel"), "{}", said(&resumed));
    assert!(fs::read(path.join("w.exr")).expect("written") == expected);
    assert!(render("-n 41 --write-every 1ms -o w.exr").status.success());
    assert!(fs::read(path.join("w.checkpoint")).expect("kept") != full, "more samples replace fewer");
    let fast = render("-n 2 -o other.exr");
    assert!(fast.status.success() && !path.join("other.checkpoint").exists(), "nothing worth keeping");
}

/// Of four renders into one file, each has a checkpoint of its own, and goes on from it to its own bits.
#[test]
fn four_writers_lose_nothing_of_each_other() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path();
    let words = |seed: u32, output: &str| {
        format!("render 5 --size 32x18 -q --threads 1 -n 60 --seed {seed} --write-every 5ms -o {output}.exr")
    };
    let expected: Vec<Vec<u8>> = (0..4)
        .map(|seed| {
            assert!(ended(path, &words(seed, "alone")).status.success());
            fs::read(path.join("alone.exr")).expect("written")
        })
        .collect();
    assert_eq!(checkpoints(path).len(), 4, "{:?}", checkpoints(path));
    let together: Vec<Child> = (0..4).map(|seed| pinhole(path, &words(seed, "w")).spawn().expect("starts")).collect();
    for child in together {
        let ended = child.wait_with_output().expect("ends");
        assert!(ended.status.success(), "{}", said(&ended));
    }
    let last = fs::read(path.join("w.exr")).expect("written");
    assert!(expected.contains(&last), "the picture is that of one of them");
    assert_eq!(checkpoints(path).len(), 8, "{:?}", checkpoints(path));
    for (seed, expected) in expected.iter().enumerate() {
        let resumed = ended(path, &(words(seed as u32, "w") + " --resume"));
        assert!(said(&resumed).contains("60 samples a pixel"), "{}", said(&resumed));
        assert!(fs::read(path.join("w.exr")).expect("written") == *expected, "seed {seed}");
    }
    let twins: Vec<Child> = (0..4).map(|_| pinhole(path, &words(7, "twin")).spawn().expect("starts")).collect();
    for twin in twins {
        assert!(twin.wait_with_output().expect("ends").status.success());
    }
    let twin = fs::read(path.join("twin.exr")).expect("written");
    assert!(ended(path, &words(7, "alone")).status.success());
    assert!(fs::read(path.join("alone.exr")).expect("written") == twin, "four of the same make the same picture");
}

/// A place that cannot be written to for a while ends nothing, and the picture is there in the end.
#[test]
fn what_cannot_be_written_is_written_later() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (path, place) = (folder.path(), folder.path().join("w.exr"));
    let words = "render 5 --size 64x36 --threads 1 -n 2500 --write-every 20ms -q -o w.exr";
    let mut child = pinhole(path, words).spawn().expect("the program starts");
    until(&mut child, || place.exists() && path.join("w.checkpoint").exists());
    // Between two writes there may be a new picture again.
    while fs::create_dir(&place).is_err() {
        let _ = fs::remove_file(&place);
    }
    thread::sleep(Duration::from_millis(300));
    fs::remove_dir(&place).expect("a folder");
    let later = child.wait_with_output().expect("it ends");
    assert!(later.status.success(), "{}", said(&later));
    assert!(said(&later).contains("a folder of that name is in the way; "), "{}", said(&later));
    let expected = fs::read(&place).expect("written in the end");

    // Where the picture never can be, its samples are in the checkpoint.
    fs::remove_file(&place).expect("removed");
    fs::remove_file(path.join("w.checkpoint")).expect("removed");
    let mut child = pinhole(path, words).spawn().expect("the program starts");
    until(&mut child, || place.exists() && path.join("w.checkpoint").exists());
    while fs::create_dir(&place).is_err() {
        let _ = fs::remove_file(&place);
    }
    let never = child.wait_with_output().expect("it ends");
    assert_eq!(never.status.code(), Some(1), "{}", said(&never));
    assert!(
        said(&never).contains("all samples are in w.checkpoint, and the same command with --resume"),
        "{}",
        said(&never)
    );
    fs::remove_dir(&place).expect("a folder");
    let resumed = ended(path, &format!("{words} --resume"));
    assert!(resumed.status.success() && fs::read(&place).expect("written") == expected, "{}", said(&resumed));
}

/// No file may be longer than a few KiB, which is as if the disk were full.
#[test]
#[cfg(target_os = "linux")]
fn on_a_full_disk_earlier_files_stay_and_no_part_is_left() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path();
    assert!(ended(path, "render 5 --size 64x36 -q -n 2 --write-every 1ms -o w.exr").status.success());
    let before = ["w.exr", "w.checkpoint"].map(|name| fs::read(path.join(name)).expect("written"));
    for words in
        ["render 5 --size 64x36 -q -n 9 -o w.exr", "render 5 --size 64x36 -q -o w.exr", "figure 05_pinhole -o f.svg"]
    {
        let mut command = Command::new("sh");
        command.args(["-c", &format!("trap '' XFSZ; ulimit -f 2; exec \"$0\" {words}"), env!("CARGO_BIN_EXE_pinhole")]);
        let full = command.current_dir(path).stdin(Stdio::null()).output().expect("a shell");
        assert_eq!(full.status.code(), Some(1), "{words}: {}", said(&full));
        assert!(said(&full).contains("cannot write "), "{words}: {}", said(&full));
        let after = ["w.exr", "w.checkpoint"].map(|name| fs::read(path.join(name)).expect("still there"));
        assert!(after == before, "{words}");
        let names: Vec<String> = fs::read_dir(path)
            .expect("listed")
            .map(|entry| entry.expect("listed").file_name().to_string_lossy().into_owned())
            .collect();
        assert_eq!(names.len(), 2, "{words}: {names:?}");
    }
}

#[test]
fn killed_at_once_it_begins_anew() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let first = run(folder.path(), &["--resume"]);
    assert!(first.status.success() && text(&first.stderr).contains("begins anew"), "{}", text(&first.stderr));
    assert!(picture(folder.path()).iter().all(|bytes| !bytes.is_empty()));
}

/// A scene that is edited and rendered again and again leaves no row of checkpoints, and each render is done at once.
#[test]
fn other_checkpoints_are_no_hindrance() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path();
    let words = |seed: u32| format!("render 5 --size 16x9 -q -n 3 --seed {seed} -o w.png");
    assert!(ended(path, &(words(0) + " --write-every 1ms")).status.success());
    for seed in 1..4 {
        let other = ended(path, &words(seed));
        assert!(said(&other).contains("w.checkpoint is no checkpoint of this render and stays"), "{}", said(&other));
        assert_eq!(checkpoints(path), ["w.checkpoint"]);
    }
    for number in 2..=9 {
        fs::write(path.join(format!("w-{number}.checkpoint")), "precious").expect("written");
    }
    let began = Instant::now();
    let none = ended(path, &(words(5) + " --write-every 1ms"));
    assert!(none.status.success() && said(&none).contains("this render leaves no checkpoint"), "{}", said(&none));
    assert!(began.elapsed() < Duration::from_secs(5), "it waited for a name");
    assert_eq!(checkpoints(path).len(), 9);
}
