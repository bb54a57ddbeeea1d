use super::read::LONGEST_NAME;
use super::word::{Word, text_of};
use crate::{
    ChildOf, Disabled, Mesh, MeshInstance, MeshPart, Name, SceneError, UnreadMesh, UsedByShapes, UsesMaterial, called,
    meshes_in_memory, printable,
};
use bevy_ecs::component::ComponentId;
use bevy_ecs::prelude::*;
use bevy_ecs::resource::IsResource;
use std::any::TypeId;
use std::collections::{BTreeSet, HashMap};

/// The width up to which an entity is written on one line.
const WIDTH: usize = 120;

/// A scene as the text of a file, with entities in spawn order; equal scenes give equal text.
///
/// A component that another one on its entity requires is left out if it has its default value.
/// A mesh that a program made is named as the file that [`meshes_in_memory`] names for it.
///
/// Errors: something that a file cannot express: a component without a word, a name that is not one line of text, or a
/// parent or material without a unique name.
pub fn scene_text(scene: &World) -> Result<String, SceneError> {
    // What was made of a model file is in that file.
    let mut entities = spawned(scene);
    entities.retain(|entity| entity.get::<MeshPart>().is_none_or(|part| part.0 == entity.id()));
    let mut files: HashMap<Entity, String> = HashMap::new();
    for mesh in meshes_in_memory(scene) {
        files.extend(mesh.instances.into_iter().map(|instance| (instance, mesh.file.clone())));
    }
    let mut carriers: HashMap<&str, usize> = HashMap::new();
    for name in entities.iter().filter_map(|entity| entity.get::<Name>()) {
        *carriers.entry(name.as_str()).or_default() += 1;
    }
    let mut text = String::from("[\n");
    for entity in &entities {
        let parts = parts(scene, entity, &carriers, files.get(&entity.id()))?;
        let line = format!("    ({}),\n", parts.join(", "));
        if line.chars().count() <= WIDTH + 1 {
            text.push_str(&line);
        } else {
            text.push_str(&format!("    (\n        {},\n    ),\n", parts.join(",\n        ")));
        }
    }
    text.push_str("]\n");
    Ok(text)
}

/// Every entity of a scene but resources, in spawn order.
pub fn spawned(scene: &World) -> Vec<EntityRef<'_>> {
    let mut entities: Vec<EntityRef<'_>> = scene
        .archetypes()
        .iter()
        .flat_map(|archetype| archetype.entities())
        .filter_map(|entity| scene.get_entity(entity.id()).ok())
        .filter(|entity| !entity.contains::<IsResource>())
        .collect();
    entities.sort_by_key(|entity| entity.id().index());
    entities
}

/// An entity's words with their values.
fn parts(
    scene: &World,
    entity: &EntityRef<'_>,
    carriers: &HashMap<&str, usize>,
    mesh: Option<&String>,
) -> Result<Vec<String>, SceneError> {
    let who = called(scene, entity.id());
    let mut parts = Vec::new();
    if let Some(name) = entity.get::<Name>() {
        if name.chars().any(char::is_control) || name.chars().count() > LONGEST_NAME {
            let value = format!("\"{}\"", printable(name, LONGEST_NAME));
            let accepted = format!("in a scene file a name is one line of at most {LONGEST_NAME} characters");
            return Err(SceneError::new("an entity", "name", value, accepted));
        }
        parts.push(format!("name: {}", quoted(name)?));
    }
    let refer = |word: &'static str, other: Entity| match scene.get::<Name>(other) {
        Some(name) if carriers.get(name.as_str()) == Some(&1) => Ok(format!("{word}: {}", quoted(name)?)),
        _ => {
            let accepted = "a scene file refers to it by name, so its name must be unique";
            Err(SceneError::new(who.clone(), word, called(scene, other), accepted))
        }
    };
    if let Some(parent) = entity.get::<ChildOf>() {
        parts.push(refer("parent", parent.parent())?);
    }
    if let Some(material) = entity.get::<UsesMaterial>() {
        parts.push(refer("material", material.0)?);
    }
    check_components(scene, entity, &who)?;
    let brought = brought_along(scene, entity);
    for word in Word::all() {
        let mesh = mesh.filter(|_| (word.kind)() == TypeId::of::<Mesh>());
        let mesh = mesh.map(|file| text_of(&Mesh { file: file.clone(), ..Mesh::default() }));
        let Some(text) = (word.write)(entity).or(mesh) else { continue };
        let text = text.map_err(|error| unwritable(&who, word.word, &error))?;
        let comes_along = scene.components().get_id((word.kind)()).is_some_and(|id| brought.contains(&id));
        if !(comes_along && (word.of_default)().as_ref() == Some(&text)) {
            parts.push(format!("{}: {text}", word.word));
        }
    }
    if entity.contains::<Disabled>() {
        parts.push("disabled: true".into());
    }
    Ok(parts)
}

/// Checks that every component has a word, since it would be lost otherwise.
fn check_components(scene: &World, entity: &EntityRef<'_>, who: &str) -> Result<(), SceneError> {
    let relations = [
        TypeId::of::<Name>(),
        TypeId::of::<ChildOf>(),
        TypeId::of::<Children>(),
        TypeId::of::<UsesMaterial>(),
        TypeId::of::<UsedByShapes>(),
        TypeId::of::<Disabled>(),
        TypeId::of::<MeshInstance>(),
        TypeId::of::<MeshPart>(),
        TypeId::of::<UnreadMesh>(),
    ];
    for &id in entity.archetype().components() {
        let Some(info) = scene.components().get_info(id) else { continue };
        let has_word = info
            .type_id()
            .is_some_and(|kind| relations.contains(&kind) || Word::all().any(|word| (word.kind)() == kind));
        if !has_word {
            let accepted = "scene files have no word for it";
            return Err(SceneError::new(who, "component", info.name().shortname(), accepted));
        }
    }
    Ok(())
}

/// The components that others on the entity require, in the sense of `#[require]`.
fn brought_along(scene: &World, entity: &EntityRef<'_>) -> BTreeSet<ComponentId> {
    let infos = entity.archetype().components().iter().filter_map(|&id| scene.components().get_info(id));
    infos.flat_map(|info| info.required_components().iter_ids()).collect()
}

fn quoted(text: &str) -> Result<String, SceneError> {
    ron::to_string(text).map_err(|error| unwritable(text, "name", &error))
}

fn unwritable(who: &str, field: &'static str, error: &ron::Error) -> SceneError {
    SceneError::new(who, field, error, "it must be possible to write it as RON")
}
