//! A small .glb file with all that an export has to keep: images within, a light, a camera, odd names.

use image::{ExtendedColorType, ImageEncoder};
use serde_json::{Value, json};

/// A PNG of four texels.
fn png(texels: [[u8; 3]; 4]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let encoder = image::codecs::png::PngEncoder::new(&mut bytes);
    encoder.write_image(texels.as_flattened(), 2, 2, ExtendedColorType::Rgb8).expect("encodes");
    bytes
}

/// Two squares with images within the file, each several times; names that are long, equal or hold control letters.
pub fn glb() -> Vec<u8> {
    let floats = |numbers: &[f32]| numbers.iter().flat_map(|number| number.to_le_bytes()).collect::<Vec<u8>>();
    let parts = [
        floats(&[-1.0, -1.0, 0.0, 1.0, -1.0, 0.0, 1.0, 1.0, 0.0, -1.0, 1.0, 0.0]),
        floats(&[0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0]),
        [0_u16, 1, 2, 0, 2, 3].iter().flat_map(|index| index.to_le_bytes()).collect(),
        png([[255, 40, 40], [40, 255, 40], [40, 40, 255], [255, 255, 40]]),
        png([[255, 128, 0], [255, 40, 255], [0, 255, 128], [0, 128, 255]]),
    ];
    let (mut buffer, mut views) = (Vec::new(), Vec::new());
    for part in &parts {
        views.push(json!({ "buffer": 0, "byteOffset": buffer.len(), "byteLength": part.len() }));
        buffer.extend(part);
        buffer.resize(buffer.len().next_multiple_of(4), 0);
    }
    let accessor = |view: u32, component: u32, count: u32, kind: &str| json!({ "bufferView": view, "componentType": component, "count": count, "type": kind });
    let square = |material: u32| {
        let attributes = json!({ "POSITION": 0, "TEXCOORD_0": 1 });
        json!({ "primitives": [{ "attributes": attributes, "indices": 2, "material": material }] })
    };
    let mut positions = accessor(0, 5126, 4, "VEC3");
    (positions["min"], positions["max"]) = (json!([-1, -1, 0]), json!([1, 1, 0]));
    let document = json!({
        "asset": { "version": "2.0" },
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": { "KHR_lights_punctual": { "lights": [{ "type": "point", "intensity": 900.0, "name": "lamp" }] } },
        "scene": 0,
        "scenes": [{ "nodes": [0, 1, 2, 3] }],
        "nodes": [
            { "mesh": 0, "translation": [-1.1, 0, 0], "name": "long ".repeat(40) },
            { "mesh": 1, "translation": [1.1, 0, 0], "rotation": [0, 0.2, 0, 0.979_795_9], "name": "two\nlines" },
            { "extensions": { "KHR_lights_punctual": { "light": 0 } }, "translation": [0, 2, 3] },
            { "camera": 0, "translation": [0, 0, 6], "name": "camera" },
        ],
        "cameras": [{ "type": "perspective", "perspective": { "yfov": 0.7, "znear": 0.1 } }],
        "meshes": [square(0), square(1)],
        "materials": [
            { "name": "paint", "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 }, "metallicFactor": 0.0 } },
            {
                "name": "paint",
                "pbrMetallicRoughness": { "baseColorFactor": [0.8, 0.7, 0.6, 1.0], "metallicRoughnessTexture": { "index": 1 } },
            },
            { "name": "unused" },
        ],
        "textures": [{ "source": 0 }, { "source": 1 }],
        "images": [{ "bufferView": 3, "mimeType": "image/png" }, { "bufferView": 4, "mimeType": "image/png" }],
        "accessors": [positions, accessor(1, 5126, 4, "VEC2"), accessor(2, 5123, 6, "SCALAR")],
        "bufferViews": views,
        "buffers": [{ "byteLength": buffer.len() }],
    });
    file(&document, &buffer)
}

fn file(document: &Value, buffer: &[u8]) -> Vec<u8> {
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut file = b"glTF".to_vec();
    file.extend(2_u32.to_le_bytes());
    file.extend((28 + text.len() as u32 + buffer.len() as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", &text[..]), (b"BIN\0", buffer)] {
        file.extend((chunk.len() as u32).to_le_bytes());
        file.extend(kind);
        file.extend(chunk);
    }
    file
}
