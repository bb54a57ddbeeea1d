use crate::triangle_mesh::TriangleMesh;
use serde_json::{Value, json};

/// A mesh as a binary glTF file without materials of its own, of which `read_model` makes the same mesh.
///
/// Its one node places it where it is.
/// The layout is that of the glTF 2.0 specification, "GLB File Format".
/// None where that would be a file of more than 4 GiB, which none can be.
pub fn glb_of(mesh: &TriangleMesh) -> Option<Vec<u8>> {
    let mut buffer = Buffer::default();
    let [low, high] = bounds_of(&mesh.positions);
    let positions = buffer.add(mesh.positions.iter().flatten().map(|part| part.to_le_bytes()), ("VEC3", 3), FLOAT);
    buffer.accessors[positions]["min"] = json!(low);
    buffer.accessors[positions]["max"] = json!(high);
    let mut attributes = json!({ "POSITION": positions });
    if let Some(normals) = &mesh.normals {
        let parts = normals.iter().flatten().map(|part| part.to_le_bytes());
        attributes["NORMAL"] = json!(buffer.add(parts, ("VEC3", 3), FLOAT));
    }
    if let Some(uvs) = &mesh.uvs {
        let parts = uvs.iter().flatten().map(|part| part.to_le_bytes());
        attributes["TEXCOORD_0"] = json!(buffer.add(parts, ("VEC2", 2), FLOAT));
    }
    if let Some(colours) = &mesh.colours {
        let parts = colours.iter().flatten().map(|part| part.to_le_bytes());
        attributes["COLOR_0"] = json!(buffer.add(parts, ("VEC3", 3), FLOAT));
    }
    let corners = mesh.triangles.iter().flatten().map(|corner| corner.to_le_bytes());
    let indices = buffer.add(corners, ("SCALAR", 1), UNSIGNED_INT);
    let document = json!({
        "asset": { "version": "2.0", "generator": "pinhole" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": attributes, "indices": indices }] }],
        "accessors": buffer.accessors,
        "bufferViews": buffer.views,
        "buffers": [{ "byteLength": buffer.bytes.len() }],
    });
    let mut text = document.to_string().into_bytes();
    // A chunk's length is a multiple of 4; JSON is filled up with spaces.
    text.resize(text.len().next_multiple_of(4), b' ');
    let whole = 12 + 8 + text.len() + 8 + buffer.bytes.len();
    let whole = u32::try_from(whole).ok()?;
    let mut file = b"glTF".to_vec();
    file.extend(2_u32.to_le_bytes());
    file.extend(whole.to_le_bytes());
    for (kind, chunk) in [(b"JSON", &text), (b"BIN\0", &buffer.bytes)] {
        file.extend((chunk.len() as u32).to_le_bytes());
        file.extend(kind);
        file.extend(chunk);
    }
    Some(file)
}

/// glTF's code for numbers of type f32.
const FLOAT: u32 = 5126;
/// glTF's code for numbers of type u32.
const UNSIGNED_INT: u32 = 5125;

/// The file's only buffer, with a view and an accessor for each column.
#[derive(Default)]
struct Buffer {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Buffer {
    /// Adds a column, whose rows are of so many numbers each; returns the number of its accessor.
    fn add(&mut self, numbers: impl Iterator<Item = [u8; 4]>, (row, numbers_a_row): (&str, usize), code: u32) -> usize {
        let offset = self.bytes.len();
        self.bytes.extend(numbers.flatten());
        let length = self.bytes.len() - offset;
        let own = self.accessors.len();
        self.views.push(json!({ "buffer": 0, "byteOffset": offset, "byteLength": length }));
        let count = length / (4 * numbers_a_row);
        self.accessors.push(json!({ "bufferView": own, "componentType": code, "count": count, "type": row }));
        own
    }
}

/// The least and the greatest of each coordinate; zero where there are no positions.
fn bounds_of(positions: &[[f32; 3]]) -> [[f32; 3]; 2] {
    let first = positions.first().copied().unwrap_or_default();
    positions.iter().fold([first; 2], |[mut low, mut high], position| {
        for axis in 0..3 {
            low[axis] = low[axis].min(position[axis]);
            high[axis] = high[axis].max(position[axis]);
        }
        [low, high]
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read::read_model;

    /// Read again, every bit is the same, and again.
    #[test]
    fn a_mesh_comes_back_from_its_file() {
        let third = 1.0_f32 / 3.0;
        let positions = vec![[0.1, -0.2, 1e-30], [third, 7.5e20, -0.0], [1.0, 1.0, -1.0], [f32::MAX, 0.0, 3.0]];
        // Unit vectors as rounded to f32: their lengths are not 1.
        let normals: Vec<[f32; 3]> =
            (0..4).map(|i| glam::DVec3::new(0.3, f64::from(i), -1.7).normalize().as_vec3().to_array()).collect();
        let uvs = vec![[0.1, 0.9], [1e-9, 1.0 - 1e-7], [0.0, 1.0], [third, -2.5]];
        let colours = vec![[0.0, 1.0, third], [1e-9, 1.0 - 1e-7, 0.5], [0.25; 3], [1.0; 3]];
        let triangles = vec![[0, 1, 2], [2, 1, 3]];
        for columns in 0..8 {
            let mesh = TriangleMesh {
                positions: positions.clone(),
                triangles: triangles.clone(),
                normals: (columns & 1 != 0).then(|| normals.clone()),
                uvs: (columns & 2 != 0).then(|| uvs.clone()),
                colours: (columns & 4 != 0).then(|| colours.clone()),
            };
            let file = glb_of(&mesh).expect("a small file");
            assert_eq!(file.len() % 4, 0);
            let none = |_: &str| Err("there is none".to_owned());
            let model = read_model("own.glb", &file, &none).expect("can be read");
            assert_eq!((model.meshes.len(), model.instances.len(), model.materials.len()), (1, 1, 1));
            assert_eq!(*model.meshes[0], mesh);
            assert_eq!(model.instances[0].world_from_object, glam::DAffine3::IDENTITY);
            assert_eq!(glb_of(&model.meshes[0]), Some(file), "written again");
        }
    }
}
