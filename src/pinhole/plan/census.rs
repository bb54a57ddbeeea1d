use super::Table;
use crate::scene::SceneError;
use bevy_ecs::archetype::{Archetype, ArchetypeEntity};
use bevy_ecs::component::ComponentId;
use bevy_ecs::entity_disabling::DefaultQueryFilters;
use bevy_ecs::prelude::*;
use bevy_ecs::query::ArchetypeFilter;
use std::any::{Any, TypeId};
use std::cell::RefCell;
use std::collections::{BTreeMap, HashMap};
use std::ops::Deref;
use std::rc::Rc;
use std::sync::Arc;

/// A scene that is read once: what predicates and tables need of it is computed when it is first needed, and kept.
///
/// Validation, the plan, the tables of a render and the preflight share one census.
/// It borrows the scene, which therefore cannot change meanwhile, and dereferences to it.
pub struct Census<'w> {
    scene: &'w World,
    /// Results by the types of the functions that computed them.
    known: RefCell<HashMap<TypeId, Rc<dyn Any>>>,
    extractions: RefCell<BTreeMap<&'static str, usize>>,
}

impl<'w> Census<'w> {
    /// The census of a scene; nothing is read yet.
    pub fn of(scene: &'w World) -> Self {
        Self { scene, known: RefCell::default(), extractions: RefCell::default() }
    }

    /// A table of the scene, extracted when it is first asked for.
    ///
    /// Errors: what is wrong with the entities that the table is made of; the same each time.
    pub fn table<T: Table>(&self) -> Result<Arc<T>, SceneError> {
        self.once(|census| {
            *census.extractions.borrow_mut().entry(T::NAME).or_default() += 1;
            T::extract(census).map(Arc::new)
        })
    }

    /// How often each table was extracted, by its name.
    pub fn extractions(&self) -> BTreeMap<&'static str, usize> {
        self.extractions.borrow().clone()
    }

    /// The result of a function of the scene, which is called only the first time.
    ///
    /// The result is kept by the type of the function, which must be a closure or a function item that captures nothing.
    pub fn once<A: Clone + 'static, F: Fn(&Census<'_>) -> A + 'static>(&self, find_out: F) -> A {
        const { assert!(size_of::<F>() == 0, "what a function captures is not part of its type") };
        let answer = self.answer(TypeId::of::<F>(), &|| Rc::new(find_out(self)));
        answer.downcast_ref::<A>().cloned().unwrap_or_else(|| find_out(self))
    }

    fn answer(&self, question: TypeId, find_out: &dyn Fn() -> Rc<dyn Any>) -> Rc<dyn Any> {
        let known = self.known.borrow().get(&question).cloned();
        // The map is not borrowed during the call, since that may need further results.
        known.unwrap_or_else(|| {
            let answer = find_out();
            self.known.borrow_mut().insert(question, Rc::clone(&answer));
            answer
        })
    }

    /// The enabled entities that pass a filter, in spawn order.
    ///
    /// A filter passes nothing where it names a component that the scene does not know, not even `Without` of one.
    pub fn entities<F: ArchetypeFilter + 'static>(&self) -> Arc<[Entity]> {
        self.once(|census| entities::<F>(census).into())
    }

    /// The entities that pass a filter, the disabled ones among them.
    pub fn declared<F: ArchetypeFilter + 'static>(&self) -> Arc<[Entity]> {
        self.once(|census| declared::<F>(census).into())
    }
}

/// Gives access to the scene itself.
impl Deref for Census<'_> {
    type Target = World;
    fn deref(&self) -> &World {
        self.scene
    }
}

/// Enabled entities that pass the filter, in spawn order.
pub fn entities<F: ArchetypeFilter>(scene: &World) -> Vec<Entity> {
    let disabling = scene.get_resource::<DefaultQueryFilters>();
    let disabling: Vec<ComponentId> = disabling.into_iter().flat_map(DefaultQueryFilters::disabling_ids).collect();
    found::<F>(scene, &disabling)
}

/// Entities that pass the filter, the disabled ones among them, in spawn order.
pub fn declared<F: ArchetypeFilter>(scene: &World) -> Vec<Entity> {
    found::<F>(scene, &[])
}

/// Entities that pass the filter and have none of the disabling components.
fn found<F: ArchetypeFilter>(scene: &World, disabling: &[ComponentId]) -> Vec<Entity> {
    let Some(state) = F::get_state(scene.components()) else { return Vec::new() };
    in_spawn_order(scene, disabling, &|archetype| F::matches_component_set(&state, &|id| archetype.contains(id)))
}

/// All entities of these lists, each once, in spawn order.
pub fn united(lists: &mut dyn Iterator<Item = Arc<[Entity]>>) -> Vec<Entity> {
    let mut entities = Vec::new();
    lists.for_each(|list| entities.extend_from_slice(&list));
    sort(&mut entities);
    entities.dedup();
    entities
}

fn sort(entities: &mut [Entity]) {
    entities.sort_by_key(|entity| entity.index());
}

/// A query's loop and a sort would be compiled for every filter; this is compiled once.
fn in_spawn_order(scene: &World, disabling: &[ComponentId], matches: &dyn Fn(&Archetype) -> bool) -> Vec<Entity> {
    let enabled = |archetype: &&Archetype| !disabling.iter().any(|component| archetype.contains(*component));
    let archetypes = scene.archetypes().iter().filter(|archetype| matches(archetype)).filter(enabled);
    let mut entities: Vec<Entity> =
        archetypes.flat_map(|archetype| archetype.entities().iter().map(ArchetypeEntity::id)).collect();
    sort(&mut entities);
    entities
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Sphere;
    use bevy_ecs::entity_disabling::Disabled;
    use std::sync::atomic::{AtomicUsize, Ordering};

    static ASKED: AtomicUsize = AtomicUsize::new(0);

    fn count(scene: &Census<'_>) -> usize {
        scene.once(|scene| {
            ASKED.fetch_add(1, Ordering::Relaxed);
            scene.entities::<With<Sphere>>().len()
        })
    }

    #[test]
    fn a_question_is_answered_once_for_each_scene() {
        let (mut two, none) = (World::new(), World::new());
        two.spawn(Sphere::default());
        two.spawn(Sphere::default());
        let (two, none) = (Census::of(&two), Census::of(&none));
        assert_eq!([count(&two), count(&two), count(&none), count(&none)], [2, 2, 0, 0]);
        assert_eq!(ASKED.load(Ordering::Relaxed), 2);
    }

    #[test]
    fn disabled_entities_are_declared_only() {
        let mut scene = World::new();
        let shown = scene.spawn(Sphere::default()).id();
        let hidden = scene.spawn((Sphere::default(), Disabled)).id();
        let census = Census::of(&scene);
        assert_eq!(census.entities::<With<Sphere>>()[..], [shown]);
        assert_eq!(census.declared::<With<Sphere>>()[..], [shown, hidden]);
    }
}
