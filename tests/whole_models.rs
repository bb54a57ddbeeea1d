//! A model arrives whole: of everything that a glTF file may say, either the picture shows it or a sentence says that it
//! does not, and nothing that is merely odd refuses the file.

mod properties;
mod whole_scenes;

use crate::scenes::{offer, one_world};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use bevy_ecs::prelude::*;
use pinhole::extract::validate;
use pinhole::film::Film;
use pinhole::plan::Census;
use pinhole::render::render;
use pinhole::scene::*;
use serde_json::{Value, json};
use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};

const LIGHT: &str = "/extensions/KHR_lights_punctual/lights/0";

/// An image of four colours, as a file.
fn image(format: image::ImageFormat, texel: impl Fn(u32, u32) -> [u8; 3]) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image::RgbImage::from_fn(4, 4, |x, y| image::Rgb(texel(x, y))).write_to(&mut bytes, format).expect("encoded");
    bytes.into_inner()
}

fn colourful(x: u32, y: u32) -> [u8; 3] {
    [(40 + 60 * x) as u8, (40 + 60 * y) as u8, 200]
}

fn uri(bytes: &[u8]) -> Value {
    format!("data:application/octet-stream;base64,{}", STANDARD.encode(bytes)).into()
}

fn floats(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

/// A square that faces its camera, textured, with a light in front of it, and more accessors than it uses: 0 positions,
/// 1 normals, 2 texture coordinates from −1 to 2, 3 indices, 4 four vectors of four, all (0.5, 0.25, 1, 1), 5 joints, all
/// 0, and 6 one matrix, a shift.
fn base() -> Value {
    let positions = floats(&[-1.0, -1.0, 0.0, 1.0, -1.0, 0.0, 1.0, 1.0, 0.0, -1.0, 1.0, 0.0]);
    let normals = floats(&[0.0, 0.0, 1.0].repeat(4));
    let uvs = floats(&[-1.0, 2.0, 2.0, 2.0, 2.0, -1.0, -1.0, -1.0]);
    let indices: Vec<u8> = [0, 1, 2, 0, 2, 3].iter().flat_map(|index: &u16| index.to_le_bytes()).collect();
    let fours = floats(&[0.5, 0.25, 1.0, 1.0].repeat(4));
    let matrix = floats(&[1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.3, 0.2, 0.0, 1.0]);
    let columns = [
        (positions, 5126, 4, "VEC3"),
        (normals, 5126, 4, "VEC3"),
        (uvs, 5126, 4, "VEC2"),
        (indices, 5123, 6, "SCALAR"),
        (fours, 5126, 4, "VEC4"),
        (vec![0; 16], 5121, 4, "VEC4"),
        (matrix, 5126, 1, "MAT4"),
    ];
    let (mut bytes, mut views, mut accessors) = (Vec::new(), Vec::new(), Vec::new());
    for (number, (column, component, count, kind)) in columns.into_iter().enumerate() {
        views.push(json!({ "buffer": 0, "byteOffset": bytes.len(), "byteLength": column.len() }));
        accessors.push(json!({ "bufferView": number, "componentType": component, "count": count, "type": kind }));
        bytes.extend(column);
    }
    json!({
        "asset": { "version": "2.0" },
        "extensions": { "KHR_lights_punctual": { "lights": [{ "type": "point", "intensity": 50.0 }] } },
        "buffers": [{ "byteLength": bytes.len(), "uri": uri(&bytes) }],
        "bufferViews": views,
        "accessors": accessors,
        "images": [{ "uri": uri(&image(image::ImageFormat::Png, colourful)) }],
        "samplers": [{}],
        "textures": [{ "source": 0, "sampler": 0 }],
        "materials": [{
            "pbrMetallicRoughness": {
                "baseColorFactor": [0.9, 0.8, 0.7, 0.5], "metallicFactor": 0.2, "roughnessFactor": 0.4
            },
            "emissiveFactor": [0.1, 0.05, 0.02],
            "doubleSided": true
        }],
        "meshes": [{ "primitives": [{
            "attributes": { "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2 }, "indices": 3, "material": 0
        }] }],
        "cameras": [{ "type": "perspective", "perspective": { "yfov": 0.9, "znear": 0.01 } }],
        "nodes": [
            { "mesh": 0 },
            { "camera": 0, "translation": [0.0, 0.0, 4.0] },
            { "translation": [0.7, 1.0, 2.0], "extensions": { "KHR_lights_punctual": { "light": 0 } } },
            {}
        ]
    })
}

/// Sets a value at a place such as `/materials/0/alphaMode`; objects and lists on the way are made.
fn set(root: &mut Value, place: &str, value: Value) {
    let mut at = root;
    for part in place.trim_start_matches('/').split('/') {
        at = match part.parse::<usize>() {
            Err(_) => {
                if !at.is_object() {
                    *at = json!({});
                }
                &mut at[part]
            }
            Ok(index) => {
                if !at.is_array() {
                    *at = json!([]);
                }
                let list = at.as_array_mut().expect("a list");
                list.resize(list.len().max(index + 1), json!({}));
                &mut list[index]
            }
        };
    }
    *at = value;
}

fn with(changes: &[(&str, Value)]) -> Value {
    let mut file = base();
    changes.iter().for_each(|(place, value)| set(&mut file, place, value.clone()));
    file
}

/// A picture of a model in a file of its own, and what is said of it.
struct Shown {
    film: Film,
    said: Vec<String>,
}

fn write(folder: &Path, name: &str, file: &Value) -> PathBuf {
    let path = folder.join(name);
    fs::write(&path, file.to_string()).expect("written");
    path
}

fn world(path: &Path) -> Result<World, String> {
    let mut world = ModelScene::open(path).map_err(|error| error.to_string())?.world();
    let mut cameras = world.query_filtered::<Entity, With<Resolution>>();
    let camera = cameras.iter(&world).next().expect("a camera");
    let sampling = Sampling { samples: 4, ..Sampling::default() };
    world.entity_mut(camera).insert((Resolution { width: 24, height: 18 }, sampling));
    validate(&Census::of(&world)).map_err(|error| error.to_string())?;
    Ok(world)
}

fn shown(file: &Value) -> Result<Shown, String> {
    let folder = tempfile::tempdir().expect("a folder");
    let world = world(&write(folder.path(), "m.gltf", file))?;
    let film = render(&world, &offer(), &one_world(), &()).map_err(|error| error.to_string())?.film;
    Ok(Shown { film, said: world.resource::<ModelNotes>().0.clone() })
}

fn same_picture(one: &Film, other: &Film) -> bool {
    let size = |film: &Film| (film.width, film.height);
    let pixels = || (0..one.height).flat_map(|y| (0..one.width).map(move |x| (x, y)));
    size(one) == size(other) && pixels().all(|(x, y)| one.mean(x, y) == other.mean(x, y))
}

/// The law of this file. What a change of the file does not change in the picture, it changes in what is said.
#[test]
fn whatever_a_file_says_is_shown_or_said() {
    let plain = shown(&base()).expect("the base");
    let (mut seen, mut told) = (0, 0);
    for (name, must_show, changes) in properties::properties() {
        let own = shown(&with(&changes)).unwrap_or_else(|error| panic!("{name} refuses the file: {error}"));
        let more: Vec<&String> = own.said.iter().filter(|sentence| !plain.said.contains(sentence)).collect();
        let same = same_picture(&own.film, &plain.film);
        eprintln!("{name}: {} {more:?}", if same { "the same picture" } else { "another picture" });
        assert!(!(same && more.is_empty()), "{name} is dropped in silence: {:?}", own.said);
        assert!(!(same && must_show), "{name} must be seen");
        seen += usize::from(!same);
        told += usize::from(!more.is_empty());
    }
    eprintln!("{seen} properties change the picture, {told} what is said");
    assert!(seen >= 30 && told >= 50, "{seen}, {told}");
}

/// Odd but clear, as if nothing were odd.
#[test]
fn what_is_merely_odd_looks_as_if_it_were_not() {
    let plain = shown(&base()).expect("the base");
    let rounded = json!([0.9999999, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1e-9, 0, 0, 0, 0.9999999]);
    let mut percent = base();
    let data = percent["buffers"][0]["uri"].as_str().expect("a URI").replace('+', "%2B").replace('A', "%41");
    percent["buffers"][0]["uri"] = data.into();
    let mut lines = base();
    let data = lines["buffers"][0]["uri"].as_str().expect("a URI").to_owned();
    lines["buffers"][0]["uri"] = format!("{}\n {}", &data[..80], &data[80..]).into();
    let mut matrix = base();
    set(&mut matrix, "/nodes/0/matrix", rounded);
    for (name, file) in [("percent escapes", percent), ("line breaks", lines), ("rounded matrix", matrix)] {
        let own = shown(&file).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(own.said, plain.said, "{name}");
        let off = (0..18).flat_map(|y| (0..24).map(move |x| (x, y)));
        let off = off.map(|(x, y)| (own.film.mean(x, y)[0] - plain.film.mean(x, y)[0]).abs()).fold(0.0, f32::max);
        assert!(off < 0.2 && (name == "rounded matrix" || off == 0.0), "{name}: {off}");
    }
}

/// By any spelling, in any case of letters, in the folder of another machine.
#[test]
fn images_are_found_by_what_exporters_write() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::create_dir(folder.path().join("sub")).expect("a folder");
    for name in ["sub/a.png", "b.png"] {
        fs::write(folder.path().join(name), image(image::ImageFormat::Png, colourful)).expect("written");
    }
    let texture = ("/materials/0/pbrMetallicRoughness/baseColorTexture", json!({ "index": 0 }));
    let names = [
        "sub/a.png",
        "sub\\a.png",
        "sub%5Ca.png",
        "./sub//a.png",
        "sub/A.PNG",
        "B.png",
        "C:\\work\\b.png",
        "/home/other/B.PNG",
    ];
    for name in names {
        let file = with(&[texture.clone(), ("/images/0/uri", json!(name))]);
        let world = world(&write(folder.path(), "m.gltf", &file)).expect(name);
        let ModelNotes(notes) = world.resource::<ModelNotes>();
        assert!(!notes.iter().any(|note| note.contains("image")), "{name}: {notes:?}");
    }
    let file = with(&[texture, ("/images/0/uri", json!("c.png"))]);
    let world = world(&write(folder.path(), "m.gltf", &file)).expect("replaced");
    let ModelNotes(notes) = world.resource::<ModelNotes>();
    assert!(notes.iter().any(|note| note.contains("c.png") && note.contains("replaced")), "{notes:?}");
}

/// Two folders, two files of one name, each with an image of its own inside.
#[test]
fn files_of_one_name_keep_their_own_images() {
    let folder = tempfile::tempdir().expect("a folder");
    let colours = [[250, 10, 10], [10, 10, 250]];
    let mut scene = World::new();
    for (part, colour) in ["a", "b"].into_iter().zip(colours) {
        fs::create_dir(folder.path().join(part)).expect("a folder");
        let texture = ("/materials/0/pbrMetallicRoughness/baseColorTexture", json!({ "index": 0 }));
        let file = with(&[texture, ("/images/0/uri", uri(&image(image::ImageFormat::Png, |_, _| colour)))]);
        let path = write(&folder.path().join(part), "model.gltf", &file);
        scene.spawn(Mesh { file: path.to_string_lossy().into_owned(), ..Mesh::default() });
    }
    load_meshes(&mut scene);
    let textures: Vec<String> = scene.query::<&ImageTexture>().iter(&scene).map(|own| own.file.clone()).collect();
    assert_eq!(textures.len(), 2);
    let found: Vec<[u8; 3]> = textures
        .iter()
        .map(|file| {
            let bytes = ModelFiles::find(&scene, file).expect("the bytes");
            image::load_from_memory(&bytes).expect("an image").to_rgb8().get_pixel(0, 0).0
        })
        .collect();
    assert_eq!(found, colours);
}

/// An image that is damaged anywhere behind its head is replaced as one that is not there, whichever texture it is of, in
/// the file and beside it.
#[test]
fn images_that_cannot_be_decoded_are_replaced() {
    let folder = tempfile::tempdir().expect("a folder");
    let whole = image(image::ImageFormat::Png, colourful);
    let mut flipped = whole.clone();
    let middle = whole.len() / 2;
    flipped[middle] ^= 0xff;
    let bmp = image(image::ImageFormat::Bmp, colourful);
    let broken = [&whole[..whole.len() * 2 / 3], &flipped, &bmp[..bmp.len() - 9]];
    let textures = [
        "pbrMetallicRoughness/baseColorTexture",
        "pbrMetallicRoughness/metallicRoughnessTexture",
        "normalTexture",
        "emissiveTexture",
    ];
    for texture in textures {
        let texture = (format!("/materials/0/{texture}"), json!({ "index": 0 }));
        let replaced = |uri: Value| {
            let file = with(&[(texture.0.as_str(), texture.1.clone()), ("/images/0/uri", uri)]);
            let world = world(&write(folder.path(), "m.gltf", &file)).expect("not refused");
            let film = render(&world, &offer(), &one_world(), &()).expect("renders").film;
            (film, world.resource::<ModelNotes>().0.join(" "))
        };
        let (missing, _) = replaced("none.png".into());
        for (number, bytes) in broken.into_iter().enumerate() {
            let name = format!("{number}.png");
            fs::write(folder.path().join(&name), bytes).expect("written");
            for uri in [uri(bytes), name.into()] {
                let (film, said) = replaced(uri);
                assert!(same_picture(&film, &missing), "{number}, {}: another picture than without it", texture.0);
                assert!(said.contains("replaced") && said.contains("damaged"), "{number}, {}: {said}", texture.0);
            }
        }
        let (film, said) = replaced(uri(&whole));
        assert!(!said.contains("replaced") && !same_picture(&film, &missing), "{}: {said}", texture.0);
    }
}

/// A film that is continued must be of the same picture: colours of vertices, factors and images within the file count.
#[test]
fn other_colours_are_another_film() {
    let folder = tempfile::tempdir().expect("a folder");
    let print =
        |changes: &[(&str, Value)]| fingerprint(&world(&write(folder.path(), "m.gltf", &with(changes))).expect("read"));
    let texture = ("/materials/0/pbrMetallicRoughness/baseColorTexture", json!({ "index": 0 }));
    let of_image = |blue| ("/images/0/uri", uri(&image(image::ImageFormat::Png, |_, _| [9, 9, blue])));
    let factor = ("/materials/0/pbrMetallicRoughness/baseColorFactor", json!([0.5, 0.5, 0.5, 1.0]));
    let colours = |accessor: u32| ("/meshes/0/primitives/0/attributes/COLOR_0", json!(accessor));
    let prints = [
        print(&[texture.clone(), of_image(10)]),
        print(&[texture.clone(), of_image(11)]),
        print(&[texture.clone(), of_image(10), factor]),
        print(&[texture.clone(), of_image(10), colours(0)]),
        print(&[texture.clone(), of_image(10), colours(1)]),
    ];
    assert_eq!(prints[0], print(&[texture, of_image(10)]));
    for (number, one) in prints.iter().enumerate() {
        assert!(prints[number + 1..].iter().all(|other| other != one), "{number}");
    }
}
