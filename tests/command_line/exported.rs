//! What was read and is exported renders the same, and every value in it can be edited.

use super::model::glb;
use super::{names, run, text};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

fn picture(folder: &Path, scene: &str) -> Vec<u8> {
    let words = ["render", scene, "--size", "32x18", "--samples", "4", "-q", "-o", "picture.exr"];
    let ended = run(folder, &words);
    assert!(ended.status.success(), "{scene}: {}", text(&ended.stderr));
    let bytes = fs::read(folder.join("picture.exr")).expect("written");
    fs::remove_file(folder.join("picture.exr")).expect("removed");
    bytes
}

fn exported(folder: &Path, words: &[&str]) -> String {
    let ended = run(folder, &[&["export"], words].concat());
    assert!(ended.status.success(), "{words:?}: {}", text(&ended.stderr));
    text(&ended.stdout)
}

fn scene(folder: &Path, name: &str) -> String {
    let text = fs::read_to_string(folder.join(name)).expect("read");
    text.lines().filter(|line| !line.starts_with("//")).collect::<Vec<_>>().join("\n")
}

#[test]
fn a_model_with_its_images_within_is_exported_and_every_value_of_it_acts() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path();
    fs::write(path.join("own.glb"), glb()).expect("written");
    let expected = picture(path, "own.glb");
    exported(path, &["own.glb", "-o", "away/s.ron"]);
    let beside = names(&path.join("away"));
    let of = |ending: &str| beside.iter().filter(|name| name.ends_with(ending)).count();
    assert_eq!((of(".png"), of(".glb"), of(".ron"), beside.len()), (2, 1, 1, 4), "{beside:?}");
    assert!(picture(path, "away/s.ron") == expected, "another picture");
    // Its folder can go elsewhere, since it names nothing outside.
    fs::rename(path.join("own.glb"), path.join("gone.glb")).expect("renamed");
    fs::rename(path.join("away"), path.join("moved")).expect("renamed");
    assert!(picture(path, "moved/s.ron") == expected);

    let text = scene(path, "moved/s.ron");
    // No entity is there for nothing: a material is that of a mesh, and what has no meaning by itself has children.
    let named = |word: &str| -> BTreeSet<String> {
        let before = format!("{word}: \"");
        let after = text.split(&before).skip(1);
        after.map(|rest| rest.split('"').next().unwrap_or_default().to_owned()).collect()
    };
    let (entities, used) = (named("name"), &named("material") | &named("parent"));
    assert!(used.is_subset(&entities), "{used:?} of {entities:?}");
    for (name, word) in [("paint", "principled"), ("paint 2", "principled")] {
        assert!(used.contains(name) && text.contains(&format!("name: \"{name}\"")), "{name} is no {word}\n{text}");
    }
    assert_eq!(text.matches("principled").count(), 2, "{text}");
    // Every value acts.
    for (from, to) in [
        ("base_colour: (0.8, 0.7, 0.6)", "base_colour: (0.1, 0.2, 0.9)"),
        ("intensity: (", "0.5, 0.5, 0.5"),
        ("metallic: 0.0", "metallic: 1.0"),
        ("position: (-1.1, 0.0, 0.0)", "position: (-0.6, 0.2, 0.0)"),
    ] {
        let edited = if from.starts_with("intensity") {
            let at = text.find(from).expect("a light") + from.len();
            let end = at + text[at..].find(')').expect("its end");
            format!("{}{to}{}", &text[..at], &text[end..])
        } else {
            assert!(text.contains(from), "{from}:\n{text}");
            text.replacen(from, to, 1)
        };
        fs::write(path.join("moved/edited.ron"), edited).expect("written");
        assert!(picture(path, "moved/edited.ron") != expected, "{from} does nothing");
    }
    // What is exported anew is the same.
    exported(path, &["moved/s.ron", "-o", "moved/again.ron"]);
    assert_eq!(scene(path, "moved/again.ron"), text);
    assert_eq!(names(&path.join("moved")).len(), 6);
}

#[test]
fn a_scene_that_names_a_model_is_exported_as_it_is() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path();
    fs::write(path.join("own.glb"), glb()).expect("written");
    let text = "[\n    (name: \"camera\", perspective_camera: (fov: 40.0), placement: (position: (0.0, 0.0, 6.0))),\n    \
                (name: \"model\", mesh: (file: \"own.glb\")),\n    \
                (name: \"lamp\", point_light: (intensity: (40.0, 40.0, 40.0)), placement: (position: (0.0, 2.0, 3.0))),\n]";
    fs::write(path.join("s.ron"), text).expect("written");
    let expected = picture(path, "s.ron");
    exported(path, &["s.ron", "-o", "again.ron"]);
    exported(path, &["again.ron", "-o", "thrice.ron"]);
    assert_eq!(scene(path, "again.ron").matches("name: ").count(), 3, "{}", scene(path, "again.ron"));
    assert_eq!(scene(path, "thrice.ron"), scene(path, "again.ron"));
    for name in ["again.ron", "thrice.ron"] {
        assert!(picture(path, name) == expected, "{name}");
    }
    for of in ["own.glb", "s.ron"] {
        let expected = picture(path, of);
        fs::create_dir(path.join("printed")).expect("made");
        fs::write(path.join("printed/s.ron"), exported(path, &[of])).expect("written");
        assert!(picture(path, "printed/s.ron") == expected, "{of}, printed");
        fs::remove_dir_all(path.join("printed")).expect("removed");
    }
}
