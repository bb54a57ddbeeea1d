//! A model's parts as entities of their own, so that each can be edited: its mesh, its placement, its material.

use bevy_ecs::prelude::*;
use pinhole::scene::{ChildOf, Mesh, MeshPart, Name, UsesMaterial};
use std::collections::BTreeSet;

/// More parts stay in their file: a text of so many lines is not for editing.
const MAX_PARTS: usize = 4000;
/// The longest name of an entity in a scene file, in characters.
const LONGEST_NAME: usize = 100;

/// Takes every model apart whose file decides the materials of its parts; the entity that named the file holds the parts
/// together from then on.
///
/// Returns a sentence about each that stays whole.
pub fn take_models_apart(world: &mut World) -> Vec<String> {
    let (mut apart, mut said) = (BTreeSet::new(), Vec::new());
    let named: Vec<(Entity, String)> =
        world.query::<(Entity, &Mesh)>().iter(world).map(|(entity, mesh)| (entity, mesh.file.clone())).collect();
    for (entity, file) in named {
        let parts = world.query::<&MeshPart>().iter(world).filter(|part| part.0 == entity).count();
        let is_one = world.entity(entity).contains::<MeshPart>();
        match parts {
            0 => {}
            _ if is_one => {}
            1..=MAX_PARTS => _ = apart.insert(entity),
            _ => said.push(format!("{file} has {parts} parts and materials, so many that they stay in the file")),
        }
    }
    let parts: Vec<Entity> = world
        .query::<(Entity, &MeshPart)>()
        .iter(world)
        .filter(|(_, part)| apart.contains(&part.0))
        .map(|(entity, _)| entity)
        .collect();
    parts.into_iter().for_each(|part| _ = world.entity_mut(part).remove::<MeshPart>());
    apart.into_iter().for_each(|whole| _ = world.entity_mut(whole).remove::<Mesh>());
    fit_names(world);
    said
}

/// Gives entities names as scene files have them: a line of at most 100 characters, and a name of its own for whatever
/// another entity refers to.
pub fn fit_names(world: &mut World) {
    let mut named: Vec<(Entity, Option<String>)> = world
        .query::<(Entity, Option<&Name>)>()
        .iter(world)
        .map(|(entity, name)| (entity, name.map(|name| name.as_str().to_owned())))
        .collect();
    named.sort_by_key(|(entity, _)| entity.index());
    let mut meant: BTreeSet<Entity> = world.query::<&ChildOf>().iter(world).map(ChildOf::parent).collect();
    meant.extend(world.query::<&UsesMaterial>().iter(world).map(|used| used.0));
    let mut taken: BTreeSet<String> = BTreeSet::new();
    for pass in [true, false] {
        for (entity, name) in named.iter().filter(|(entity, _)| meant.contains(entity) == pass) {
            let own = match name {
                None if !pass => continue,
                name => line(name.as_deref().unwrap_or_default()),
            };
            let mut fit = own.clone();
            // A name that nobody refers to may be that of several, but not of one that is referred to.
            let mut number = 2;
            while taken.contains(&fit) {
                let suffix = format!(" {number}");
                fit = own.chars().take(LONGEST_NAME - suffix.len()).chain(suffix.chars()).collect();
                number += 1;
            }
            if pass {
                taken.insert(fit.clone());
            }
            if name.as_ref() != Some(&fit) {
                world.entity_mut(*entity).insert(Name::new(fit));
            }
        }
    }
}

/// What a scene file can hold of a name.
fn line(name: &str) -> String {
    let line: String = name.chars().filter(|letter| !letter.is_control()).take(LONGEST_NAME).collect();
    if line.is_empty() { "unnamed".into() } else { line }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_such_as_a_scene_file_holds() {
        let mut world = World::new();
        let long = "ü".repeat(120);
        let gold = world.spawn(Name::new("gold")).id();
        let twin = world.spawn(Name::new("gold")).id();
        let lines = world.spawn((Name::new("a\nb"), UsesMaterial(twin))).id();
        let whole = world.spawn(Name::new(long.clone())).id();
        let twice = world.spawn((Name::new(long), UsesMaterial(gold), ChildOf(whole))).id();
        let none = world.spawn_empty().id();
        world.spawn(ChildOf(none));
        fit_names(&mut world);
        let name = |entity: Entity| world.get::<Name>(entity).map(|name| name.as_str().to_owned()).unwrap_or_default();
        assert_eq!([gold, twin, lines, none].map(name), ["gold", "gold 2", "ab", "unnamed"]);
        assert_eq!(name(whole), "ü".repeat(100));
        assert_eq!(name(twice), format!("{} 2", "ü".repeat(98)));
        let before: Vec<String> = [gold, twin, lines, whole, twice, none].map(name).to_vec();
        fit_names(&mut world);
        let name = |entity: Entity| world.get::<Name>(entity).map(|name| name.as_str().to_owned()).unwrap_or_default();
        assert_eq!([gold, twin, lines, whole, twice, none].map(name).to_vec(), before, "fitting names stay");
    }
}
