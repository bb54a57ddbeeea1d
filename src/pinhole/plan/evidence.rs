use super::Census;
use super::census::united;
use crate::scene::called;
use bevy_ecs::prelude::*;
use bevy_ecs::query::ArchetypeFilter;
use std::sync::Arc;

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
    pub fn of<C: Component>(scene: &Census<'_>, noun: &str) -> Self {
        let enabled = scene.entities::<With<C>>();
        Self::found_among(scene, noun, &enabled, &enabled, &scene.declared::<With<C>>())
    }

    /// Needed if any enabled entity passes the filter and is in use.
    pub fn among<F: ArchetypeFilter + 'static>(
        scene: &Census<'_>,
        noun: &str,
        in_use: impl Fn(EntityRef<'_>) -> bool,
    ) -> Self {
        Self::in_use(scene, noun, &in_use, &scene.entities::<F>(), &scene.declared::<F>())
    }

    /// Needed if any enabled entity has one of these components and is in use.
    ///
    /// This is not `Or` in a filter, since a read-only query finds nothing if one of its components was never spawned.
    pub fn among_any(
        scene: &Census<'_>,
        noun: &str,
        any: &[ComponentKind],
        in_use: impl Fn(EntityRef<'_>) -> bool,
    ) -> Self {
        let enabled = united(&mut any.iter().map(|component| (component.enabled)(scene)));
        let declared = united(&mut any.iter().map(|component| (component.declared)(scene)));
        Self::in_use(scene, noun, &in_use, &enabled, &declared)
    }

    /// Needed if any enabled entity that passes the filter is of a kind; other entities are not even mentioned.
    pub fn of_kind<F: ArchetypeFilter + 'static>(
        scene: &Census<'_>,
        noun: &str,
        is_of_kind: impl Fn(Entity) -> bool,
    ) -> Self {
        let of_kind = |all: Arc<[Entity]>| all.iter().copied().filter(|&entity| is_of_kind(entity)).collect::<Vec<_>>();
        let (found, declared) = (of_kind(scene.entities::<F>()), of_kind(scene.declared::<F>()));
        Self::found_among(scene, noun, &found, &found, &declared)
    }

    /// Needed if any of these enabled entities is in use; those declared, the disabled ones among them, are mentioned
    /// where none is.
    pub fn among_entities(
        scene: &Census<'_>,
        noun: &str,
        in_use: impl Fn(Entity) -> bool,
        enabled: &[Entity],
        declared: &[Entity],
    ) -> Self {
        Self::in_use(scene, noun, &|entity| in_use(entity.id()), enabled, declared)
    }

    fn in_use(
        scene: &World,
        noun: &str,
        in_use: &dyn Fn(EntityRef<'_>) -> bool,
        enabled: &[Entity],
        declared: &[Entity],
    ) -> Self {
        let found: Vec<Entity> = enabled.iter().copied().filter(|&entity| in_use(scene.entity(entity))).collect();
        Self::found_among(scene, noun, &found, enabled, declared)
    }

    fn found_among(scene: &World, noun: &str, found: &[Entity], enabled: &[Entity], declared: &[Entity]) -> Self {
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
        if self.needed { self.with(other()) } else { self }
    }

    fn with(self, other: Self) -> Self {
        if !other.needed {
            return other;
        }
        Self { reason: joined(&self.reason, "; ", &other.reason), count: self.count + other.count, ..self }
    }

    /// Needed if either is.
    pub fn or(self, other: Self) -> Self {
        match (self.needed, other.needed) {
            (true, true) => {
                Self { reason: joined(&self.reason, "; ", &other.reason), count: self.count + other.count, ..self }
            }
            (false, false) => Self { reason: joined(&self.reason, ", ", &other.reason), ..self },
            (true, false) => self,
            (false, true) => other,
        }
    }
}

/// Two lists of reasons in one, each reason once.
fn joined(one: &str, between: &str, other: &str) -> String {
    let is_new = |reason: &&str| !one.split(between).any(|own| own == *reason);
    let new = other.split(between).filter(is_new);
    new.fold(one.to_string(), |list, reason| format!("{list}{between}{reason}"))
}

type Find = fn(&Census<'_>) -> Arc<[Entity]>;

/// A component whose entities evidence looks for.
#[derive(Clone, Copy)]
pub struct ComponentKind {
    enabled: Find,
    declared: Find,
}

impl ComponentKind {
    /// The component `C`.
    pub const fn of<C: Component>() -> Self {
        Self { enabled: |scene| scene.entities::<With<C>>(), declared: |scene| scene.declared::<With<C>>() }
    }
}

/// A number with its noun: `1 sphere`, `3 spheres`, `2 triangles with normals`, `2 lights without an area`.
pub fn counted(count: usize, noun: &str) -> String {
    let (noun, what) = noun.split_at(noun.find(" with").unwrap_or(noun.len()));
    // Written as the stages are that intersect them.
    for (one, several) in [("torus", "tori"), ("medium", "media")] {
        if let (true, Some(before)) = (count != 1, noun.strip_suffix(one)) {
            return format!("{count} {before}{several}{what}");
        }
    }
    let ending = match count {
        1 => "",
        _ if noun.ends_with('s') || noun.ends_with("sh") => "es",
        _ => "s",
    };
    format!("{count} {noun}{ending}{what}")
}

fn first_three(scene: &World, found: &[Entity]) -> String {
    let names: Vec<String> = found.iter().take(3).map(|&entity| called(scene, entity)).collect();
    let more = if found.len() > 3 { ", …" } else { "" };
    format!("{}{more}", names.join(", "))
}
