//! What `view` keeps, whatever others do meanwhile, and that it answers whatever the scene.

use super::{Viewing, ended, folder_with, program};
use crate::command_line::model::glb;
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use std::thread::sleep;
use std::time::{Duration, Instant};
use tempfile::TempDir;

const SMALL: [&str; 2] = ["--size", "32x18"];

impl Viewing {
    /// The program with these words in this folder.
    fn in_folder(folder: TempDir, words: &[&str]) -> Self {
        let mut command = program(folder.path());
        command.arg("view").args(words).args(SMALL);
        Self::started(command, folder)
    }

    /// The status and the body of the answer to an order.
    pub fn order(&self, order: &Value) -> (u16, String) {
        let (body, host, token) = (order.to_string(), self.host(), self.token());
        let head = format!(
            "POST /{token}/order HTTP/1.1\r\nHost: {host}\r\nContent-Type: application/json\r\nContent-Length: {}\r\n\r\n",
            body.len()
        );
        let answer = String::from_utf8_lossy(&self.answer((head + &body).as_bytes())).into_owned();
        let status = answer.split(' ').nth(1).and_then(|status| status.parse().ok()).unwrap_or(0);
        (status, answer.split_once("\r\n\r\n").map_or(String::new(), |(_, body)| body.to_owned()))
    }

    pub fn sheet(&self) -> Value {
        serde_json::from_slice(&self.get("sheet")).expect("JSON")
    }

    pub fn text(&self) -> String {
        self.sheet()["text"].as_str().expect("a text").to_owned()
    }
}

#[test]
fn save_replaces_nothing_but_what_it_knows() {
    let hostile: [(&str, fn(&Path)); 7] = [
        ("another text", |file| fs::write(file, "[]").expect("written")),
        ("more than a scene file may hold", |file| fs::write(file, vec![b'x'; 17 << 20]).expect("written")),
        ("a sparse giant", |file| fs::File::create(file).and_then(|made| made.set_len(5 << 30)).expect("made")),
        ("a folder", |file| fs::remove_file(file).and_then(|()| fs::create_dir(file)).expect("made")),
        ("broken UTF-8", |file| {
            let text = fs::read_to_string(file).expect("read").replace('\u{fffd}', "?");
            let at = text.find('?').expect("the mark");
            fs::write(file, [&text.as_bytes()[..at], b"\xff", &text.as_bytes()[at + 1..]].concat()).expect("written");
        }),
        ("write-protected", |file| {
            let mut permissions = fs::metadata(file).expect("there").permissions();
            permissions.set_readonly(true);
            fs::set_permissions(file, permissions).expect("set");
        }),
        ("nothing", |file| fs::write(file, "").expect("written")),
    ];
    for (what, put) in hostile {
        let folder = folder_with("5");
        let file = folder.path().join("scene.ron");
        let mut text = fs::read_to_string(&file).expect("exported");
        // What cannot be decoded is read as this letter, and is not the same.
        text = text.replacen("// ", "// \u{fffd}", 1);
        fs::write(&file, &text).expect("written");
        let viewing = Viewing::in_folder(folder, &["scene.ron"]);
        put(&file);
        let before = fs::symlink_metadata(&file).expect("there");
        let held = before
            .is_file()
            .then_some(before.len())
            .filter(|&bytes| bytes < 1 << 25)
            .map(|_| fs::read(&file).expect("read"));
        let (status, said) = viewing.order(&json!({ "save": format!("{text}// mine\n") }));
        assert_eq!(status, 422, "{what}: {said}");
        assert!(!said.contains('\n') && !said.is_empty(), "{what}: {said}");
        let after = fs::symlink_metadata(&file).expect("still there");
        assert_eq!((before.len(), before.is_dir()), (after.len(), after.is_dir()), "{what}");
        assert!(held.is_none_or(|bytes| fs::read(&file).expect("read") == bytes), "{what}");
    }
}

#[test]
fn save_writes_what_is_missing_and_keeps_the_ends_of_lines() {
    let folder = folder_with("5");
    let file = folder.path().join("scene.ron");
    let text = fs::read_to_string(&file).expect("exported").replace('\n', "\r\n");
    fs::write(&file, &text).expect("written");
    let viewing = Viewing::in_folder(folder, &["scene.ron"]);
    let page = viewing.text();
    assert!(!page.contains('\r') && page.replace('\n', "\r\n") == text);
    assert_eq!(viewing.order(&json!({ "save": format!("{page}// mine\n") })).0, 200);
    assert_eq!(fs::read_to_string(&file).expect("read"), format!("{text}// mine\r\n"));
    fs::remove_file(&file).expect("removed");
    assert_eq!(viewing.order(&json!({ "save": page })).0, 200, "what is gone is written again");
    assert_eq!(fs::read_to_string(&file).expect("read"), text);
}

/// Every .glb with its images within once had no Apply, no Save and no view to keep.
#[test]
fn a_model_with_its_images_within_is_edited_and_saved() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join("own.glb"), glb()).expect("written");
    let viewing = Viewing::in_folder(folder, &["own.glb"]);
    let text = viewing.text();
    assert!(text.contains("name: \"paint 2\""), "{text}");
    let edited = text.replacen("base_colour: (0.8, 0.7, 0.6)", "base_colour: (0.1, 0.7, 0.9)", 1);
    assert!(edited != text);
    for order in [json!({ "apply": edited }), json!({ "orbit": [0.1, 0.1] }), json!("put_view"), json!("sheet")] {
        let (status, said) = viewing.order(&order);
        assert_eq!(status, 200, "{order}: {said}");
    }
    let moved = viewing.text();
    assert!(moved.contains("look_at") && moved.contains("(0.1, 0.7, 0.9)"), "{moved}");
    let (status, said) = viewing.order(&json!({ "save": moved }));
    assert_eq!((status, said.as_str()), (200, "\"out/own.ron\""));
    let (status, said) = viewing.order(&json!({ "save": format!("{}// again\n", viewing.text()) }));
    assert_eq!((status, said.as_str()), (200, "\"out/own.ron\""), "its own file is its own");
    let rendered = ended(viewing.folder.path(), &["render", "out/own.ron", "--size", "8x5", "-q", "-o", "a.png"]);
    assert!(rendered.status.success(), "{}", String::from_utf8_lossy(&rendered.stderr));
}

/// Saving chapter 28 once made 33, 34 and 35 unsavable, and of two viewers of one chapter the second could never save.
#[test]
fn several_viewers_save_in_one_folder() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().to_owned();
    fs::create_dir(path.join("out")).expect("made");
    fs::write(path.join("out/28_meshes-mesh-1.glb"), "precious").expect("written");
    let open = |chapter: &str, folder: TempDir| Viewing::in_folder(folder, &[chapter]);
    let first = open("28", folder);
    let others: Vec<Viewing> = ["28", "33"]
        .map(|chapter| {
            let mut command = program(&path);
            command.args(["view", chapter]).args(SMALL);
            Viewing::started(command, tempfile::tempdir().expect("a temporary folder"))
        })
        .into();
    let mut files = Vec::new();
    for viewing in [&first].into_iter().chain(&others) {
        let (status, said) = viewing.order(&json!({ "save": viewing.text() }));
        assert_eq!(status, 200, "{said}");
        let file: String = serde_json::from_str(&said).expect("a name");
        let rendered = ended(&path, &["render", &file, "--size", "8x5", "-q", "-o", "a.png"]);
        assert!(rendered.status.success(), "{file}: {}", String::from_utf8_lossy(&rendered.stderr));
        files.push(file);
    }
    assert_eq!(files, ["out/28_meshes.ron", "out/28_meshes-2.ron", "out/33_rasterisation.ron"]);
    assert_eq!(fs::read(path.join("out/28_meshes-mesh-1.glb")).expect("read"), b"precious");
}

/// Paths without an end: in a ball of mirror around the camera.
const ENDLESS: &str = "[(name: \"camera\", perspective_camera: (fov: 40), resolution: (width: 96, height: 54), \
    look_at: (eye: (0, 1, 6), target: (0, 0, 0)), integrator: Path(max_depth: 4294967295, lights: Mis, roulette: 0)), \
    (sphere: (radius: 100), mirror: (colour: (1, 1, 1))), \
    (sphere: (radius: 1), emissive: (radiance: (1, 1, 1)), placement: (position: (0, 0, 90)))]";

#[test]
fn every_order_is_answered_within_seconds_whatever_the_scene() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join("endless.ron"), ENDLESS).expect("written");
    let viewing = Viewing::in_folder(folder, &["endless.ron"]);
    let mut worst = (Duration::ZERO, String::new());
    let apply = |more: &str| json!({ "apply": format!("{ENDLESS}{more}") });
    let orders = [
        json!("sheet"),
        json!({ "orbit": [0.1, 0.0] }),
        json!({ "trace": [0.5, 0.5] }),
        json!({ "zoom": 0.5 }),
        json!({ "focus": [0.5, 0.5] }),
        apply("// one\n"),
        json!({ "mode": "3" }),
        json!({ "picture": "png" }),
        json!({ "column": "ndc" }),
        json!({ "column": null }),
        json!({ "mode": "1" }),
        json!("put_view"),
        json!("reset"),
        apply("// two\n"),
    ];
    for order in orders {
        let began = Instant::now();
        let (status, said) = viewing.order(&order);
        assert!([200, 422].contains(&status), "{order}: {status} {said}");
        let took = began.elapsed();
        worst = worst.max((took, order.to_string()));
        sleep(Duration::from_millis(250));
    }
    assert!(worst.0 < Duration::from_secs(5), "{worst:?}");
    let text = ENDLESS.replace("4294967295", "3");
    let (status, change) = viewing.order(&json!({ "apply": text }));
    let (change, began): (u64, _) = (change.parse().expect("a number"), Instant::now());
    assert_eq!(status, 200);
    // The picture comes once its paths have an end.
    while frame(&viewing)["change"].as_u64() < Some(change) {
        assert!(began.elapsed() < Duration::from_secs(20), "no picture");
        sleep(Duration::from_millis(50));
    }
    eprintln!("view: endless paths, the slowest answer after {worst:?}");
}

/// What stands before the pixels of the newest frame.
fn frame(viewing: &Viewing) -> Value {
    let body = viewing.get("frame?after=0");
    let length = u32::from_le_bytes([body[0], body[1], body[2], body[3]]) as usize;
    serde_json::from_slice(&body[4..4 + length]).expect("JSON")
}

#[test]
#[cfg(target_os = "linux")]
fn nothing_is_computed_while_no_page_looks() {
    let folder = folder_with("25");
    let viewing = Viewing::in_folder(folder, &["scene.ron"]);
    let text = viewing.text();
    let many = text.replacen("sampling: (", "sampling: (samples: 16777216, ", 1);
    let many = if let Some(at) = text.find("samples: ") {
        let end = at + 9 + text[at + 9..].find(|letter: char| !letter.is_ascii_digit()).expect("its end");
        format!("{}samples: 16777216{}", &text[..at], &text[end..])
    } else {
        many
    };
    let (status, said) = viewing.order(&json!({ "apply": many }));
    assert_eq!(status, 200, "{said}");
    let began = Instant::now();
    while frame(&viewing)["samples"][1] != 16_777_216 {
        assert!(began.elapsed() < Duration::from_secs(20), "no frame of the edited scene");
        sleep(Duration::from_millis(50));
    }
    let (before, began) = (viewing.computed(), Instant::now());
    while viewing.computed() < before + 0.2 {
        assert!(began.elapsed() < Duration::from_secs(20), "it computes while a page looks");
        sleep(Duration::from_millis(100));
        frame(&viewing);
    }
    sleep(Duration::from_millis(11_000));
    let before = viewing.computed();
    sleep(Duration::from_secs(2));
    let computed = viewing.computed() - before;
    assert!(computed < 0.1, "it computed for {computed} s while nobody looked");
    let samples = |viewing: &Viewing| frame(viewing)["samples"][0].as_u64();
    let then = samples(&viewing);
    sleep(Duration::from_millis(1500));
    assert!(samples(&viewing) > then, "it goes on once a page looks again");
}

/// The film fits, and the frames beside it do not.
#[test]
#[cfg(target_os = "linux")]
fn the_frames_are_part_of_the_forecast() {
    let folder = folder_with("5");
    let begun = |size: &str| {
        let mut command = std::process::Command::new("sh");
        let words = format!("ulimit -v 3000000; exec \"$0\" view scene.ron --size {size} --no-open");
        command.args(["-c", &words]).arg(program(folder.path()).get_program()).current_dir(folder.path());
        command.stdout(std::process::Stdio::piped()).stderr(std::process::Stdio::piped()).spawn().expect("a shell")
    };
    let refused = begun("8700x8700").wait_with_output().expect("it ends");
    let said = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert_eq!(refused.status.code(), Some(1), "{said}");
    assert!(said.contains("with the frames that a page is sent") && said.lines().count() == 1, "{said}");
}

#[test]
fn an_address_without_its_slash_leads_to_the_page() {
    let viewing = Viewing::of("5", &SMALL);
    let request = format!("GET /{} HTTP/1.1\r\nHost: {}\r\n\r\n", viewing.token(), viewing.host());
    let answer = String::from_utf8_lossy(&viewing.answer(request.as_bytes())).into_owned();
    assert!(answer.starts_with("HTTP/1.1 200") && answer.contains(&format!("url=/{}/\"", viewing.token())), "{answer}");
}
