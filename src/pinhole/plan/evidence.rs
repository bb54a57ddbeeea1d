use crate::scene::called;
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::prelude::*;
use bevy_ecs::query::{Allow, QueryFilter};

/// Whether the scene needs a stage, and what in the scene requires it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Evidence {
    /// Whether the stage is needed.
    pub needed: bool,
    /// The reason, in words: `3 spheres: "ball", "moon", "ground"`.
    pub reason: String,
    /// The number of entities in use that cause it.
    pub count: usize,
}

impl Evidence {
    /// Needed for every scene.
    pub fn always(reason: &str) -> Self {
        Self { needed: true, reason: reason.into(), count: 0 }
    }

    /// Needed if any enabled entity has the component; `noun` names one such entity.
    pub fn of<C: Component>(scene: &World, noun: &str) -> Self {
        Self::among::<With<C>>(scene, noun, |_| true)
    }

    /// Needed if any enabled entity passes the filter and is in use.
    pub fn among<F: QueryFilter>(scene: &World, noun: &str, in_use: impl Fn(EntityRef<'_>) -> bool) -> Self {
        let enabled = entities::<F>(scene);
        let found: Vec<Entity> = enabled.iter().copied().filter(|&e| in_use(scene.entity(e))).collect();
        Self::from_entities(scene, noun, &found, &enabled, &declared::<F>(scene))
    }

    /// Needed if any enabled entity has one of these components and is in use.
    ///
    /// This is not `Or` in a filter, since a read-only query finds nothing if one of its components was never spawned.
    pub fn among_any(scene: &World, noun: &str, any: &[ComponentKind], in_use: impl Fn(EntityRef<'_>) -> bool) -> Self {
        let all = |find: fn(&ComponentKind) -> fn(&World) -> Vec<Entity>| {
            let mut found: Vec<Entity> = any.iter().flat_map(|component| find(component)(scene)).collect();
            found.sort_by_key(|entity| entity.index());
            found.dedup();
            found
        };
        let enabled = all(|component| component.enabled);
        let found: Vec<Entity> = enabled.iter().copied().filter(|&e| in_use(scene.entity(e))).collect();
        Self::from_entities(scene, noun, &found, &enabled, &all(|component| component.declared))
    }

    /// Needed if any enabled entity that passes the filter is of a kind; other entities are not even mentioned.
    pub fn of_kind<F: QueryFilter>(scene: &World, noun: &str, is_of_kind: impl Fn(Entity) -> bool) -> Self {
        let mut declared = declared::<F>(scene);
        declared.retain(|&entity| is_of_kind(entity));
        let mut found = entities::<F>(scene);
        found.retain(|&entity| is_of_kind(entity));
        Self::from_entities(scene, noun, &found, &found, &declared)
    }

    fn from_entities(scene: &World, noun: &str, found: &[Entity], enabled: &[Entity], declared: &[Entity]) -> Self {
        let mut reason = counted(found.len(), noun);
        if !found.is_empty() {
            reason = format!("{reason}: {}", first_three(scene, found));
        } else if !declared.is_empty() {
            let why = if enabled.is_empty() { "disabled" } else { "unused" };
            reason = format!("{reason} ({} declared: {}, {why})", declared.len(), first_three(scene, declared));
        }
        Self { needed: !found.is_empty(), reason, count: found.len() }
    }

    /// Needed if both are; the second is not evaluated where the first is not needed.
    pub fn and(self, other: impl FnOnce() -> Self) -> Self {
        if !self.needed {
            return self;
        }
        let other = other();
        if !other.needed {
            return other;
        }
        Self { reason: format!("{}; {}", self.reason, other.reason), count: self.count + other.count, ..self }
    }

    /// Needed if either is.
    pub fn or(self, other: Self) -> Self {
        match (self.needed, other.needed) {
            (true, true) => {
                Self { reason: format!("{}; {}", self.reason, other.reason), count: self.count + other.count, ..self }
            }
            (false, false) => Self { reason: format!("{}, {}", self.reason, other.reason), ..self },
            (true, false) => self,
            (false, true) => other,
        }
    }
}

/// A component whose entities evidence looks for.
#[derive(Clone, Copy)]
pub struct ComponentKind {
    enabled: fn(&World) -> Vec<Entity>,
    declared: fn(&World) -> Vec<Entity>,
}

impl ComponentKind {
    /// The component `C`.
    pub const fn of<C: Component>() -> Self {
        Self { enabled: entities::<With<C>>, declared: declared::<With<C>> }
    }
}

/// Enabled entities that pass the filter, in spawn order.
pub fn entities<F: QueryFilter>(scene: &World) -> Vec<Entity> {
    sorted(scene.try_query_filtered::<Entity, F>().map(|mut query| query.iter(scene).collect()))
}

/// Entities that pass the filter, including disabled ones.
fn declared<F: QueryFilter>(scene: &World) -> Vec<Entity> {
    sorted(scene.try_query_filtered::<Entity, (F, Allow<Disabled>)>().map(|mut query| query.iter(scene).collect()))
}

fn sorted(entities: Option<Vec<Entity>>) -> Vec<Entity> {
    let mut entities = entities.unwrap_or_default();
    entities.sort_by_key(|entity| entity.index());
    entities
}

/// A number with its noun: `1 sphere`, `3 spheres`, `2 triangles with normals`.
pub fn counted(count: usize, noun: &str) -> String {
    let ending = if count == 1 { "" } else { "s" };
    match noun.split_once(" with ") {
        Some((noun, what)) => format!("{count} {noun}{ending} with {what}"),
        None => format!("{count} {noun}{ending}"),
    }
}

fn first_three(scene: &World, found: &[Entity]) -> String {
    let names: Vec<String> = found.iter().take(3).map(|&entity| called(scene, entity)).collect();
    let more = if found.len() > 3 { ", …" } else { "" };
    format!("{}{more}", names.join(", "))
}
