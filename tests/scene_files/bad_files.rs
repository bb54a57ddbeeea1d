//! Every refusal of a file: one sentence that begins with file, line and column.

use super::bad_cases::{Case, FORM, MEANING, WORDS};
use super::typed;
use std::fs;
use std::path::Path;

/// One camera, all well.
const CAMERA: &str = "(name: \"eye\", perspective_camera: (), resolution: (width: 8, height: 4))";

fn sentence(message: &str, what: &str) {
    assert!(!message.contains('\n') && !message.ends_with('.') && !message.contains(". "), "{what}: {message}");
    assert!(message.chars().count() <= 400, "{what}: {} letters: {message}", message.chars().count());
}

/// Line and column of the mark in a text, and the text without it.
fn marked(text: &str) -> (Option<(usize, usize)>, String) {
    let text = text.replace('@', CAMERA);
    let place = text.split_once('^').map(|(before, _)| {
        let line = before.rsplit('\n').next().unwrap_or("");
        (1 + before.matches('\n').count(), 1 + line.chars().count())
    });
    (place, text.replace('^', ""))
}

fn told(folder: &Path, bytes: &[u8]) -> String {
    let file = folder.join("scene.ron");
    fs::write(&file, bytes).expect("written");
    let file = file.display().to_string();
    let messages = [
        typed(&["plan", &file]).expect_err("the plan is refused").to_string(),
        typed(&["trace", &file, "--pixel", "0,0"]).expect_err("the trace is refused").to_string(),
        typed(&["render", &file, "-q", "-o", &folder.join("a.png").display().to_string()])
            .expect_err("the render is refused")
            .to_string(),
    ];
    assert!(!folder.join("a.png").exists(), "a picture of a refused scene");
    assert!(messages.iter().all(|message| *message == messages[0]), "{messages:?}");
    messages[0].replace(&file, "scene.ron").replace(&folder.display().to_string(), "folder")
}

#[test]
fn bad_scene_files() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut lines = Vec::new();
    let mut wrong = Vec::new();
    let cases: Vec<&Case> = [FORM, WORDS, MEANING].into_iter().flatten().collect();
    for (what, text, words) in cases {
        let (place, text) = marked(text);
        let message = told(folder.path(), text.as_bytes());
        sentence(&message, what);
        let place = place.map_or("scene.ron: ".into(), |(line, column)| format!("scene.ron:{line}:{column}: "));
        if !message.starts_with(&place) || words.iter().any(|word| !message.contains(word)) {
            wrong.push(format!("{what}: {place}{words:?}, but: {message}"));
        }
        lines.push(format!("{what:<32} {message}"));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let (_, good) = marked("[@]");
    fs::write(folder.path().join("scene.ron"), good).expect("written");
    typed(&["plan", &folder.path().join("scene.ron").display().to_string()]).expect("the camera alone is good");
    kept("bad_scene_files", &lines);
    eprintln!("bad scene files: {} refused", lines.len());
}

pub fn kept(name: &str, lines: &[String]) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(name, lines.join("\n")));
}

/// Every message that the page of the book shows is one that pinhole gives.
#[test]
fn the_page_s_messages_are_pinhole_s() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("book/src/scene_files.md");
    let page = fs::read_to_string(page).expect("the page is there");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let exported = typed(&["export", "05_pinhole"]).expect("exported");
    let mistakes = [
        (
            "sphere: (radius: 0.8),\n        placement: (position: (0.2",
            "spere: (radius: 0.8),\n        placement: (position: (0.2",
        ),
        ("fov: 40.0", "fov: \"40\""),
        ("(2.5, 5.0, 3.0)", "(2.5, 5.0)"),
        ("(0.25, 0.5, 0.75)", "(0.25, 0.5, 7.5)"),
    ];
    for (from, to) in mistakes {
        assert!(exported.contains(from), "{from}");
        let message = told(folder.path(), exported.replacen(from, to, 1).as_bytes());
        assert!(page.contains(&message), "the page does not show what `{to}` gives now:\n{message}");
    }
}
