//! What was read and is exported renders the same, and every value in it can be edited.

use super::model::glb;
use super::{names, run, text};
use exr::prelude::read_first_flat_layer_from_file;
use image::{ExtendedColorType, ImageEncoder};
use serde_json::json;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// The bits of a scene's picture; the rest of the file says which scene it is.
fn picture(folder: &Path, scene: &str) -> Vec<u32> {
    let words = ["render", scene, "--size", "32x18", "--samples", "4", "-q", "-o", "picture.exr"];
    let ended = run(folder, &words);
    assert!(ended.status.success(), "{scene}: {}", text(&ended.stderr));
    let layer = read_first_flat_layer_from_file(folder.join("picture.exr")).expect("written").layer_data;
    fs::remove_file(folder.join("picture.exr")).expect("removed");
    let channels = layer.channel_data.list.iter();
    channels.flat_map(|channel| channel.sample_data.values_as_f32().map(f32::to_bits)).collect()
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

/// Four texels of four colours, as a PNG.
fn write_texels(path: &Path) {
    let file = fs::File::create(path).expect("made");
    let texels = [[255, 40, 40], [40, 255, 40], [40, 40, 255], [255, 255, 40]];
    let encoder = image::codecs::png::PngEncoder::new(file);
    encoder.write_image(texels.as_flattened(), 2, 2, ExtendedColorType::Rgb8).expect("encodes");
}

/// Two squares of one material, the first with colours at its vertices where that is asked for.
fn gltf(folder: &Path, name: &str, material: &serde_json::Value, colours: bool) {
    let numbers = [
        [-1.0, -1.0, 0.0, 1.0, -1.0, 0.0, 1.0, 1.0, 0.0, -1.0, 1.0, 0.0].as_slice(),
        &[0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0],
        &[1.0, 0.1, 0.2, 0.3, 0.9, 1.0 / 3.0, 0.0, 0.0, 1.0, 1.0, 1.0, 0.5],
    ];
    let mut bytes: Vec<u8> = numbers.iter().copied().flatten().flat_map(|number: &f32| number.to_le_bytes()).collect();
    bytes.extend([0_u16, 1, 2, 0, 2, 3].iter().flat_map(|index| index.to_le_bytes()));
    fs::write(folder.join("b.bin"), &bytes).expect("written");
    let view = |offset: u32, length: u32| json!({ "buffer": 0, "byteOffset": offset, "byteLength": length });
    let column = |view: u32, kind: &str| json!({ "bufferView": view, "componentType": 5126, "count": 4, "type": kind });
    let mut attributes = json!({ "POSITION": 0, "TEXCOORD_0": 1 });
    let plain = json!({ "primitives": [{ "attributes": attributes, "indices": 3, "material": 0 }] });
    if colours {
        attributes["COLOR_0"] = json!(2);
    }
    let document = json!({
        "asset": { "version": "2.0" },
        "nodes": [{ "mesh": 0, "translation": [-1.1, 0, 0] }, { "mesh": 1, "translation": [1.1, 0, 0] }],
        "meshes": [{ "primitives": [{ "attributes": attributes, "indices": 3, "material": 0 }] }, plain],
        "materials": [material],
        "images": [{ "uri": "t.png" }],
        "textures": [{ "source": 0 }],
        "accessors": [
            column(0, "VEC3"), column(1, "VEC2"), column(2, "VEC3"),
            { "bufferView": 3, "componentType": 5123, "count": 6, "type": "SCALAR" },
        ],
        "bufferViews": [view(0, 48), view(48, 32), view(80, 48), view(128, 12)],
        "buffers": [{ "uri": "b.bin", "byteLength": bytes.len() }],
    });
    fs::write(folder.join(name), document.to_string()).expect("written");
}

/// A base colour under a texture, colours of vertices, and both, by every kind of model file that has them; and what other
/// programs have written.
#[test]
fn what_is_exported_has_the_colours_of_the_model() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path();
    write_texels(&path.join("t.png"));
    let factor = json!([0.9, 0.4, 0.2, 1.0]);
    let texture = json!({ "index": 0 });
    let of = |base: serde_json::Value| json!({ "pbrMetallicRoughness": base, "name": "paint" });
    let plain = of(json!({ "baseColorFactor": factor, "metallicFactor": 0 }));
    let white = of(json!({ "baseColorTexture": texture, "metallicFactor": 0 }));
    let tinted = of(json!({ "baseColorFactor": factor, "baseColorTexture": texture, "metallicFactor": 0 }));
    gltf(path, "factor.gltf", &tinted, false);
    gltf(path, "colours.gltf", &plain, true);
    gltf(path, "colours_texture.gltf", &white, true);
    gltf(path, "both.gltf", &tinted, true);
    let (square, corners) = ("v 0 0 0 1 0 0\nv 1 0 0 0.5 1 0\nv 1 1 0 0.2 0 1\nv 0 1 0 1 1 0\n", "f 1/1 2/2 3/3 4/4\n");
    let uvs = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
    fs::write(path.join("m.mtl"), "newmtl a\nKd 0.9 0.4 0.2\nmap_Kd t.png\n").expect("written");
    fs::write(path.join("colours.obj"), format!("{square}{uvs}{corners}")).expect("written");
    fs::write(path.join("both.obj"), format!("mtllib m.mtl\n{square}{uvs}usemtl a\n{corners}")).expect("written");
    for (name, comment) in [("colours.ply", ""), ("both.ply", "comment TextureFile t.png\n")] {
        let names = ["x", "y", "z", "u", "v", "red", "green", "blue"].map(|name| format!("property float {name}\n"));
        let head = format!("ply\nformat ascii 1.0\n{comment}element vertex 3\n{}", names.concat());
        let faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
        let rows = "0 0 0 0 0 1 0.1 0.2\n1 0 0 1 0 0.3 0.9 0.3\n1 1 0 1 1 0 0 1\n3 0 1 2\n";
        fs::write(path.join(name), format!("{head}{faces}{rows}")).expect("written");
    }
    let mut models: Vec<String> = names(path).into_iter().filter(|name| is_model(name)).collect();
    let given = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/models");
    models
        .extend(names(&given).iter().filter(|name| is_model(name)).map(|name| given.join(name).display().to_string()));
    assert!(models.len() > 20, "{models:?}");
    let mut tinted = 0;
    for (number, model) in models.iter().enumerate() {
        let expected = picture(path, model);
        let file = format!("{number}/s.ron");
        exported(path, &[model, "-o", &file]);
        tinted += usize::from(scene(path, &file).contains("tint: ("));
        assert!(picture(path, &file) == expected, "{model}: another picture\n{}", scene(path, &file));
    }
    assert!(tinted >= 8, "{tinted} of {models:?}");
}

fn is_model(name: &str) -> bool {
    [".gltf", ".glb", ".obj", ".ply"].iter().any(|ending| name.ends_with(ending))
}
