//! Films: frames by keys, in one go, in parts and after stops; what is blurred; and keys that make no sense.

use super::{names, pinhole, run, text};
use pinhole::film::{Curve, png_bytes};
use pinhole::render::{Execution, render};
use pinhole::scene::{LookAt, Motion, Name, PerspectiveCamera, Placement, SceneFile, Shutter};
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread;
use std::time::Duration;

const SCENE: &str = r#"[
    (name: "camera", perspective_camera: (fov: 40), resolution: (width: 48, height: 27), sampling: (samples: 20),
     shutter: (open: 0, close: 0.25), look_at: (eye: (0, 1, 6), target: (0, 0.5, 0)),
     keys: (values: {"look_at.eye": [(0, (0, 1, 6)), (8, (4, 1, 6))], "perspective_camera.fov": [(0, 40), (8, 24)]})),
    (name: "ball", sphere: (radius: 0.5), placement: (position: (9, 0.5, 0)), matte: (colour: (0.8, 0.2, 0.1)),
     keys: (values: {"placement.position": [(0, (-2, 0.5, 0)), (4, (2, 0.5, 0))]})),
    (name: "floor", plane: (), matte: ()),
    (name: "sky", gradient: ()),
]"#;

fn scene(folder: &Path) {
    fs::write(folder.join("a.ron"), SCENE).expect("written");
}

fn pictures(folder: &Path) -> Vec<Vec<u8>> {
    (0..=8).map(|frame| fs::read(folder.join(format!("f_{frame:04}.png"))).expect("a frame")).collect()
}

/// Kills the program a few times, each time somewhat later; returns how often it was still at work.
pub(super) fn killed(folder: &Path, words: &[&str]) -> u32 {
    let mut stops = 0;
    for pause in [60, 120, 200, 300] {
        let mut child =
            pinhole(folder).args(words).stderr(Stdio::null()).stdout(Stdio::null()).spawn().expect("it starts");
        thread::sleep(Duration::from_millis(pause));
        let _ = Command::new("kill").args(["-KILL", &child.id().to_string()]).status();
        stops += u32::from(!child.wait().expect("it ends").success());
    }
    stops
}

// Without moments, which have their own tests: the camera's field of view changes.
const ALL: [&str; 8] = ["render", "a.ron", "--frames", "0..8", "-o", "f.png", "--moments", "1"];

#[test]
fn a_film_has_the_same_bits_in_one_go_in_parts_and_after_stops() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    scene(folder.path());
    let done = run(folder.path(), &ALL);
    assert!(done.status.success(), "{}", text(&done.stderr));
    let expected = pictures(folder.path());
    assert_eq!(expected.iter().collect::<std::collections::BTreeSet<_>>().len(), 9, "every frame is another picture");
    // Each of them is the picture of the scene at that frame.
    let file = SceneFile::open(&folder.path().join("a.ron")).expect("read");
    for (frame, picture) in expected.iter().enumerate() {
        let world = file.at(frame as f64, 24.0).expect("keys").world();
        let stages = pinhole::Chapter::new("scene", "", |_| ()).offer(pinhole::stages::all()).stages();
        let film = render(&world, &stages, &Execution::default(), &()).expect("renders").film;
        let own = image::load_from_memory(&png_bytes(&film, Curve::Srgb).expect("a PNG")).expect("read");
        assert!(image::load_from_memory(picture).expect("read") == own, "frame {frame}");
    }
    // A second time, nothing is rendered.
    let again = run(folder.path(), &[&ALL[..], &["--resume"]].concat());
    assert_eq!(text(&again.stderr).matches("is done").count(), 9, "{}", text(&again.stderr));
    fs::remove_file(folder.path().join("f_0003.png")).expect("removed");
    let again = run(folder.path(), &[&ALL[..], &["--resume"]].concat());
    assert_eq!(text(&again.stderr).matches("is done").count(), 8, "{}", text(&again.stderr));
    assert!(pictures(folder.path()) == expected);

    let folder = tempfile::tempdir().expect("a temporary folder");
    scene(folder.path());
    for part in ["2/3", "3/3"] {
        let done = run(folder.path(), &[&ALL[..], &["--part", part]].concat());
        assert!(done.status.success(), "{}", text(&done.stderr));
    }
    let missing = run(folder.path(), &["merge", "a.ron", "--frames", "0..8", "-o", "f.png"]);
    assert!(missing.status.code() == Some(75) && text(&missing.stderr).contains("3 of 9 frames are missing: 0, 3, 6"));
    // The last part is stopped again and again.
    let last = [&ALL[..], &["--part", "1/3", "--resume", "--write-every", "1ms", "-j", "1"]].concat();
    let stops = killed(folder.path(), &last);
    let done = run(folder.path(), &last);
    assert!(done.status.success(), "{}", text(&done.stderr));
    assert!(pictures(folder.path()) == expected);
    assert!(run(folder.path(), &["merge", "a.ron", "--frames", "0..8", "-o", "f.png"]).status.success());
    eprintln!(
        "films: 9 frames the same in one go, in 3 parts and after {stops} kills: {:?}",
        names(folder.path()).len()
    );
}

/// What moves by keys has, at every moment of the shutter, the place that its keys say.
#[test]
fn motion_is_taken_from_the_keys() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    scene(folder.path());
    let file = SceneFile::open(&folder.path().join("a.ron")).expect("read");
    let mut tried = 0;
    for frame in [0.0, 0.5, 1.0, 3.0, 7.25, 100.0] {
        let mut world = file.at(frame, 8.0).expect("keys").world();
        let time = frame / 8.0;
        let mut cameras = world.query::<(&PerspectiveCamera, &LookAt, &Shutter, Option<&Motion>)>();
        let (camera, look, shutter, motion) = cameras.single(&world).expect("one camera");
        let share = (frame / 8.0).clamp(0.0, 1.0);
        assert!((camera.fov.0 - (40.0 - 16.0 * share)).abs() < 1e-12, "{frame}: {camera:?}");
        assert_eq!((shutter.open, shutter.close), (time, time + 0.25));
        let velocity = motion.map_or(glam::DVec3::ZERO, |motion| motion.velocity);
        for part in 0..=4 {
            // The shutter is open for two frames of the eight in a unit of time; the mean motion between its ends is linear.
            let part = f64::from(part) / 4.0;
            let along = |from: f64, to: f64| 4.0 * (from + (to - from) * part);
            let ends = [frame, frame + 2.0].map(|own: f64| (own / 8.0).clamp(0.0, 1.0));
            let now = time + 0.25 * part;
            assert!((look.eye.x + velocity.x * now - along(ends[0], ends[1])).abs() < 1e-12, "{frame}, {part}");
            let (eye, target) = (look.eye + velocity * now, look.target + velocity * now);
            let first = look.eye.x + velocity.x * time;
            assert!(
                (target - eye - (glam::DVec3::new(0.0, 0.5, 0.0) - glam::DVec3::new(first, 1.0, 6.0))).length() < 1e-12
            );
            tried += 1;
        }
        let mut named = world.query::<(&Name, &Placement, Option<&Motion>)>();
        let (_, ball, motion) = named.iter(&world).find(|(name, ..)| name.as_str() == "ball").expect("a ball");
        let velocity = motion.map_or(glam::DVec3::ZERO, |motion| motion.velocity);
        let ends = [frame, frame + 2.0].map(|own: f64| -2.0 + 4.0 * (own / 4.0).clamp(0.0, 1.0));
        for (now, expected) in [(time, ends[0]), (time + 0.25, ends[1])] {
            assert!((ball.position.x + velocity.x * now - expected).abs() < 1e-12, "{frame}: {ball:?} {velocity}");
        }
    }
    eprintln!("keys: camera and ball at {tried} moments of 6 frames where the keys say");
}

#[test]
fn keys_and_frames_that_make_no_sense_are_refused_in_a_sentence() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (old, new, because) in [
        ("\"perspective_camera.fov\": [(0, 40)", "\"perspective_camera.fow\": [(0, 40)", "fow"),
        ("(8, 24)", "(0, 24)", "with keys in the order of their frames"),
        ("(8, 24)", "(8, 500)", "fov"),
        ("[(0, 40), (8, 24)]", "[]", "with one key or more"),
        ("name: \"ball\", ", "", "has no name"),
        ("(8, (4, 1, 6))", "(8, wide)", "look_at"),
        ("keys: (values", "keys: (value", "value"),
    ] {
        assert!(SCENE.contains(old), "{old}");
        fs::write(folder.path().join("a.ron"), SCENE.replace(old, new)).expect("written");
        let done = run(folder.path(), &ALL);
        let said = text(&done.stderr);
        assert!(!done.status.success() && said.contains(because) && said.lines().count() <= 12, "{new}: {said}");
    }
    scene(folder.path());
    for (words, because) in [
        (&["render", "a.ron", "--frames", "8..0"][..], "such as 0..47"),
        (&["render", "a.ron", "--frames", "8"], "such as 0..47"),
        (&["render", "a.ron", "--frames", "0..8", "--fps", "0"], "above 0"),
        (&["render", "a.ron", "--frames", "0..8", "--time", "1s"], "--time"),
        (&["render", "a.ron", "--frames", "0..8", "-o", "-"], "are files"),
        (&["render", "5", "--frames", "0..8"], "has no frames"),
    ] {
        let done = run(folder.path(), words);
        assert!(!done.status.success() && text(&done.stderr).contains(because), "{words:?}: {}", text(&done.stderr));
    }
}
