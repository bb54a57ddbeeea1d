//! What a person types is taken as it was meant, or refused with what would be taken.

use super::{names, pinhole, run, text};
use std::ffi::OsStr;
use std::fs;
use std::io::Write;
use std::process::Stdio;

/// Words, the status that they end with, and what stands in what is printed on standard output and on standard error.
type Row = (&'static str, i32, &'static [&'static str], &'static [&'static str]);

const FIRST: [&str; 2] = ["05_pinhole.png and .exr: 16 × 9 pixels, 1 sample each", "try next: "];

const ROWS: &[Row] = &[
    ("render 5 --size 16x9", 0, &FIRST, &["rendering 05_pinhole: 16 × 9 pixels"]),
    ("render chapter5 --size 16x9", 0, &FIRST, &[]),
    ("render PINHOLE --size 16", 0, &FIRST, &[]),
    ("render 5_pinhole --width 16", 0, &FIRST, &[]),
    ("render ./chapters/05_pinhole/ --height 9", 0, &FIRST, &[]),
    ("render chapters/05_pinhole/main.rs --size 16×9", 0, &FIRST, &[]),
    ("5 --size 16x9", 0, &FIRST, &[]),
    ("05_pinhole --width 16 --height 9", 0, &FIRST, &[]),
    ("chapters/05_pinhole --size 16x9", 0, &FIRST, &[]),
    ("scene.ron --size 16x9", 0, &["out/scene.png and .exr: 16 × 9 pixels", "trace scene.ron --pixel 8,4"], &[]),
    ("--format json 5 --size 10%", 0, &["\"width\": 48", "\"warnings\": []", "\"out/05_pinhole.exr\""], &[]),
    ("render 5 --size 16x9 --stats", 0, &["\"width\": 16", "\"files\": ["], &[]),
    ("render 5 --size 16x9 -q", 0, &["wrote out/05_pinhole.png and .exr\n"], &[]),
    ("render 5 --size 16x9 -v", 0, &["what ran", "what was left out, and why", "try next: "], &[]),
    ("render 5 out.png --size 16x9", 0, &["out.png: "], &[]),
    ("render 5 -o out.PNG --size 16x9", 0, &["out.PNG: "], &[]),
    ("render 5 -o a.png -o a.exr --size 16x9", 0, &["a.png and .exr: "], &[]),
    ("render 5 --spp 4 -j 2 --size 16x9", 0, &["4 samples each"], &[]),
    ("render 5 -n 0.01k --size 16x9", 0, &["10 samples each"], &[]),
    ("render 5 --samples 1e1 --size 16x9", 0, &["10 samples each"], &[]),
    ("plan 5 --size 1080p", 0, &["05_pinhole"], &[]),
    ("angles scene.ron", 0, &["scene.ron: 480 x 270 pixels", "vertical"], &[]),
    ("conventions scene.ron", 0, &["camera of scene.ron, 480 x 270 pixels", "Blender"], &[]),
    ("list", 0, &["10_light_and_shadow  ", "05_pinhole           "], &[]),
    ("help list", 0, &["Usage: cargo run -- list"], &[]),
    ("--version", 0, &["pinhole 0."], &[]),
    ("render 77", 2, &[], &["there is no chapter 77; the chapters go from 1 to 39", "list` shows all"]),
    ("77", 2, &[], &["the chapters go from 1 to 39"]),
    ("lst", 2, &[], &["unrecognized subcommand 'lst'", "'list'", "Usage: "]),
    ("pinhol", 2, &[], &["unrecognized subcommand", "-- 05_pinhole"]),
    ("render pinhol", 2, &[], &["the nearest is 05_pinhole,"]),
    ("render glas", 2, &[], &["the nearest is 20_glass,"]),
    ("render caustic", 2, &[], &["the nearest is 27_caustics,"]),
    ("render xyzzy", 2, &[], &["none has a similar name", "list` shows all"]),
    ("render x.stl", 2, &[], &["cannot read x.stl: models are read from .gltf, .glb, .obj and .ply files", ".ron"]),
    ("x.gltf", 1, &[], &["x.gltf", "no such file"]),
    ("render 5 -o out.jpg", 2, &[], &["cannot write out.jpg", ".png", ".exr"]),
    ("render 5 -o out.hdr", 2, &[], &["cannot write out.hdr", ".png", ".exr"]),
    ("render 5 -o folder/", 2, &[], &["cannot write folder/", ".png", ".exr"]),
    ("render 5 --time 1", 2, &[], &["such as 10s", "--help"]),
    ("render 5 --gamma 2", 2, &[], &["unexpected argument '--gamma'", "Usage: "]),
    ("render 5 --widht 96", 2, &[], &["'--width'"]),
    ("render 5 --sample 4", 2, &[], &["'--samples'", "Usage: "]),
    ("render 5 --sample=4", 2, &[], &["'--samples'"]),
    ("render 5 --resum", 2, &[], &["'--resume'"]),
    ("--format json plan 5 --sampl 4", 2, &[], &["'--samples'"]),
    ("render", 2, &[], &["<CHAPTER>", "Usage: "]),
    ("render 5 --resume", 2, &[], &["there is nothing to continue"]),
    ("render 5 --watch", 2, &[], &["cannot watch 5"]),
    ("render scene.ron --watch --format json", 2, &[], &["cannot watch scene.ron"]),
    ("measure scene.ron", 2, &[], &["scene.ron is a scene file, but this command takes a chapter"]),
    ("cost scene.ron", 2, &[], &["scene.ron is a scene file, but this command takes a chapter"]),
    ("render gone.ron", 1, &[], &["pinhole: gone.ron: "]),
    ("render 5 --view list", 1, &[], &["the columns on offer are"]),
    ("render 5 -o file/a.png", 1, &[], &["cannot write file/a.png"]),
];

#[test]
fn words_mean_what_a_person_means_by_them() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scene = text(&run(folder.path(), &["export", "5"]).stdout);
    fs::write(folder.path().join("scene.ron"), scene).expect("written");
    fs::write(folder.path().join("file"), "in the way").expect("written");
    let mut wrong = Vec::new();
    for (words, status, out, notes) in ROWS {
        let words: Vec<&str> = words.split(' ').collect();
        let told = run(folder.path(), &words);
        let (said, noted) = (text(&told.stdout), text(&told.stderr));
        let missing = |text: &str, words: &[&str]| words.iter().any(|word| !text.contains(word));
        if told.status.code() != Some(*status) || missing(&said, out) || missing(&noted, notes) {
            wrong.push(format!("{words:?} ended with {:?}:\n{said}---\n{noted}", told.status.code()));
        }
        if *status != 0 {
            assert!(said.is_empty(), "{words:?}: {said}");
            assert!(
                *status == 2 || noted.lines().filter(|line| !line.starts_with("rendering ")).count() == 1,
                "{noted}"
            );
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
    eprintln!("words: {} command lines taken as they were meant", ROWS.len());
}

#[test]
fn a_picture_goes_through_a_pipe_and_a_scene_comes_through_one() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scene = run(folder.path(), &["export", "5"]).stdout;
    let mut child = pinhole(folder.path())
        .args(["render", "-", "--size", "16x9", "-o", "-", "-o", "a.png"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    child.stdin.take().expect("piped").write_all(&scene).expect("taken");
    let told = child.wait_with_output().expect("it ends");
    let noted = text(&told.stderr);
    assert!(told.status.success(), "{noted}");
    assert!(told.stdout == fs::read(folder.path().join("a.png")).expect("written"), "not the bytes of the file");
    assert!(noted.contains("rendering the scene on standard input: 16 × 9 pixels"), "{noted}");
    assert!(noted.contains("standard output and a.png: 16 × 9 pixels"), "{noted}");
    // Of several samples, the picture is written once and no checkpoint is kept.
    let told = run(folder.path(), &["render", "5", "-n", "2", "--size", "16x9", "-o", "-"]);
    assert!(told.status.success() && told.stdout.starts_with(b"\x89PNG"), "{}", text(&told.stderr));
    assert_eq!(names(folder.path()), ["a.png"]);
    let told = run(folder.path(), &["plan", "-"]);
    let noted = text(&told.stderr);
    assert!(told.status.code() == Some(1) && noted.starts_with("pinhole: standard input:1:1: "), "{noted}");
}

#[test]
#[cfg(unix)]
fn words_that_are_no_text_are_no_panic() {
    use std::os::unix::ffi::OsStrExt;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scene = run(folder.path(), &["export", "5"]).stdout;
    let odd = |bytes: &'static [u8]| OsStr::from_bytes(bytes);
    let file = odd(b"odd\xff.ron");
    if fs::write(folder.path().join(file), &scene).is_ok() {
        let mut command = pinhole(folder.path());
        command.args([odd(b"render"), file]).args(["--size", "8x8", "-q", "-o"]).arg(odd(b"odd\xff.png"));
        let told = command.output().expect("the program starts");
        assert!(told.status.success(), "{}", text(&told.stderr));
        assert!(folder.path().join(odd(b"odd\xff.png")).is_file());
    }
    for words in [
        [odd(b"render"), odd(b"\xff")],
        [odd(b"plan"), odd(b"\xff5")],
        [odd(b"\xff"), odd(b"5")],
        [odd(b"check"), odd(b"\xff")],
    ] {
        let told = pinhole(folder.path()).args(words).output().expect("the program starts");
        let noted = String::from_utf8_lossy(&told.stderr).into_owned();
        assert_eq!(told.status.code(), Some(2), "{words:?}: {noted}");
        assert!(!noted.contains("panicked"), "{noted}");
    }
}

#[test]
fn a_hint_is_quoted_for_a_shell() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scene = run(folder.path(), &["export", "5"]).stdout;
    for name in ["a b.ron", "$(touch x).ron", "a;b'c.ron", "wow!.ron"] {
        fs::write(folder.path().join(name), &scene).expect("written");
        let said = text(&run(folder.path(), &["render", name, "--size", "16x9"]).stdout);
        for (before, command) in [("try next: ", "trace"), ("left out: ", "plan")] {
            let hint = said.lines().find_map(|line| line.split_once(before)).expect("a hint").1;
            let words = shlex::split(hint).expect("a shell's words");
            assert_eq!(words[..5], ["cargo", "run", "--", command, name], "{hint}");
        }
    }
}

#[test]
fn every_shell_has_its_completions() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let told = run(folder.path(), &["completions", shell]);
        let script = text(&told.stdout);
        assert!(told.status.success() && script.contains("pinhole") && script.contains("closed-forms"), "{shell}");
        assert!(!script.contains("--spp"), "{shell}: an alias that stays out of the help");
    }
}
