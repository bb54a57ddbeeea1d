//! How much is said, where, and in what name.

use super::{names, pinhole, run, text};
use pinhole_cli::command;
use std::fs;
use std::process::Stdio;
use std::time::{Duration, Instant};

#[test]
fn no_render_ends_in_more_than_six_lines_or_wider_ones_than_120_columns() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (mut max, mut widest, mut tried) = (0, 0, 0);
    let mut look = |what: &str, said: &str| {
        let columns = said.lines().map(|line| line.chars().count()).max().unwrap_or(0);
        (max, widest, tried) = (max.max(said.lines().count()), widest.max(columns), tried + 1);
        assert!((1..=6).contains(&said.lines().count()) && columns <= 120, "{what}: {columns} columns\n{said}");
    };
    let all = chapters::all();
    let render = |words: &[&str]| {
        let mut out = Vec::new();
        command::run(&all, words, &mut out).expect("renders");
        text(&out)
    };
    let picture = folder.path().join("picture.png").display().to_string();
    for chapter in &all {
        look(chapter.name, &render(&["render", chapter.name, "--size", "8x5", "-o", &picture]));
    }
    for more in [["--error", "0.5"], ["--time", "1ms"], ["--view", "surface"], ["--samples", "3"]] {
        look(more[0], &render(&["render", "21", "--size", "8x5", "-o", &picture, more[0], more[1]]));
    }
    let long = format!("{}.ron", "name".repeat(50));
    let scene = run(folder.path(), &["export", "5"]).stdout;
    fs::write(folder.path().join(&long), scene).expect("written");
    look("a long name", &text(&run(folder.path(), &["render", &long, "--size", "8x5"]).stdout));
    eprintln!("summaries: {tried} renders, at most {max} lines, the widest of {widest} columns");
}

/// A message about a model names each file once, the material whose image is missing, and the line of a wrong index.
#[test]
fn a_model_is_refused_and_remarked_on_with_each_name_once() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let square = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n";
    let buffer = r#"{"asset": {"version": "2.0"}, "buffers": [{"uri": "gone.bin", "byteLength": 36}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}]}"#;
    for (name, content) in [
        ("x.glb", "hello"),
        ("e.gltf", buffer),
        ("b.obj", &format!("mtllib b.mtl\n{square}usemtl wood\nf 1/1 2/2 3/3\nusemtl oak\nf 2/2 1/1 3/3\n")),
        ("b.mtl", "newmtl wood\nmap_Kd gone.png\nnewmtl oak\nmap_Kd gone.png\nnewmtl ash\nmap_Kd folder.png\n"),
        ("d.obj", &format!("{square}f 1 2 3\n# a line\nf 1 2 9\nf 8 1 2\n")),
        ("one.obj", &format!("{square}f 1/9 2 3\n")),
        ("scene.ron", "[(name: \"eye\", perspective_camera: ()), (name: \"m\", mesh: (file: \"x.glb\"), matte: ())]"),
    ] {
        fs::write(folder.path().join(name), content).expect("written");
    }
    let mut tried = 0;
    for (name, status, words, names) in [
        ("x.glb", 1, &["the start of the file is \"hello\""][..], &[("x.glb", 1)][..]),
        ("e.gltf", 1, &["buffers[0].uri is \"gone.bin\""], &[("e.gltf", 1)]),
        // As the value, and where it is said what is wrong with it.
        ("scene.ron", 1, &["mesh \"m\"", "cannot be read: the start of the file"], &[("x.glb", 2)]),
        ("b.obj", 0, &["An image of the material \"wood\" and another is replaced"], &[("gone.png", 1)]),
        ("d.obj", 0, &["2 faces with a vertex that the file does not have were dropped (the first on line 9)."], &[]),
        ("one.obj", 0, &["and goes without (on line 7)."], &[]),
    ] {
        let told = run(folder.path(), &["render", name, "--size", "8x8", "--samples", "1"]);
        let said = text(&told.stderr);
        assert_eq!(told.status.code(), Some(status), "{said}");
        assert!(words.iter().all(|words| said.contains(words)), "{name}: {said}");
        for (file, times) in names {
            let line = said.lines().find(|line| line.contains(file) && !line.starts_with("rendering")).unwrap_or("");
            assert_eq!(line.matches(file).count(), *times, "{name}: {said}");
        }
        tried += 1;
    }
    eprintln!("models: {tried} messages, each file named once");
}

#[test]
fn who_waits_without_a_terminal_is_told_how_far_it_is() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let words = ["render", "10", "--size", "64x36", "--time", "2500ms", "-o", "a.png"];
    let began = Instant::now();
    let told = run(folder.path(), &words);
    let (noted, took) = (text(&told.stderr), began.elapsed());
    assert!(told.status.success(), "{noted}");
    let lines: Vec<&str> = noted.lines().filter(|line| line.starts_with("rendering 10_light_and_shadow: ")).collect();
    assert_eq!(lines[0], "rendering 10_light_and_shadow: 64 × 36 pixels");
    let tenths = &lines[1..];
    assert!(!tenths.is_empty() && tenths.len() as u64 <= took.as_secs(), "{took:?}: {noted}");
    assert!(tenths.iter().all(|line| line.contains("0 %") && line.ends_with(" left")), "{noted}");
    assert!(text(&told.stdout).contains("the time is up: "), "{}", text(&told.stdout));
    for quiet in [&["-q"][..], &["--format", "json"], &["--stats"]] {
        let told = run(folder.path(), &[&["render", "10", "--size", "64x36"], quiet].concat());
        assert!(told.stderr.is_empty(), "{}", text(&told.stderr));
    }
}

/// The first line comes before there is anything to see, not with it.
#[test]
fn what_is_rendered_is_told_at_once() {
    use std::io::{BufRead, BufReader};
    let folder = tempfile::tempdir().expect("a temporary folder");
    let began = Instant::now();
    let mut child = pinhole(folder.path()).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("it starts");
    let mut line = String::new();
    BufReader::new(child.stderr.take().expect("piped")).read_line(&mut line).expect("UTF-8");
    let took = began.elapsed();
    child.kill().expect("killed");
    child.wait().expect("it ends");
    assert_eq!(line, "rendering cover: 960 × 540 pixels\n");
    assert!(took < Duration::from_secs(10), "{took:?}");
}

#[test]
fn warnings_go_to_standard_error_with_quiet_too() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let words = ["render", "2", "--size", "16x9", "--layers", "uv", "-o", "a.exr"];
    for more in [&[][..], &["-q"], &["-v"]] {
        let told = run(folder.path(), &[&words, more].concat());
        let (said, noted) = (text(&told.stdout), text(&told.stderr));
        assert!(noted.contains("warning: the layer `uv` is empty"), "{more:?}: {noted}");
        assert!(!said.contains("warning") && !said.is_empty(), "{more:?}: {said}");
    }
    let told = run(folder.path(), &[&words[..], &["--format", "json"]].concat());
    let data: serde_json::Value = serde_json::from_slice(&told.stdout).expect("JSON");
    assert!(told.stderr.is_empty(), "{}", text(&told.stderr));
    let warned = data["warnings"].as_array().expect("a list");
    assert!(warned.iter().any(|warning| warning.as_str().is_some_and(|told| told.contains("`uv` is empty"))), "{data}");
    assert_eq!(data["files"], serde_json::json!(["a.exr"]));
}

#[test]
fn the_program_is_called_as_it_was_started() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let by = |cargo: bool| {
        let mut command = pinhole(folder.path());
        if !cargo {
            command.env_remove("CARGO");
        }
        text(&command.args(["render", "5", "--size", "16x9"]).output().expect("it starts").stdout)
    };
    assert!(by(true).contains("try next: cargo run -- trace 05_pinhole"), "{}", by(true));
    let name = std::path::Path::new(env!("CARGO_BIN_EXE_pinhole")).file_name().expect("a name").to_string_lossy();
    assert!(by(false).contains(&format!("try next: {name} trace 05_pinhole")), "{}", by(false));
}

#[test]
fn help_is_as_wide_as_the_terminal_and_coloured_where_it_can_be() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let help = |variables: &[(&str, &str)], words: &[&str]| {
        let told = pinhole(folder.path()).envs(variables.iter().copied()).args(words).output().expect("it starts");
        text(&told.stdout) + &text(&told.stderr)
    };
    let lists = help(&[], &["--help"]);
    let commands: Vec<&str> =
        lists.lines().filter_map(|line| line.strip_prefix("  ")?.split_once("  ")).map(|(name, _)| name).collect();
    let commands: Vec<&str> =
        commands.into_iter().filter(|name| !name.is_empty() && !name.starts_with([' ', '-'])).collect();
    assert!(commands.len() >= 19, "{commands:?}");
    for command in commands.iter().filter(|command| **command != "help") {
        let squeezed = help(&[("COLUMNS", "60")], &[command, "--help"]);
        // What is to be typed stands on one line.
        let lines = squeezed.lines().filter(|line| !line.starts_with("Usage: "));
        let columns = lines.map(|line| line.chars().count()).max().unwrap_or(0);
        assert!(columns <= 60, "{command}: {columns} columns\n{squeezed}");
        assert!(!squeezed.contains('\u{1b}'), "{command}: colours in a pipe");
    }
    let forced = [("CLICOLOR_FORCE", "1")];
    assert!(help(&forced, &["--help"]).contains("\u{1b}["), "no colours");
    assert!(help(&forced, &["lst"]).contains("\u{1b}["), "no colours");
    let off = [("CLICOLOR_FORCE", "0"), ("NO_COLOR", "1")];
    assert!(!help(&off, &["--help"]).contains('\u{1b}'), "colours in spite of NO_COLOR");
}

#[test]
fn workers_are_as_many_as_the_environment_says_and_fewer_than_asked_for_is_no_error() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let threads = |words: &[&str]| {
        let mut command = pinhole(folder.path());
        command.env("RAYON_NUM_THREADS", "3").args(["render", "5", "--size", "96x54", "--format", "json"]);
        let told = command.args(words).output().expect("it starts");
        let data: serde_json::Value = serde_json::from_slice(&told.stdout).expect("JSON");
        data["threads"].as_u64().expect("a number")
    };
    assert_eq!(threads(&[]), 3);
    assert_eq!(threads(&["-j", "2"]), 2);
    assert!((1..=100).contains(&threads(&["--threads", "100"])));
    assert_eq!(names(&folder.path().join("out")), ["05_pinhole.exr", "05_pinhole.png"]);
}

#[test]
fn without_preflight_nothing_is_foretold_and_the_picture_is_the_same() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scene = "[(perspective_camera: (fov: 40)), (sphere: (), matte: (), placement: (position: (0, 0, 9)))]";
    fs::write(folder.path().join("behind.ron"), scene).expect("written");
    let [told, untold] = [&[][..], &["--no-preflight"]].map(|flag| {
        let done = run(folder.path(), &[&["render", "behind.ron", "--size", "16x9", "-o", "a.exr"], flag].concat());
        assert!(done.status.success(), "{}", text(&done.stderr));
        (text(&done.stderr).contains("before rendering: "), fs::read(folder.path().join("a.exr")).expect("a picture"))
    });
    assert_eq!((told.0, untold.0), (true, false));
    assert_eq!(told.1, untold.1);
}

/// What a model lost is said by every command that reads it, not by `render` alone.
#[test]
fn every_command_that_reads_a_model_says_what_was_left_out() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path();
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
    fs::write(path.join("m.obj"), format!("mtllib m.mtl\n{square}usemtl a\nf 1/1 2/2 3/3 4/4\n")).expect("written");
    fs::write(path.join("m.mtl"), "newmtl a\nKd 1 1 1\nmap_Kd none.png\nd 0.5\nTr 0.5\n").expect("written");
    for words in [&["render", "m.obj", "--size", "8x5"][..], &["preflight", "m.obj"], &["export", "m.obj"]] {
        let told = run(path, words);
        let notes = text(&told.stderr);
        assert!(told.status.success(), "{words:?}: {notes}");
        for once in ["m.obj: 1 mesh has no vertex normals", "none.png"] {
            let lines = notes.lines().filter(|line| line.starts_with("note: ") && line.contains(once)).count();
            assert_eq!(lines, 1, "{words:?}, {once}: {notes}");
        }
        let false_words = ["doubleSided", "no direction", "opacity below"];
        assert!(!false_words.iter().any(|word| notes.contains(word)), "{words:?}: {notes}");
    }
}
