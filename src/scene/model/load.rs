use super::material::spawn_material;
use super::material_notes::MaterialNotes;
use super::mesh::{Mesh, MeshPart, ModelNotes, UnreadMesh};
use super::open_model::{OpenModel, SceneTime, open_model_now};
use super::placing::placements_of;
use crate::material::is_material;
use crate::{
    ChildOf, Disabled, Emissive, Medium, MeshGeometry, MeshInstance, Name, Placement, UsesMaterial, printable,
};
use bevy_ecs::prelude::*;
use glam::DAffine3;
use pinhole_models::{Instance, TriangleMesh};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Reads the model file of every enabled entity that names one, and spawns its meshes as children of that entity; what has
/// been loaded before stays as it is.
///
/// A file that cannot be read leaves an [`UnreadMesh`], for which extraction refuses the scene.
pub fn load_meshes(scene: &mut World) {
    let mut query = scene.query_filtered::<(Entity, &Mesh), Without<Disabled>>();
    let mut named: Vec<(Entity, Mesh)> = query.iter(scene).map(|(entity, mesh)| (entity, mesh.clone())).collect();
    named.sort_by_key(|(entity, _)| entity.index());
    let loaded: BTreeSet<Entity> = scene.query::<&MeshPart>().iter(scene).map(|part| part.0).collect();
    let mut materials = BTreeMap::new();
    let is_film = scene.contains_resource::<SceneTime>();
    for (entity, mesh) in named.into_iter().filter(|(entity, _)| !loaded.contains(entity)) {
        match open_model_now(scene, &mesh) {
            // What is animated may be scaled to nothing for a while.
            Ok(model) if model.model.instances.is_empty() && (!is_film || model.model.animations.is_empty()) => {
                scene.entity_mut(entity).insert(UnreadMesh(model.nothing()));
            }
            Ok(model) => {
                let mut of_materials = MaterialNotes::default();
                spawn_parts(scene, entity, (&mesh, &model), (&mut materials, &mut of_materials));
                let notes = notes_on(&mesh.file, &model, &of_materials);
                let mut said = scene.get_resource_or_init::<ModelNotes>();
                for note in notes {
                    if !said.0.contains(&note) {
                        said.0.push(note);
                    }
                }
            }
            Err(why) => _ = scene.entity_mut(entity).insert(UnreadMesh(why)),
        }
    }
}

/// What there is to say about a file that was read.
fn notes_on(file: &str, model: &OpenModel, of_materials: &MaterialNotes) -> Vec<String> {
    let sentences = model.model.remarks.sentences().into_iter().chain(of_materials.sentences());
    let name = Path::new(file).file_name().map_or(file.into(), |name| name.to_string_lossy());
    sentences.map(|sentence| format!("{}: {sentence}", printable(&name, 80))).collect()
}

/// Spawns the meshes of a model, with the entity's own material if it has one.
fn spawn_parts(
    scene: &mut World,
    entity: Entity,
    (mesh, model): (&Mesh, &OpenModel),
    (materials, notes): (&mut BTreeMap<(String, bool, usize), Entity>, &mut MaterialNotes),
) {
    let used = scene.get::<UsesMaterial>(entity).map(|used| used.0);
    let has_own = {
        let own = scene.entity(entity);
        is_material(own) || own.contains::<Emissive>() || own.contains::<Medium>()
    };
    let own = used.or_else(|| has_own.then_some(entity));
    // A file of one mesh, placed where it is, needs no entity but the one that names it.
    if let ([only], Some(_)) = (&model.model.instances[..], own)
        && only.world_from_object == DAffine3::IDENTITY
    {
        let geometry = model.geometry[only.mesh].clone();
        scene.entity_mut(entity).insert((MeshInstance { geometry }, MeshPart(entity)));
        return;
    }
    let name = scene.get::<Name>(entity).map(|name| name.as_str().to_owned());
    for (at, instance) in model.model.instances.iter().enumerate() {
        let number = instance.material.unwrap_or(usize::MAX);
        let material = own.unwrap_or_else(|| {
            let key = (mesh.file.clone(), mesh.single_sided, number);
            *materials.entry(key).or_insert_with(|| {
                let material = spawn_material(scene, (model, number), mesh.single_sided, notes);
                scene.entity_mut(material).insert(MeshPart(entity));
                material
            })
        });
        let (geometry, outer, placement) = placed(model, instance);
        let parent = outer.map_or(entity, |outer| scene.spawn((outer, MeshPart(entity), ChildOf(entity))).id());
        let part = scene.spawn((MeshInstance { geometry }, placement, MeshPart(entity), ChildOf(parent))).id();
        scene.entity_mut(part).insert(UsesMaterial(material));
        let own_name = if instance.name.is_empty() { format!("part {}", at + 1) } else { instance.name.to_string() };
        let name = name.as_ref().map_or_else(|| own_name.clone(), |name| format!("{name}, {own_name}"));
        scene.entity_mut(part).insert(Name::new(name));
    }
}

/// An instance's geometry and placement, and the one around it where its matrix shears; a matrix that is too flat for
/// placements is in the geometry.
fn placed(model: &OpenModel, instance: &Instance) -> (MeshGeometry, Option<Placement>, Placement) {
    let geometry = &model.geometry[instance.mesh];
    match placements_of(&instance.world_from_object).as_deref() {
        Some([outer, inner]) => (geometry.clone(), Some(*outer), *inner),
        Some([placement]) => (geometry.clone(), None, *placement),
        _ => {
            let sheared = MeshGeometry::new(sheared(geometry, &instance.world_from_object));
            (sheared, None, Placement::default())
        }
    }
}

fn sheared(mesh: &TriangleMesh, matrix: &DAffine3) -> TriangleMesh {
    let mut mesh = mesh.clone();
    for position in &mut mesh.positions {
        *position = matrix.transform_point3(position.map(f64::from).into()).as_vec3().to_array();
    }
    let normal_from_object = matrix.matrix3.inverse().transpose();
    for normal in mesh.normals.iter_mut().flatten() {
        let turned = normal_from_object * glam::DVec3::from(normal.map(f64::from));
        *normal = turned.normalize_or_zero().as_vec3().to_array();
    }
    if matrix.matrix3.determinant() < 0.0 {
        mesh.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    }
    mesh
}
