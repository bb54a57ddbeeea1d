use super::binary::binary_parts;
use super::buffers::Buffers;
use super::cameras::{camera, light};
use super::document::{Document, EXTENSIONS, Table};
use super::images::Images;
use super::json::Json;
use super::materials::{ReadMaterial, read_materials};
use super::nodes::SceneNodes;
use super::object::Object;
use super::primitive::PrimitiveParts;
use crate::memory::Memory;
use crate::model::{Instance, Model};
use crate::model_error::ModelError;
use crate::open::Open;
use crate::remarks::Remarks;
use crate::triangle_mesh::TriangleMesh;
use glam::DAffine3;
use std::collections::HashMap;
use std::sync::Arc;

/// Reads a glTF file and the buffers it names.
///
/// Errors: whatever is not as glTF 2.0 demands and matters for the picture.
pub fn read_gltf(name: &str, bytes: &[u8], open: Open<'_>) -> Result<Model, ModelError> {
    let (text, own) = if bytes.starts_with(b"glTF") { binary_parts(name, bytes)? } else { (bytes, None) };
    // Some exporters end the text with zeros.
    let text = text.trim_ascii_end();
    let text = text.strip_suffix(b"\0").map_or(text, |text| text.split(|byte| *byte == 0).next().unwrap_or(text));
    let json = Json::read(text).map_err(|error| {
        ModelError::new(name, "the JSON of the file", "broken", format_args!("it must be whole: {error}"))
    })?;
    let document = Document::of(name, &json)?;
    let mut memory = Memory::of(bytes);
    let mut remarks = Remarks::default();
    remark_unread(&document, &mut remarks)?;
    let buffers = Buffers::read(&document, own, &mut memory, open)?;
    let mut images = Images::of(&document, &buffers);
    let materials = read_materials(&document, &mut images, &mut memory, &mut remarks)?;
    let mut scene = Scene {
        document: &document,
        buffers: &buffers,
        materials: &materials,
        memory,
        model: Model { images: images.images, remarks, ..Model::default() },
        by_parts: HashMap::new(),
        by_index: HashMap::new(),
    };
    scene.place_nodes()?;
    let mut model = scene.model;
    model.materials = materials.into_iter().map(|read| read.material).collect();
    Ok(model)
}

/// Notes what a file has that is not read.
fn remark_unread(document: &Document<'_>, remarks: &mut Remarks) -> Result<(), ModelError> {
    for name in document.root.list("extensionsUsed")? {
        if let Json::Text(name) = name
            && !EXTENSIONS.contains(&&**name)
        {
            remarks.add_unread(&format!("the extension {name}"), 1);
        }
    }
    for field in ["animations", "skins"] {
        remarks.add_unread(field, document.root.list(field)?.len() as u64);
    }
    Ok(())
}

/// A mesh of the model and its material.
type Part = (usize, Option<usize>);

/// The model as it is made of a scene's nodes.
struct Scene<'a> {
    document: &'a Document<'a>,
    buffers: &'a Buffers<'a>,
    materials: &'a [ReadMaterial],
    memory: Memory,
    model: Model,
    /// The mesh of each primitive read so far, if it has triangles.
    by_parts: HashMap<PrimitiveParts, Option<usize>>,
    /// The parts of each mesh of the file read so far.
    by_index: HashMap<usize, Arc<[Part]>>,
}

impl<'a> Scene<'a> {
    fn place_nodes(&mut self) -> Result<(), ModelError> {
        let document = self.document;
        if document.rows(Table::Nodes) == 0 {
            let meshes = document.rows(Table::Meshes);
            // A file of meshes alone places them nowhere; here they stand as they are.
            return (0..meshes).try_for_each(|mesh| self.place_mesh("".into(), mesh, DAffine3::IDENTITY));
        }
        let mut nodes = SceneNodes::of(document, &mut self.model.remarks)?;
        while let Some((node, world)) = nodes.next(&mut self.model.remarks)? {
            if let Some(mesh) = node.index("mesh", document.rows(Table::Meshes))? {
                let name = match node.text("name")? {
                    None | Some("") => document.row(Table::Meshes, mesh)?.text("name")?.unwrap_or_default(),
                    Some(name) => name,
                };
                if world.matrix3.determinant() == 0.0 {
                    self.model.remarks.add_unread("instances that a scale of 0 makes planar", 1);
                } else {
                    self.place_mesh(name.into(), mesh, world)?;
                }
            }
            self.model.cameras.extend(camera(document, &node, world)?);
            self.model.lights.extend(light(document, &node, world, &mut self.model.remarks)?);
        }
        Ok(())
    }

    fn place_mesh(&mut self, name: Arc<str>, index: usize, world: DAffine3) -> Result<(), ModelError> {
        let parts = match self.by_index.get(&index) {
            Some(parts) => parts.clone(),
            None => {
                let parts: Arc<[Part]> = self.parts_of(index)?.into();
                self.by_index.insert(index, parts.clone());
                parts
            }
        };
        // The list of instances is moved while it grows.
        let bytes = 2 * size_of::<Instance>() as u64;
        let file = self.document.root.file;
        self.memory.take(parts.len() as u64, bytes, || [file.into(), format!("the instances of meshes[{index}]")])?;
        self.model.instances.extend(parts.iter().map(|(mesh, material)| Instance {
            name: name.clone(),
            mesh: *mesh,
            material: *material,
            world_from_object: world,
        }));
        Ok(())
    }

    fn parts_of(&mut self, index: usize) -> Result<Vec<Part>, ModelError> {
        let mesh = self.document.row(Table::Meshes, index)?;
        let mut parts = Vec::new();
        for (number, json) in mesh.list("primitives")?.iter().enumerate() {
            let primitive = mesh.item("primitives", number, json)?;
            let material = primitive.index("material", self.materials.len())?;
            parts.extend(self.mesh_of(&primitive, material)?.map(|mesh| (mesh, material)));
        }
        Ok(parts)
    }

    /// The mesh of a primitive, if it has triangles.
    fn mesh_of(&mut self, primitive: &Object<'a>, material: Option<usize>) -> Result<Option<usize>, ModelError> {
        let material = material.map(|index| &self.materials[index]);
        let uv_set = material.map_or(0, |material| material.uv_set);
        let remarks = &mut self.model.remarks;
        let Some(parts) = PrimitiveParts::of(self.document, primitive, uv_set, remarks)? else { return Ok(None) };
        if let Some(known) = self.by_parts.get(&parts) {
            return Ok(*known);
        }
        let mesh = parts.read(self.document, self.buffers, &mut self.memory, remarks)?.cleaned(remarks);
        let TriangleMesh { triangles, normals, uvs, .. } = &mesh;
        let index = if triangles.is_empty() {
            remarks.empty_meshes += 1;
            None
        } else {
            remarks.without_normals += u64::from(normals.is_none());
            remarks.without_uvs += u64::from(uvs.is_none() && material.is_some_and(|material| material.has_texture));
            self.model.meshes.push(Arc::new(mesh));
            Some(self.model.meshes.len() - 1)
        };
        self.by_parts.insert(parts, index);
        Ok(index)
    }
}
