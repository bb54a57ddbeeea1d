//! Small glTF files, written for tests.

use crate::model::{Model, Moment};
use crate::read::read_model_at;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;

/// A data URI.
pub fn data(bytes: &[u8]) -> String {
    format!("data:application/octet-stream;base64,{}", STANDARD.encode(bytes))
}

/// Numbers as a buffer has them.
pub fn floats(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

/// Reads a file with these fields besides `asset`; beside it is a file `a b.bin` of 36 zeros.
pub fn read(fields: &str) -> Result<Model, String> {
    read_at(fields, None)
}

/// The same at a moment of its animations.
pub fn read_at(fields: &str, moment: Option<Moment<'_>>) -> Result<Model, String> {
    let text = format!("{{\"asset\":{{\"version\":\"2.0\"}},{fields}}}").replace('\'', "\"");
    let open = |name: &str| if name == "a b.bin" { Ok(vec![0; 36]) } else { Err("there is none".to_owned()) };
    read_model_at("a.gltf", text.as_bytes(), moment, &open).map_err(|error| error.to_string())
}

/// The sentence with which such a file is refused.
pub fn refused(fields: &str) -> String {
    match read(fields) {
        Ok(model) => format!("read: {model:?}"),
        Err(sentence) => sentence.strip_prefix("a.gltf: ").map_or(sentence.clone(), str::to_owned),
    }
}

/// The fields of a buffer with two triangles that form a square, and views of it.
///
/// Accessors: 0 positions, 1 normals, 2 texture coordinates as bytes, 3 to 5 indices of 1, 2 and 4 bytes.
pub fn square() -> String {
    let mut bytes = floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0]);
    bytes.extend(floats(&[0.0, 0.0, 1.0].repeat(4)));
    bytes.extend([0, 255, 255, 255, 255, 0, 0, 0]);
    let corners = [0, 1, 2, 0, 2, 3_u8];
    bytes.extend(corners);
    bytes.extend(corners.iter().flat_map(|corner| u16::from(*corner).to_le_bytes()));
    bytes.extend(corners.iter().flat_map(|corner| u32::from(*corner).to_le_bytes()));
    let view = |offset: usize, length: usize| format!("{{'buffer':0,'byteOffset':{offset},'byteLength':{length}}}");
    let views = [view(0, 48), view(48, 48), view(96, 8), view(104, 6), view(110, 12), view(122, 24)].join(",");
    let accessor = |view: usize, component: usize, count: usize, kind: &str| {
        format!("{{'bufferView':{view},'componentType':{component},'count':{count},'type':'{kind}','normalized':true}}")
    };
    let accessors = [
        accessor(0, 5126, 4, "VEC3"),
        accessor(1, 5126, 4, "VEC3"),
        accessor(2, 5121, 4, "VEC2"),
        accessor(3, 5121, 6, "SCALAR"),
        accessor(4, 5123, 6, "SCALAR"),
        accessor(5, 5125, 6, "SCALAR"),
    ];
    format!(
        "'buffers':[{{'byteLength':{},'uri':'{}'}}],'bufferViews':[{views}],'accessors':[{}]",
        bytes.len(),
        data(&bytes),
        accessors.join(",")
    )
}

/// The fields of a mesh with these primitives, and of a node that places it.
pub fn mesh(primitives: &str) -> String {
    format!("{},'meshes':[{{'name':'own','primitives':[{primitives}]}}],'nodes':[{{'mesh':0}}]", square())
}
