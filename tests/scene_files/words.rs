//! What a scene file's words are: names of components in messages, turns of placements, the fingerprint of a scene.

use super::{parsed, typed};
use bevy_ecs::prelude::*;
use glam::{DQuat, DVec3};
use pinhole::look::MISTAKES;
use pinhole::scene::{
    Disabled, ImageTexture, Placement, SceneFolder, fingerprint, in_words_of_files, scene_text, words,
};

#[test]
fn every_component_is_named_by_its_word() {
    let capital = |part: &str| part[..1].to_uppercase() + &part[1..];
    for word in words() {
        let name: String = word.split('_').map(capital).collect();
        let told = in_words_of_files(&format!("camera \"{name}\": x is a {name}, but {name} or Other{name}"));
        assert_eq!(told, format!("camera \"{name}\": x is a {word}, but {word} or Other{name}"));
    }
    assert_eq!(in_words_of_files("a UsesMaterial or an Emissive"), "a material or an emissive");
    assert_eq!(in_words_of_files("„é“: PointLight(s)"), "„é“: point_light(s)");
    eprintln!("components: {} named as a file names them", words().count());
}

/// Whoever does in a file what is said of it before it is rendered has done it: no word of that is one of Rust.
#[test]
fn what_is_foretold_of_a_file_can_be_written_into_it() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (mut scenes, mut written) = (0, Vec::new());
    for mistake in MISTAKES {
        let mut world = World::new();
        (mistake.scene)(&mut world);
        let Ok(text) = scene_text(&world) else { continue };
        let file = folder.path().join("scene.ron");
        std::fs::write(&file, text).expect("a file");
        // What the renderer refuses is not foretold.
        let Ok(told) = typed(&["preflight", &file.display().to_string()]) else { continue };
        assert!(!told.contains("::"), "{}: {told}", mistake.what);
        for (field, whole) in [("integrator: ", "{}"), ("lights: ", "integrator: Path({})")] {
            for (at, _) in told.match_indices(field) {
                let value = told[at + field.len()..].split([';', ' ', '\n']).next().unwrap_or("");
                let component = whole.replace("{}", &format!("{field}{value}"));
                let scene = format!("[(perspective_camera: (), {component})]");
                assert!(parsed(&scene).is_ok(), "{}: {scene}", mistake.what);
                written.push(value.to_owned());
            }
        }
        scenes += 1;
    }
    written.sort();
    written.dedup();
    assert_eq!(written, ["Mis", "Path()", "Whitted()"]);
    eprintln!("foretold: {scenes} scenes as files, and what is advised for them is accepted");
}

fn written(text: &str) -> Result<Placement, String> {
    ron::from_str(text).map_err(|error| error.to_string())
}

#[test]
fn a_file_turns_by_one_of_three_words() {
    let by = |text: &str| written(text).expect(text).orientation;
    let angles = by("(euler_xyz: (0, 90, 0))");
    assert_eq!(angles, by("(axis_angle: (axis: (0, 2, 0), angle: 90))"));
    assert!((angles * DVec3::NEG_Z - DVec3::NEG_X).length() < 1e-15, "left is where −z goes");
    assert_eq!(by("(orientation: (0, 0, 0, 2))"), DQuat::from_xyzw(0.0, 0.0, 0.0, 2.0));
    assert_eq!(by("(position: (1, 2, 3))"), DQuat::IDENTITY);
    for twice in ["(euler_xyz: (0, 9, 0), axis_angle: (angle: 9))", "(orientation: (1, 0, 0, 0), euler_xyz: (1, 0, 0))"]
    {
        assert!(written(twice).is_err_and(|told| told.contains("turned once")), "{twice}");
    }
    assert!(by("(axis_angle: (axis: (0, 0, 0), angle: 9))").is_nan(), "which extraction refuses");
}

#[test]
fn an_image_that_holds_something_else_makes_another_scene() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut scene = World::new();
    scene.insert_resource(SceneFolder(folder.path().into()));
    scene.spawn(ImageTexture { file: "card.png".into(), ..ImageTexture::default() });
    let with = |bytes: &[u8]| {
        std::fs::write(folder.path().join("card.png"), bytes).expect("a file");
        fingerprint(&scene)
    };
    assert_eq!(with(b"one"), with(b"one"));
    assert_ne!(with(b"one"), with(b"two"));
}

/// The file of a disabled entity was never checked: it may be a device that never ends, or a pipe that nobody
/// writes to.
#[test]
fn the_image_of_a_disabled_entity_is_not_opened() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut scene = World::new();
    scene.insert_resource(SceneFolder(folder.path().into()));
    scene.spawn((Disabled, ImageTexture { file: "card.png".into(), ..ImageTexture::default() }));
    let before = fingerprint(&scene);
    std::fs::write(folder.path().join("card.png"), b"one").expect("a file");
    assert_eq!(fingerprint(&scene), before);
}
