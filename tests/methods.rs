//! `methods` as a reader runs it: what it chooses and why, what each method lacks, what it refuses.

use crate::scenes::public::public;
use pinhole::scene::{LightStrategy, SceneFile, scene_text};
use serde_json::Value;
use std::path::Path;
use std::process::Command;

const METHODS: [&str; 4] = ["path_tracing", "light_tracing", "photon_mapping", "bidirectional_path_tracing"];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// What the program prints, in a process of its own, whose processor time no other test shares.
fn printed(words: &str) -> Result<String, String> {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pinhole"));
    let done = command.current_dir(root()).args(words.split(' ')).output().expect("the program starts");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
    if done.status.success() { Ok(text(done.stdout)) } else { Err(text(done.stderr)) }
}

/// A small pilot of a scene.
fn pilot(scene: &str) -> Value {
    // Photons are gathered within a few pixels, so that their blocks need others around them.
    let size = if scene.contains("caustic") || scene.contains("sun") { "48x32" } else { "24x15" };
    let words = format!("methods {scene} --size {size} --samples 16 --seeds 8 --format json");
    serde_json::from_str(&printed(&words).expect("measured")).expect("one JSON value")
}

/// What a pilot found of each method.
fn rows(pilot: &Value) -> impl Iterator<Item = (&str, &Value)> {
    let rows = pilot["methods"].as_array().expect("methods");
    rows.iter().map(|row| (row["method"].as_str().expect("a name"), row))
}

/// A hole that only paths from the lamp find; a ground that only photons reach; a room that is lit from everywhere in it.
#[test]
fn the_method_that_suits_a_scene_is_chosen() {
    for (scene, accepted, asks) in [
        ("39", &["bidirectional_path_tracing"][..], false),
        ("tests/methods/pool.ron", &["photon_mapping"], false),
        ("tests/methods/room.ron", &["path_tracing"], false),
        // All that find its light differ by less than the noise of the clock; path tracing does not find it.
        ("tests/methods/sun.ron", &["light_tracing", "photon_mapping", "bidirectional_path_tracing"], true),
        ("tests/methods/caustic_in_mirror.ron", &["photon_mapping"], true),
    ] {
        let told = pilot(scene);
        let chosen = told["chosen"].as_str().expect("a name");
        assert!(accepted.contains(&chosen), "{scene}: {told:#}");
        let asked = if asks { format!("`{chosen}: ()` on the camera") } else { "the scene does so already".into() };
        assert_eq!(told["ask"], asked, "{scene}");
        assert!(rows(&told).map(|(name, _)| name).eq(METHODS), "{scene}");
        eprintln!("{scene}: {chosen}: {}", told["why"].as_str().expect("a sentence"));
    }
}

/// A cell of the page's table: what a method does not find of a scene's light.
fn cell(pilot: &Value, method: &str) -> String {
    let (_, row) = rows(pilot).find(|(name, _)| *name == method).expect("a row");
    if let Some(other) = row["same_as"].as_str() {
        return cell(pilot, other);
    }
    if row["refused"].is_string() {
        return "refused".into();
    }
    let lacks = &row["measured"]["lacks"];
    let percent = 100.0 * lacks["fraction"].as_f64().expect("a number");
    match lacks["beyond_noise"] == true {
        true if percent >= 1.0 => format!("{percent:.0} %"),
        true => format!("{percent:.1} %"),
        false => "0".into(),
    }
}

/// What each method cannot find stands on the page as it is measured.
#[test]
fn the_page_s_table_of_what_is_not_found_is_measured() {
    let page = std::fs::read_to_string(root().join("book/src/methods.md")).expect("the page");
    let mut missing = Vec::new();
    for (what, scene) in [
        ("lamp behind a keyhole", "39"),
        ("point light through glass", "tests/methods/caustic.ron"),
        ("the same, seen in a mirror", "tests/methods/caustic_in_mirror.ron"),
        ("sun through glass", "tests/methods/sun.ron"),
        ("point light through rough glass", "tests/methods/rough_glass.ron"),
        ("point light through glass that disperses", "tests/methods/prism.ron"),
        ("point light in fog", "tests/methods/fog.ron"),
        ("point light through glass in fog", "tests/methods/fog_caustic.ron"),
    ] {
        let told = pilot(scene);
        if scene.contains("mirror") {
            let variance = |at: usize| told["methods"][at]["measured"]["variance"]["value"][1].as_f64().expect("one");
            assert!(variance(2) > 1.6 * variance(0), "a picture without the light has little noise");
        }
        let cells = METHODS.map(|method| cell(&told, method)).join(" | ");
        let row = format!("| {what} | {cells} |");
        if !page.contains(&row) {
            missing.push(row);
        }
    }
    assert!(missing.is_empty(), "book/src/methods.md lacks\n{}", missing.join("\n"));
}

/// The page's efficiencies are those that are kept beside chapter 39.
#[test]
fn the_page_s_efficiencies_are_those_that_are_kept() {
    let read = |file: &str| std::fs::read_to_string(root().join(file)).expect("kept");
    let (page, kept) = (read("book/src/methods.md"), read("chapters/39_both_ends/curves.txt"));
    let mut missing = Vec::new();
    for (scene, begins, chosen) in [
        ("keyhole", "39_both_ends", METHODS[3]),
        ("pool", "tests/methods/pool.ron", METHODS[2]),
        ("Cornell box", "tests/methods/cornell.ron", METHODS[0]),
        ("Veach's plates", "tests/methods/veach.ron", METHODS[0]),
    ] {
        let lines = || kept.lines().skip_while(|line| !line.starts_with(&format!("{begins}: ")));
        let line = |method: &str| lines().find(|line| line.starts_with(&format!("{method} "))).expect("a line");
        let cells: Vec<String> = METHODS[1..].iter().map(|method| efficiency(line(method))).collect();
        let why = lines().find(|line| line.contains(": it lacks no light")).expect("a choice");
        assert!(why.starts_with(&format!("{chosen}: ")), "{why}");
        let row = format!("| {scene} | {} | {} |", cells.join(" | "), chosen.replace('_', " "));
        if !page.contains(&row) {
            missing.push(row);
        }
    }
    assert!(missing.is_empty(), "book/src/methods.md lacks\n{}", missing.join("\n"));
}

/// The efficiency in a line of a pilot's table, in two digits.
fn efficiency(line: &str) -> String {
    if line.contains(" by the same stages") {
        return "–".into();
    }
    let (before, after) = line.split_once(" (").expect("an interval");
    let ends = after.split(')').next().expect("its end").split(" to ");
    let numbers = before.rsplit(' ').next().into_iter().chain(ends);
    let two = |number: &str| match number.parse::<f64>().expect("a number") {
        large if large >= 10.0 => format!("{large:.0}"),
        one if one >= 1.0 => format!("{one:.1}"),
        small => format!("{small:.2}"),
    };
    let [value, low, high] = numbers.map(two).collect::<Vec<_>>().try_into().expect("three numbers");
    format!("{value} ({low} to {high})")
}

#[test]
fn a_method_that_is_refused_says_why_and_one_without_work_says_whose_it_does() {
    let text = printed("methods tests/methods/fog.ron --size 8x6 --samples 1 --seeds 4").expect("measured");
    let line = text.lines().find(|line| line.starts_with("photon_mapping")).expect("a line");
    assert!(line.contains("refused: camera \"camera\": ") && line.contains("with the medium"), "{line}");
    let folder = tempfile::tempdir().expect("a folder");
    let moving = folder.path().join("moving.ron");
    let still = std::fs::read_to_string(root().join("tests/methods/fog.ron")).expect("the scene");
    let moves =
        still.replace("matte:", "motion: (velocity: (1, 0, 0)), matte:").replace("medium:", "shutter: (), medium:");
    std::fs::write(&moving, moves).expect("written");
    let text = printed(&format!("methods {} --size 8x6 --samples 1 --seeds 4", moving.display())).expect("measured");
    for method in &METHODS[1..] {
        let line = text.lines().find(|line| line.starts_with(method)).expect("a line");
        assert!(line.contains("refused: camera \"camera\": ") || line.contains("by the same stages"), "{line}");
    }
    assert!(text.contains("path_tracing: no other method has anything to do here"), "{text}");
    let text = printed("methods tests/methods/room.ron --size 8x8 --samples 1 --seeds 4").expect("measured");
    for method in &METHODS[1..3] {
        let line = text.lines().find(|line| line.starts_with(method)).expect("a line");
        assert!(line.contains("as path_tracing, by the same stages"), "{line}");
    }
    for (words, why) in [
        ("methods 10", "10_light_and_shadow follows no paths that methods could differ in"),
        ("methods 39 --seeds 3", "3 is not in 4..=1024"),
        ("methods nothing", "there is no chapter \"nothing\""),
    ] {
        let refused = printed(words).expect_err(words);
        assert!(refused.contains(why), "{words}: {refused}");
    }
}

/// All but what depends on times; two methods are nearly as efficient, so that the choice between them does.
#[test]
fn a_pilot_is_the_same_twice() {
    let told = || {
        let mut told = pilot("tests/methods/caustic.ron");
        let own = told.as_object_mut().expect("a pilot");
        let chosen = own.remove("chosen").expect("a choice");
        let asked = own.remove("ask").expect("how to ask for it");
        assert!(["light_tracing", "bidirectional_path_tracing"].iter().any(|method| chosen == *method), "{chosen}");
        assert!(asked.as_str().is_some_and(|asked| asked.contains(chosen.as_str().expect("a name"))), "{asked}");
        for row in told["methods"].as_array_mut().expect("methods") {
            let measured = row["measured"].as_object_mut().expect("measured");
            assert!(measured.remove("seconds").is_some_and(|time| time.as_f64() > Some(0.0)));
            assert!(measured.remove("efficiency").is_some());
        }
        told
    };
    assert_eq!(told(), told());
}

/// The Cornell box and Veach's plates stand in scene files number for number as where pinhole is compared with others.
#[test]
fn the_scene_files_are_the_public_scenes() {
    for (file, name) in [("cornell", "cornell"), ("veach", "veach-mis")] {
        let path = root().join(format!("tests/methods/{file}.ron"));
        let kept = scene_text(&SceneFile::open(&path).expect("a scene").world()).expect("text");
        assert_eq!(kept, scene_text(&public(name, LightStrategy::Mis)).expect("text"), "{file}");
    }
}
