//! Files that are made to hang, to fill the memory, or to speak to the terminal.

use super::{parsed, typed};
use bevy_ecs::prelude::*;
use pinhole::extract::ImageTable;
use pinhole::plan::{Census, Table};
use pinhole::scene::{ImageTexture, Matte, Name, PerspectiveCamera, Resolution, Sphere};
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::time::{Duration, Instant};

const CAMERA: &str =
    "(name: \"eye\", perspective_camera: (), resolution: (width: 8, height: 4), sampling: (samples: 2))";
const CARD: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/chapters/16_textures/card.png");

/// Runs the program in a folder with so much address space, in KiB; how it ended, and what it said on stderr.
///
/// It is killed where it does not end by itself.
pub fn run_within(folder: &Path, kibibytes: &str, words: &[&str]) -> (Option<i32>, String) {
    let mut child = Command::new("sh")
        .args(["-c", &format!("ulimit -v {kibibytes} && exec \"$@\""), "sh", env!("CARGO_BIN_EXE_pinhole")])
        .args(words)
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(fs::File::create(folder.join("said")).expect("a file"))
        .spawn()
        .expect("the program starts");
    let began = Instant::now();
    let ended = loop {
        if let Some(status) = child.try_wait().expect("it can be asked") {
            break status.code();
        }
        if began.elapsed() > Duration::from_secs(30) {
            child.kill().expect("killed");
            child.wait().expect("it ends");
            break None;
        }
        std::thread::sleep(Duration::from_millis(10));
    };
    (ended, fs::read_to_string(folder.join("said")).expect("text"))
}

fn one_line(said: &str) {
    assert!(said.lines().count() == 1 && said.chars().count() <= 600, "{said}");
    assert!(!said.trim_end().contains(|letter: char| letter.is_control()), "{said:?}");
}

/// The key of a checkpoint once read every file that a scene names, those of disabled entities too, which nobody checks.
#[cfg(unix)]
#[test]
fn what_a_disabled_entity_names_is_not_opened() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let made = Command::new("mkfifo").arg(folder.path().join("pipe.png")).status().expect("mkfifo");
    assert!(made.success());
    for file in ["pipe.png", "/dev/zero"] {
        let scene = format!("[{CAMERA}, (disabled: true, image_texture: (file: \"{file}\"))]");
        fs::write(folder.path().join("scene.ron"), scene).expect("written");
        let ended = run_within(folder.path(), "4000000", &["render", "scene.ron", "-q", "-o", "a.png"]);
        assert_eq!(ended.0, Some(0), "{file}: {}", ended.1);
    }
}

#[test]
fn long_words_and_names_are_told_shortly_and_soon() {
    let word = format!("[({}: ())]", "x".repeat(8 << 20));
    let unclosed = format!("[({})]", "x".repeat(8 << 20));
    let names: Vec<String> = (0..20_000).map(|number| format!("(name: \"{}{number:05}\")", "n".repeat(90))).collect();
    let parent = format!("[{}, (parent: \"{}\")]", names.join(","), "n".repeat(4 << 20));
    for text in [word, unclosed, parent] {
        let began = Instant::now();
        let said = parsed(&text).err().expect("refused").to_string();
        one_line(&said);
        assert!(began.elapsed() < Duration::from_secs(10), "{:?}: {said}", began.elapsed());
    }
}

#[test]
fn a_file_of_too_many_entities_or_cameras_is_refused_in_a_sentence() {
    let said = parsed(&format!("[{}]", "(),".repeat((1 << 20) + 1))).err().expect("refused").to_string();
    assert!(said.contains("at most 1048576"), "{said}");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scene = folder.path().join("scene.ron").display().to_string();
    fs::write(
        &scene,
        format!("[{}]", format!("(name: \"{}\", perspective_camera: ()),", "c".repeat(100)).repeat(1000)),
    )
    .expect("written");
    let said = typed(&["plan", &scene]).expect_err("refused").to_string();
    assert!(said.contains("given 1000 times") && said.contains("and 996 more"), "{said}");
    assert!(said.chars().count() < 1000, "{said}");
}

#[test]
fn text_of_a_file_never_speaks_to_the_terminal() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("scene.ron").display().to_string();
    let scenes = [
        format!("[(name: \"c\", perspective_camera: (), view: (column: \"\\u{{1b}}[2J\\n{}\"))]", "v".repeat(1 << 20)),
        "[(name: \"a\u{202e}b\", perspective_camera: (fov: 500.0))]".into(),
        "[(name: \"c\", perspective_camera: ()), (sphere: (), matte: (), image_texture: (file: \"a\u{202e}\\n.png\"))]"
            .into(),
        "[(name: \"a\u{202e}b\", perspective_camera: ()), (parent: \"c\u{202e}\")]".into(),
    ];
    for scene in scenes {
        fs::write(&path, scene).expect("written");
        let said = typed(&["plan", &path]).expect_err("refused").to_string();
        one_line(&said);
        assert!(!said.contains('\u{202e}') && said.contains(r"\u{"), "{said}");
    }
    fs::write(&path, "[(name: \"a\u{202e}b\", perspective_camera: ()), (name: \"\u{2066}\", sphere: (), matte: ())]")
        .expect("written");
    let plan = typed(&["plan", &path]).expect("planned");
    assert!(!plan.contains(['\u{202e}', '\u{2066}']) && plan.contains(r"\u{2066}"), "{plan}");
}

/// The same image, whoever asks for it and however often, all through a render: one that was decoded again would lie
/// elsewhere in memory.
#[test]
fn an_image_that_many_name_is_decoded_once() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let card = folder.path().join("card.png");
    fs::copy(CARD, &card).expect("copied");
    let file = card.display().to_string();
    let mut world = World::new();
    world.spawn((Name::new("eye"), PerspectiveCamera::default(), Resolution { width: 8, height: 4 }));
    for _ in 0..24 {
        world.spawn((
            Sphere::default(),
            Matte::default(),
            ImageTexture { file: file.clone(), ..ImageTexture::default() },
        ));
    }
    let census = &Census::of(&world);
    let before = ImageTable::extract(census).expect("extracted");
    let scene = folder.path().join("scene.ron");
    fs::write(&scene, pinhole::scene::scene_text(&world).expect("text")).expect("written");
    let [scene, picture] = [scene, folder.path().join("a.png")].map(|path| path.display().to_string());
    typed(&["render", &scene, "-o", &picture]).expect("rendered");
    let after = ImageTable::extract(census).expect("extracted");
    assert_eq!((before.pyramid.len(), after.pyramid.len()), (24, 24));
    for image in before.pyramid.iter().chain(&after.pyramid) {
        assert!(Arc::ptr_eq(image, &before.pyramid[0]));
    }
    assert!(before.bytes() < 2 * before.pyramid[0].bytes(), "told once");
}

#[cfg(target_os = "linux")]
#[test]
fn a_film_that_does_not_fit_is_refused_before_it_is_asked_for() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scene = "[(name: \"camera\", perspective_camera: ()), (sphere: (), matte: ()), (point_light: ())]";
    fs::write(folder.path().join("one.ron"), scene).expect("written");
    let large = ["one.ron", "--size", "32768x32768"];
    for command in [&["render"][..], &["render", "-q", "--samples", "4"], &["preflight"]] {
        let words: Vec<&str> = command[..1].iter().chain(&large).chain(&command[1..]).copied().collect();
        let (ended, said) = run_within(folder.path(), "3000000", &words);
        one_line(&said);
        assert_eq!(ended, Some(1), "{words:?}: {said}");
        assert!(said.contains("camera \"camera\": resolution is 32768 × 32768"), "{said}");
        assert!(said.contains("needs 28.0 GiB") && said.contains("are free; at most about"), "{said}");
    }
    let (ended, said) = run_within(folder.path(), "3000000", &["plan", "one.ron", "--size", "32768x32768"]);
    assert_eq!(ended, Some(0), "a plan has no film: {said}");
}

/// A picture of 4 bytes of deflate for every 4,000 texels, 4096² of them.
#[cfg(target_os = "linux")]
#[test]
fn textures_that_do_not_fit_are_refused_before_they_are_decoded() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    black_png(&folder.path().join("a.png"), 4096);
    let names: Vec<String> = (0..4).map(|number| format!("{number}.png")).collect();
    names.iter().for_each(|name| _ = fs::copy(folder.path().join("a.png"), folder.path().join(name)).expect("copied"));
    let of = |file: &str| format!("(sphere: (), matte: (), image_texture: (file: \"{file}\"))");
    let scene = |files: &[String]| {
        let entities: Vec<String> = files.iter().map(|file| of(file)).collect();
        fs::write(folder.path().join("scene.ron"), format!("[{CAMERA}, {}]", entities.join(", "))).expect("written");
    };
    let render = ["render", "scene.ron", "-q", "-o", "a.exr"];
    scene(&names);
    let (ended, said) = run_within(folder.path(), "1100000", &render);
    one_line(&said);
    assert!(ended == Some(1) && said.contains("image textures is 4 files") && said.contains("needs 1.0 GiB"), "{said}");
    scene(&names[..1]);
    let (ended, said) = run_within(folder.path(), "300000", &render);
    one_line(&said);
    assert!(ended == Some(1) && said.contains("is 1 file") && said.contains("needs 256 MiB"), "{said}");
}

/// A black PNG of one bit a pixel.
pub fn black_png(path: &Path, side: u32) {
    let mut encoder = png::Encoder::new(fs::File::create(path).expect("made"), side, side);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::One);
    let pixels = vec![0; (side.div_ceil(8) * side) as usize];
    encoder.write_header().expect("a head").write_image_data(&pixels).expect("pixels");
}
