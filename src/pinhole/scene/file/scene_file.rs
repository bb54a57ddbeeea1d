use super::mistake::{Mistake, place_of};
use super::read::{FileEntity, read_entity};
use super::refer::resolve;
use super::scan::{entities, fields};
use super::{FileProblem, PlaceInFile};
use crate::scene::{ChildOf, Disabled, Name, SceneError, SceneFolder, UsesMaterial};
use bevy_ecs::prelude::*;
use std::path::{Path, PathBuf};

/// Stands around the number of an entity that is called by it: Unicode keeps it for such uses, and messages show it as it
/// is.
const MARK: char = '\u{fdd0}';

/// A scene that was read from a file, and where in the file each part of it stands.
pub struct SceneFile {
    /// The file as it was named.
    pub path: PathBuf,
    text: String,
    entities: Vec<FileEntity>,
}

impl SceneFile {
    /// A scene from the text of a file.
    ///
    /// Errors: the first slip in it, with line and column.
    pub fn parse(path: &Path, text: String) -> Result<Self, FileProblem> {
        let read = || -> Result<Vec<FileEntity>, Mistake> {
            let mut read = Vec::new();
            for entity in entities(&text)? {
                read.push(read_entity(&text, &entity)?);
            }
            resolve(&text, &mut read)?;
            Ok(read)
        };
        match read() {
            Ok(entities) => Ok(Self { path: path.into(), text, entities }),
            Err(mistake) => {
                let place = Some(place_of(&text, mistake.at));
                Err(FileProblem { path: path.into(), place, what: mistake.what })
            }
        }
    }

    /// How many entities the file holds.
    pub fn len(&self) -> usize {
        self.entities.len()
    }

    /// Whether the file holds no entity.
    pub fn is_empty(&self) -> bool {
        self.entities.is_empty()
    }

    /// The scene, its entities spawned in the order of the file.
    pub fn world(&self) -> World {
        self.world_of(|entity, _| entity.name.clone())
    }

    /// Where the cause of a refusal stands: the value of the field that it names, or else the entity's beginning.
    ///
    /// `refuse` gets the scene with entities that are called by their number, so that two of one name, or of none, can
    /// be told apart.
    pub fn place_of(&self, refuse: impl FnOnce(&mut World) -> Option<SceneError>) -> Option<PlaceInFile> {
        let scene_error = refuse(&mut self.world_of(|_, number| Some(format!("{MARK}{number}{MARK}"))))?;
        let marked = |text: &str| text.rsplit(MARK).nth(1).and_then(|number| number.parse::<usize>().ok());
        let number = marked(&scene_error.entity).or_else(|| marked(&scene_error.value))?;
        let entity = self.entities.get(number)?;
        let kind = scene_error.entity.split(' ').next().unwrap_or("");
        // A part of a field is named after it, as in `filter radius`.
        let outer = scene_error.field.split(' ').next().unwrap_or("");
        let at = self.field(entity, kind, scene_error.field).or_else(|| self.field(entity, kind, outer));
        let at = at.unwrap_or(entity.at);
        Some(place_of(&self.text, at))
    }

    /// Where a file asks for a view.
    pub fn place_of_word(&self, word: &str) -> Option<PlaceInFile> {
        let mut parts = self.entities.iter().flat_map(|entity| &entity.parts);
        parts.find(|part| part.word == word).map(|part| place_of(&self.text, part.at))
    }

    /// The bytes before a field's value, or before the word that a component has: in the kind that a refusal names, or
    /// else in any.
    fn field(&self, entity: &FileEntity, kind: &str, field: &str) -> Option<usize> {
        let mut parts: Vec<_> = entity.parts.iter().collect();
        parts.sort_by_key(|part| !part.word.starts_with(kind));
        parts.iter().find_map(|part| {
            if part.word == field {
                return Some(part.at);
            }
            let fields = fields(&self.text, part.value.clone());
            fields.iter().find(|own| own.word == field).map(|own| own.value.start)
        })
    }

    fn world_of(&self, name: impl Fn(&FileEntity, usize) -> Option<String>) -> World {
        let mut world = World::new();
        let spawned: Vec<Entity> = self.entities.iter().map(|_| world.spawn_empty().id()).collect();
        for (number, entity) in self.entities.iter().enumerate() {
            let mut put = world.entity_mut(spawned[number]);
            if let Some(name) = name(entity, number) {
                put.insert(Name::new(name));
            }
            for component in &entity.components {
                component(&mut put);
            }
            if let Some(parent) = entity.parent {
                put.insert(ChildOf(spawned[parent]));
            }
            if let Some(material) = entity.material {
                put.insert(UsesMaterial(spawned[material]));
            }
            if entity.disabled {
                put.insert(Disabled);
            }
        }
        // Last, so that entities keep the numbers that their order gives them.
        world.insert_resource(SceneFolder::of(&self.path));
        world
    }
}
