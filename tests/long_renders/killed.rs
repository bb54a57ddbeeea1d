//! The program is killed at random moments and begun again with `--resume`.

use super::kill::{Kills, kills, pinhole, text};
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread;
use std::time::Duration;

#[test]
fn ten_kills_at_random_moments_change_no_bit() {
    let Kills { asked, killed, continued, same, broken } = kills(10);
    assert!(same, "another picture than that of one run");
    assert!(broken == 0 && killed * 2 >= asked && continued * 2 >= asked, "{killed} killed, {continued} continued");
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
    fs::remove_file(folder.path().join("picture.checkpoint")).expect("there");
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
