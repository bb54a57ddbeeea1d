//! The materials of a scene, by what the list of BSDFs says of their components.

use super::{Bsdf, BsdfClass, ErasedBsdf, Interior, MaterialKind, Parameters, for_each_bsdf};
use crate::check::kind_and_name;
use crate::plan::{Added, Census, TableKind, add_kind, united, with_added};
use crate::scene::{Feeds, Rgb, SceneError};
use bevy_ecs::prelude::*;
use std::sync::Arc;

/// Inserts a material into an entity.
pub type Spawn = Box<dyn Fn(&mut EntityWorldMut<'_>) + Send + Sync>;

/// A BSDF without its type.
#[derive(Clone, Copy)]
pub struct Registration {
    /// Its kind.
    pub kind: MaterialKind,
    /// How it scatters.
    pub class: BsdfClass,
    /// Whether light passes through its surface.
    pub transmits: bool,
    /// What textures may give it in place of its own, its normal aside.
    pub takes: &'static [Feeds],
    /// The name of its component.
    pub component: &'static str,
    /// The component's word in messages.
    pub word: &'static str,
    /// One such surface, in the reasons of the plan.
    pub noun: &'static str,
    /// The table of its parameters.
    pub table: fn() -> TableKind,
    entities: fn(&Census<'_>) -> Arc<[Entity]>,
    declared: fn(&Census<'_>) -> Arc<[Entity]>,
    carries: fn(&Census<'_>, Entity) -> bool,
    kind_of: fn(&Census<'_>, Entity) -> MaterialKind,
    parameters: fn(&Census<'_>, Entity, &str) -> Result<Parameters, SceneError>,
    interior: fn(&Census<'_>, Entity, &str) -> Result<Option<Interior>, SceneError>,
    albedo_beside_colour: fn(&Census<'_>, Entity) -> Option<Rgb>,
    /// Its materials for tests, and how far their albedo may fall short of 1 where nothing should be absorbed.
    pub examples: fn() -> Vec<(Spawn, Option<f64>)>,
    /// Its BSDF in a scene, for tests and figures.
    pub bsdf: fn(&Census<'_>) -> Result<Box<dyn ErasedBsdf>, SceneError>,
}

/// The component of an entity that has it.
fn of<'s, B: Bsdf>(scene: &'s Census<'_>, entity: Entity) -> Option<&'s B::Component> {
    scene.get::<B::Component>(entity)
}

impl Registration {
    const fn of<B: Bsdf>() -> Self {
        Self {
            kind: B::KIND,
            class: B::CLASS,
            transmits: B::TRANSMITS,
            takes: B::TAKES,
            component: B::COMPONENT,
            word: B::WORD,
            noun: B::NOUN,
            table: TableKind::of::<B>,
            entities: |scene| scene.entities::<With<B::Component>>(),
            declared: |scene| scene.declared::<With<B::Component>>(),
            carries: |scene, entity| of::<B>(scene, entity).is_some(),
            kind_of: |scene, entity| of::<B>(scene, entity).map_or(B::KIND, B::kind_of),
            parameters: |scene, entity, who| {
                of::<B>(scene, entity).map_or(Ok(Parameters::default()), |own| B::parameters(own, who))
            },
            interior: |scene, entity, who| of::<B>(scene, entity).map_or(Ok(None), |own| B::interior(own, who)),
            albedo_beside_colour: |scene, entity| of::<B>(scene, entity).and_then(B::albedo_beside_colour),
            examples: || {
                let spawn = |component: B::Component| -> Spawn {
                    Box::new(move |entity| {
                        entity.insert(component.clone());
                    })
                };
                B::examples().into_iter().map(|own| (spawn(own.component), own.lossless_to)).collect()
            },
            bsdf: |scene| Ok(Box::new(scene.table::<B>()?)),
        }
    }

    /// Whether textures may give it this.
    pub(crate) fn takes(&self, feeds: Feeds) -> bool {
        feeds == Feeds::Normal || self.takes.contains(&feeds)
    }

    /// The surface's parameters, after checking the values of a material that has this component.
    pub fn parameters(&self, scene: &Census<'_>, entity: Entity) -> Result<Parameters, SceneError> {
        (self.parameters)(scene, entity, &kind_and_name(scene, self.word, entity))
    }

    /// What fills a closed shape of a material that has this component.
    pub fn interior(&self, scene: &Census<'_>, entity: Entity) -> Result<Option<Interior>, SceneError> {
        (self.interior)(scene, entity, &kind_and_name(scene, self.word, entity))
    }

    /// The kind of a material that has this component.
    pub fn kind(&self, scene: &Census<'_>, entity: Entity) -> MaterialKind {
        (self.kind_of)(scene, entity)
    }

    /// The albedo beside that of the colour of a material that has this component.
    pub fn albedo_beside_colour(&self, scene: &Census<'_>, entity: Entity) -> Option<Rgb> {
        (self.albedo_beside_colour)(scene, entity)
    }
}

macro_rules! registered {
    ($($kind:ident($table:ident, $name:literal),)+) => {
        /// The BSDFs of the library, in the order of their kinds.
        pub static REGISTERED: &[Registration] = &[$(Registration::of::<crate::material::$table>()),+];
    };
}

for_each_bsdf!(registered);

/// All BSDFs: those of the library, and then those that the scene adds.
pub fn registered_materials<'s>(scene: &'s Census<'_>) -> impl Iterator<Item = &'s Registration> + Clone {
    with_added(REGISTERED, scene)
}

/// Adds a material of one's own to those that a scene may have, before it is planned.
pub fn add_material<B: Bsdf>(scene: &mut World) {
    let (table, entities) = (TableKind::of::<B>(), |scene: &Census<'_>| scene.entities::<With<B::Component>>());
    let added = Added { table, word: B::WORD, entities, stages: "of_material" };
    add_kind::<B, _>(scene, Registration::of::<B>(), added);
}

/// Checks that no two BSDFs have the same kind.
///
/// Errors: one that a program adds with the number of another.
pub(crate) fn check_kinds(scene: &Census<'_>) -> Result<(), SceneError> {
    for (at, own) in registered_materials(scene).enumerate() {
        if let Some(other) = registered_materials(scene).skip(at + 1).find(|other| other.kind == own.kind) {
            let value = format!("that of {}", own.component);
            return Err(SceneError::new(other.component, "number", value, NUMBERS));
        }
    }
    Ok(())
}

/// What is asked of the numbers that a program gives to what it adds.
pub(crate) const NUMBERS: &str = "each shape, and each material, that a program adds needs one of its own";

/// The enabled entities that carry a material, in spawn order, one for each row of the table.
pub fn material_entities(scene: &Census<'_>) -> Arc<[Entity]> {
    scene.once(|scene| united(&mut registered_materials(scene).map(|own| (own.entities)(scene))).into())
}

/// The same with the disabled ones.
pub fn declared_materials(scene: &Census<'_>) -> Arc<[Entity]> {
    scene.once(|scene| united(&mut registered_materials(scene).map(|own| (own.declared)(scene))).into())
}

/// The first BSDF whose component an entity carries.
fn registration<'s>(scene: &'s Census<'_>, entity: Entity) -> Option<&'s Registration> {
    registered_materials(scene).find(|own| (own.carries)(scene, entity))
}

/// The kind of an entity's material; none where it has none.
pub fn material_kind(scene: &Census<'_>, entity: Entity) -> Option<MaterialKind> {
    registration(scene, entity).map(|own| own.kind(scene, entity))
}

/// The enabled entities whose material is of one kind, in spawn order, one for each row of its table.
pub fn entities_of_kind(scene: &Census<'_>, kind: MaterialKind) -> Vec<Entity> {
    material_entities(scene).iter().copied().filter(|&entity| material_kind(scene, entity) == Some(kind)).collect()
}

/// Whether an entity, enabled or not, carries a material.
pub fn is_material(scene: &Census<'_>, entity: Entity) -> bool {
    registration(scene, entity).is_some()
}

/// What fills a closed shape of an entity's material.
pub(crate) fn interior_of(scene: &Census<'_>, entity: Entity) -> Result<Option<Interior>, SceneError> {
    registration(scene, entity).map_or(Ok(None), |own| own.interior(scene, entity))
}

/// Some of the components that are materials, in words: `Matte, Phong … or Metal`.
pub(crate) fn components_in_words(scene: &Census<'_>, article: &str, such: impl Fn(&Registration) -> bool) -> String {
    let each = registered_materials(scene).filter(|own| such(own));
    let names: Vec<String> = each.map(|own| format!("{article}{}", own.component)).collect();
    match &names[..] {
        [] => String::new(),
        [one] => one.clone(),
        [others @ .., last] => format!("{} or {last}", others.join(", ")),
    }
}

/// The one material component of an entity.
pub(crate) fn one_material<'s>(scene: &'s Census<'_>, entity: Entity) -> Result<&'s Registration, SceneError> {
    let present: Vec<&Registration> = registered_materials(scene).filter(|own| (own.carries)(scene, entity)).collect();
    match present[..] {
        [one] => Ok(one),
        _ => {
            let names: Vec<&str> = present.iter().map(|own| own.component).collect();
            let value = format!("{} at once", names.join(" and "));
            let who = kind_and_name(scene, "material", entity);
            Err(SceneError::new(who, "material", value, "an entity may be one material only"))
        }
    }
}
