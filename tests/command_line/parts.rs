//! Pictures in parts: each by a process of its own, stopped and continued, merged; and the jobs that are written for farms.

use super::{names, pinhole, run, text};
use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread;
use std::time::Duration;

const SCENE: [&str; 5] = ["25", "--size", "64x36", "--samples", "150"];

fn with(folder: &Path, first: &[&str], more: &[&str]) -> Output {
    run(folder, &[first, &SCENE, more].concat())
}

fn picture(folder: &Path, words: &[&str]) -> Vec<u8> {
    let done = with(folder, &["render"], &[&["--quiet", "-o", "whole.exr"], words].concat());
    assert!(done.status.success(), "{}", text(&done.stderr));
    fs::read(folder.join("whole.exr")).expect("a picture")
}

#[test]
fn a_farm_on_this_machine_gives_the_picture_of_one_process() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let expected = picture(folder.path(), &[]);
    let mut tried = 0;
    for (parts, split) in [("2", "tiles"), ("3", "samples"), ("4", "both")] {
        for number in 1..=parts.parse().expect("a number") {
            let part = format!("{number}/{parts}");
            let done = with(folder.path(), &["render"], &["--part", &part, "--split", split, "-o", "a.exr"]);
            assert!(done.status.success(), "{}", text(&done.stderr));
            let merged = with(folder.path(), &["merge"], &["-o", "a.exr"]);
            let is_last = part == format!("{parts}/{parts}");
            assert_eq!(merged.status.code(), Some(if is_last { 0 } else { 75 }), "{}", text(&merged.stderr));
            assert!(is_last || text(&merged.stderr).contains("missing or unfinished of"), "{}", text(&merged.stderr));
            let said = text(&merged.stdout);
            assert!(said.contains("standard error is") || said.contains("more than 64 samples"), "{said}");
            tried += 1;
        }
        assert!(fs::read(folder.path().join("a.exr")).expect("a picture") == expected, "{parts} parts by {split}");
        for name in names(folder.path()).iter().filter(|name| name.starts_with("a.")) {
            fs::remove_file(folder.path().join(name)).expect("removed");
        }
    }
    let done = with(folder.path(), &["farm"], &["--parts", "3", "--local", "-o", "b.exr"]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    assert!(fs::read(folder.path().join("b.exr")).expect("a picture") == expected, "by farm");
    let said = with(folder.path(), &["merge"], &["-o", "b.exr", "--format", "json"]);
    let said: serde_json::Value = serde_json::from_slice(&said.stdout).expect("JSON");
    assert!(said["complete"] == true && said["parts"] == 3 && said["error"].as_f64().is_some_and(|error| error > 0.0));
    // What was merged is a checkpoint like any other.
    let more = with(folder.path(), &["render"], &["--resume", "-o", "b.exr"]);
    assert!(text(&more.stderr).contains("continuing from b.checkpoint, 150 samples"), "{}", text(&more.stderr));
    // A part of the image is divided like a whole one, and its parts are none of the whole image's.
    let crop = ["--crop", "9,3,45,30"];
    let expected = picture(folder.path(), &crop);
    let farm = [&["--parts", "3", "--local", "-o", "c.exr"], &crop[..]].concat();
    let done = with(folder.path(), &["farm"], &farm);
    assert!(done.status.success(), "{}", text(&done.stderr));
    assert!(fs::read(folder.path().join("c.exr")).expect("a picture") == expected, "cropped");
    let without = with(folder.path(), &["merge"], &["-o", "c.exr"]);
    assert!(text(&without.stderr).contains("it is a part of another scene"), "{}", text(&without.stderr));
    eprintln!("parts: {tried} processes, 5 merges, every bit that of one process");
}

#[test]
#[cfg(unix)]
fn a_part_that_is_stopped_ends_with_75_and_continues_to_the_same_bytes() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let long =
        ["render", "25", "--size", "96x54", "--samples", "300", "--part", "1/2", "-j", "1", "-o", "a.exr", "--resume"];
    let file = folder.path().join("a.part-1-of-2.checkpoint");
    let whole = run(folder.path(), &long);
    assert!(whole.status.success(), "{}", text(&whole.stderr));
    let expected = fs::read(&file).expect("a part");
    let mut stopped = 0;
    for pause in [400, 600, 800] {
        let _ = fs::remove_file(&file);
        let mut command = pinhole(folder.path());
        let words = [&long[..], &["--write-every", "20ms"]].concat();
        let mut child = command.args(words).stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("it starts");
        thread::sleep(Duration::from_millis(pause));
        let sent = Command::new("kill").args(["-TERM", &child.id().to_string()]).status();
        assert!(sent.is_ok_and(|sent| sent.success()) || child.try_wait().expect("known").is_some());
        let status = child.wait().expect("it ends").code();
        // 130 where the signal came before the command line was read.
        assert!([Some(75), Some(0), Some(130)].contains(&status), "{status:?}");
        stopped += u32::from(status == Some(75));
        let done = run(folder.path(), &long);
        assert!(done.status.success(), "{}", text(&done.stderr));
        assert!(fs::read(&file).expect("a part") == expected, "stopped after {pause} ms");
    }
    assert!(stopped > 0);
    eprintln!("parts: {stopped} of 3 stopped by SIGTERM with status 75, continued to the same bytes");
}

#[test]
fn what_cannot_be_a_part_is_refused_in_a_sentence() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (words, because) in [
        (&["render", "5", "--part", "0/4"][..], "such as 3/64"),
        (&["render", "5", "--part", "5/4"], "such as 3/64"),
        (&["render", "5", "--part", "3"], "such as 3/64"),
        (&["render", "5", "--split", "tiles"], "--part"),
        (&["render", "5", "--part", "1/2", "--time", "2s"], "--time"),
        (&["render", "5", "--part", "1/2", "--split", "rows"], "a split is one of tiles, samples, both"),
        (&["render", "5", "--part", "1/2", "-o", "-"], "beside the picture"),
        (&["merge", "5"], "there is no part to merge beside out/05_pinhole.png"),
        (&["farm", "5", "--parts", "4"], "--to"),
        (&["farm", "5", "--parts", "0", "--local"], "0"),
    ] {
        let done = run(folder.path(), words);
        let said = text(&done.stderr);
        assert!(!done.status.success() && said.contains(because), "{words:?}: {said}");
    }
    fs::write(folder.path().join("a.part-1-of-2.checkpoint"), "precious").expect("written");
    let done = run(folder.path(), &["render", "5", "--part", "1/2", "-o", "a.png"]);
    assert!(text(&done.stderr).contains("a.part-1-of-2.checkpoint is no part of this render and stays"));
    assert_eq!(fs::read(folder.path().join("a.part-1-of-2.checkpoint")).expect("there"), b"precious");
}

/// The jobs hold what their engines ask for, and the list of files that of the scene.
#[test]
fn jobs_are_written_for_each_engine() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let exported = run(folder.path(), &["export", "16", "-o", "a scene.ron"]);
    assert!(exported.status.success(), "{}", text(&exported.stderr));
    let file = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap_or_else(|_| panic!("no {name}"));
    let farm = |engine: &str| {
        let words =
            ["farm", "a scene.ron", "--size", "32x18", "-n", "4", "--parts", "2500", "--to", engine, "-o", "f.png"];
        let done = run(folder.path(), &words);
        assert!(done.status.success(), "{}", text(&done.stderr));
    };
    farm("slurm");
    let (sbatch, submit) = (file("f.sbatch"), file("f.submit.sh"));
    for wanted in ["#SBATCH --requeue", "--open-mode=append", "--signal=B:TERM@60", "--resume", "'a scene.ron'", "-j 1"]
    {
        assert!(sbatch.contains(wanted), "no {wanted} in {sbatch}");
    }
    assert_eq!(submit.matches("sbatch --parsable").count(), 3, "2,500 parts in arrays of 1,000: {submit}");
    assert!(submit.contains("--array=1-500 --export=ALL,BEFORE=2000"), "{submit}");
    farm("openjd");
    let template: serde_json::Value = serde_json::from_str(&file("f.template.json")).expect("JSON");
    assert_eq!(template["specificationVersion"], "jobtemplate-2023-09");
    assert_eq!(template["steps"][0]["parameterSpace"]["taskParameterDefinitions"][0]["range"], "1-2500");
    farm("parallel");
    let script = file("f.parallel.sh");
    assert!(script.contains("seq 2500 | parallel") && script.contains("--resume-failed --retries"), "{script}");
    let listed = file("f.files");
    for wanted in ["a scene.ron", "card.png", "evening.hdr"] {
        assert!(listed.lines().any(|line| line.ends_with(wanted)), "no {wanted} in {listed}");
    }
    assert!(!listed.contains("f.png"), "{listed}");
    #[cfg(unix)]
    for name in ["f.sbatch", "f.submit.sh", "f.parallel.sh"] {
        let read = Command::new("sh").arg("-n").arg(folder.path().join(name)).status().expect("sh");
        assert!(read.success(), "{name} is no shell script");
    }
}
