use super::animation::{Animated, animated_at, animations_of, said_of};
use super::binary::binary_parts;
use super::buffers::Buffers;
use super::cameras::{camera, light};
use super::document::{Document, Table};
use super::images::Images;
use super::instancing::places_of;
use super::json::Json;
use super::materials::{ReadMaterial, default_material, read_materials};
use super::morph::rest_weights;
use super::nodes::SceneNodes;
use super::object::Object;
use super::primitive::{Pose, PrimitiveParts};
use super::skin::{Worlds, joints_of, worlds_of};
use super::unread::remark_unread;
use crate::memory::Memory;
use crate::model::{Instance, Model, Moment};
use crate::model_error::ModelError;
use crate::open::Open;
use crate::remarks::Remarks;
use crate::triangle_mesh::TriangleMesh;
use glam::DAffine3;
use std::collections::HashMap;
use std::sync::Arc;

/// Reads a glTF file and the buffers it names, at rest or at a moment of its animations.
///
/// Errors: whatever is not as glTF 2.0 demands and matters for the picture.
pub fn read_gltf(name: &str, bytes: &[u8], moment: Option<Moment<'_>>, open: Open<'_>) -> Result<Model, ModelError> {
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
    remark_unread(&document, &json, &mut remarks)?;
    let buffers = Buffers::read(&document, own, &mut memory, open)?;
    let mut images = Images::of(&document, &buffers);
    let materials = read_materials(&document, &mut images, &mut memory, &mut remarks)?;
    let animations = animations_of(&document);
    remarks.animations = said_of(&animations, moment);
    let animated = match moment {
        None => Animated::new(),
        Some(moment) => animated_at(&document, &buffers, moment, &mut memory, &mut remarks)?,
    };
    let mut scene = Scene {
        document: &document,
        buffers: &buffers,
        materials: &materials,
        animated: &animated,
        memory,
        model: Model { images: images.images, animations, remarks, ..Model::default() },
        by_parts: HashMap::new(),
        by_use: HashMap::new(),
        worlds: Worlds::new(),
        joints: HashMap::new(),
    };
    scene.place_nodes()?;
    let mut model = scene.model;
    let by_default = materials.len();
    model.materials = materials.into_iter().map(|read| read.material).collect();
    if model.instances.iter().any(|instance| instance.material == Some(by_default)) {
        model.materials.push(default_material());
    }
    Ok(model)
}

/// A mesh of the model, its material, and whether a skin has placed it in the world; the material behind the last of the
/// file's is the default one.
type Part = (usize, usize, bool);

/// A mesh of the file as a node uses it: its index, its skin, and the weights of its morph targets as bits.
type Use = (usize, Option<usize>, Vec<u64>);

/// The model as it is made of a scene's nodes.
struct Scene<'a> {
    document: &'a Document<'a>,
    buffers: &'a Buffers<'a>,
    materials: &'a [ReadMaterial],
    animated: &'a Animated,
    memory: Memory,
    model: Model,
    /// The mesh of each primitive read so far, if it has triangles.
    by_parts: HashMap<PrimitiveParts, Option<usize>>,
    /// The parts of each mesh of the file read so far.
    by_use: HashMap<Use, Arc<[Part]>>,
    /// The matrices of the nodes, where there are skins.
    worlds: Worlds,
    /// The joints of each skin used so far.
    joints: HashMap<usize, Arc<[DAffine3]>>,
}

impl<'a> Scene<'a> {
    fn place_nodes(&mut self) -> Result<(), ModelError> {
        let document = self.document;
        if document.rows(Table::Nodes) == 0 {
            let meshes = document.rows(Table::Meshes);
            // A file of meshes alone places them nowhere; here they stand as they are.
            return (0..meshes).try_for_each(|mesh| self.place_mesh("".into(), None, mesh, &[DAffine3::IDENTITY]));
        }
        if document.rows(Table::Skins) > 0 {
            let bytes = size_of::<(usize, DAffine3)>() as u64;
            let nodes = document.rows(Table::Nodes) as u64;
            self.memory.take(nodes, bytes, || [document.root.file.into(), "the list of nodes".into()])?;
            self.worlds = worlds_of(document, self.animated)?;
        }
        let mut nodes = SceneNodes::of(document, self.animated, &mut self.model.remarks)?;
        while let Some((index, node, world)) = nodes.next(&mut self.model.remarks)? {
            if let Some(mesh) = node.index("mesh", document.rows(Table::Meshes))? {
                let name = match node.text("name")? {
                    None | Some("") => document.row(Table::Meshes, mesh)?.text("name")?.unwrap_or_default(),
                    Some(name) => name,
                };
                let places = places_of(document, self.buffers, &node, world, &mut self.memory)?;
                let (solid, flat): (Vec<_>, Vec<_>) =
                    places.into_iter().partition(|world| world.matrix3.determinant() != 0.0);
                let remarks = &mut self.model.remarks;
                remarks.add_unread("instances that a scale of 0 makes planar", flat.len() as u64);
                if !solid.is_empty() {
                    self.place_mesh(name.into(), Some((index, &node)), mesh, &solid)?;
                }
            }
            self.model.cameras.extend(camera(document, &node, world)?);
            self.model.lights.extend(light(document, &node, world, &mut self.model.remarks)?);
        }
        Ok(())
    }

    fn place_mesh(
        &mut self,
        name: Arc<str>,
        node: Option<(usize, &Object<'a>)>,
        index: usize,
        worlds: &[DAffine3],
    ) -> Result<(), ModelError> {
        let mesh = self.document.row(Table::Meshes, index)?;
        let animated = node.and_then(|(node, _)| self.animated.get(&node)?.weights.clone());
        let node = node.map(|(_, node)| node);
        let weights = animated.map_or_else(|| rest_weights(node, &mesh), Ok)?;
        let skin = node.map_or(Ok(None), |node| node.index("skin", self.document.rows(Table::Skins)))?;
        let used = (index, skin, weights.iter().map(|weight| weight.to_bits()).collect());
        let parts = match self.by_use.get(&used) {
            Some(parts) => parts.clone(),
            None => {
                let parts: Arc<[Part]> = self.parts_of(&mesh, skin, &weights)?.into();
                self.by_use.insert(used, parts.clone());
                parts
            }
        };
        // The list of instances is moved while it grows.
        let bytes = 2 * size_of::<Instance>() as u64;
        let file = self.document.root.file;
        let count = (parts.len() as u64).saturating_mul(worlds.len() as u64);
        self.memory.take(count, bytes, || [file.into(), format!("the instances of meshes[{index}]")])?;
        for world in worlds {
            self.model.instances.extend(parts.iter().map(|(mesh, material, is_placed)| Instance {
                name: name.clone(),
                mesh: *mesh,
                material: Some(*material),
                // The transform of a node with a skin must be ignored: its joints place the mesh.
                world_from_object: if *is_placed { DAffine3::IDENTITY } else { *world },
            }));
        }
        Ok(())
    }

    fn parts_of(&mut self, mesh: &Object<'a>, skin: Option<usize>, weights: &[f64]) -> Result<Vec<Part>, ModelError> {
        let mut parts = Vec::new();
        for (number, json) in mesh.list("primitives")?.iter().enumerate() {
            let primitive = mesh.item("primitives", number, json)?;
            let material = primitive.index("material", self.materials.len())?;
            let found = self.mesh_of(&primitive, material, skin, weights)?;
            let material = material.unwrap_or(self.materials.len());
            parts.extend(found.map(|(mesh, is_placed)| (mesh, material, is_placed)));
        }
        Ok(parts)
    }

    /// The mesh of a primitive, if it has triangles, and whether a skin has placed it.
    fn mesh_of(
        &mut self,
        primitive: &Object<'a>,
        material: Option<usize>,
        skin: Option<usize>,
        weights: &[f64],
    ) -> Result<Option<(usize, bool)>, ModelError> {
        let material = material.map(|index| &self.materials[index]);
        let uv_set = material.map_or(0, |material| material.uv_set);
        let pose = Pose { uv_set, weights, skin };
        let Some(parts) = PrimitiveParts::of(self.document, primitive, pose, &mut self.model.remarks)? else {
            return Ok(None);
        };
        let is_placed = parts.is_skinned();
        if let Some(known) = self.by_parts.get(&parts) {
            return Ok(known.map(|mesh| (mesh, is_placed)));
        }
        let joints = skin.filter(|_| is_placed).map_or(Ok([].into()), |skin| self.joints_of(skin))?;
        let (file, remarks) = ((self.document, self.buffers), &mut self.model.remarks);
        let mesh = parts.read(file, &joints, &mut self.memory, remarks)?.cleaned(remarks);
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
        Ok(index.map(|mesh| (mesh, is_placed)))
    }

    fn joints_of(&mut self, skin: usize) -> Result<Arc<[DAffine3]>, ModelError> {
        if let Some(known) = self.joints.get(&skin) {
            return Ok(known.clone());
        }
        let object = self.document.row(Table::Skins, skin)?;
        let joints = joints_of(self.document, self.buffers, &object, &self.worlds, &mut self.memory)?;
        let joints: Arc<[DAffine3]> = joints.into();
        self.joints.insert(skin, joints.clone());
        Ok(joints)
    }
}
