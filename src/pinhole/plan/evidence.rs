use crate::scene::called;
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::prelude::*;
use bevy_ecs::query::{Allow, QueryFilter};

/// Whether the scene needs a stage, and what in the scene says so.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Evidence {
    /// Whether the stage is needed.
    pub needed: bool,
    /// Why, in words: `3 spheres: "ball", "moon", "ground"`.
    pub reason: String,
    /// How many reachable entities cause it.
    pub count: usize,
}

impl Evidence {
    /// Needed whatever the scene holds.
    pub fn always(reason: &str) -> Self {
        Self { needed: true, reason: reason.into(), count: 0 }
    }

    /// Needed if any enabled entity has the component; `noun` names one of them.
    pub fn of<C: Component>(scene: &World, noun: &str) -> Self {
        Self::among::<With<C>>(scene, noun, |_| true)
    }

    /// Needed if any enabled entity passes the filter and `reachable`.
    pub fn among<F: QueryFilter>(scene: &World, noun: &str, reachable: impl Fn(EntityRef<'_>) -> bool) -> Self {
        let enabled = entities::<F>(scene);
        let found: Vec<Entity> = enabled.iter().copied().filter(|&e| reachable(scene.entity(e))).collect();
        Self::told(scene, noun, &found, &enabled, &declared::<F>(scene))
    }

    /// Needed if any enabled entity carries one of these components and is `reachable`.
    ///
    /// Not `Or` in a filter: a query that only reads finds nothing where one of its components was never spawned.
    pub fn among_any(
        scene: &World,
        noun: &str,
        any: &[ComponentKind],
        reachable: impl Fn(EntityRef<'_>) -> bool,
    ) -> Self {
        let all = |find: fn(&ComponentKind) -> fn(&World) -> Vec<Entity>| {
            let mut found: Vec<Entity> = any.iter().flat_map(|carried| find(carried)(scene)).collect();
            found.sort_by_key(|entity| entity.index());
            found.dedup();
            found
        };
        let enabled = all(|carried| carried.enabled);
        let found: Vec<Entity> = enabled.iter().copied().filter(|&e| reachable(scene.entity(e))).collect();
        Self::told(scene, noun, &found, &enabled, &all(|carried| carried.declared))
    }

    /// Needed if any enabled entity that passes the filter is of a kind; those of another kind count for nothing.
    pub fn of_kind<F: QueryFilter>(scene: &World, noun: &str, is_of_kind: impl Fn(Entity) -> bool) -> Self {
        let mut declared = declared::<F>(scene);
        declared.retain(|&entity| is_of_kind(entity));
        let mut found = entities::<F>(scene);
        found.retain(|&entity| is_of_kind(entity));
        Self::told(scene, noun, &found, &found, &declared)
    }

    fn told(scene: &World, noun: &str, found: &[Entity], enabled: &[Entity], declared: &[Entity]) -> Self {
        let mut reason = counted(found.len(), noun);
        if !found.is_empty() {
            reason = format!("{reason}: {}", first_three(scene, found));
        } else if !declared.is_empty() {
            let why = if enabled.is_empty() { "disabled" } else { "unused" };
            reason = format!("{reason} ({} declared: {}, {why})", declared.len(), first_three(scene, declared));
        }
        Self { needed: !found.is_empty(), reason, count: found.len() }
    }

    /// Needed if both are; the other is not looked at where this is not.
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

/// A component, as evidence looks for those that carry it.
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

/// Entities that pass the filter, the disabled ones among them.
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
