use super::Table;
use crate::scene::SceneError;
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::prelude::*;
use bevy_ecs::query::{Allow, QueryFilter};
use std::any::{Any, TypeId};
use std::cell::RefCell;
use std::collections::{BTreeMap, HashMap};
use std::ops::Deref;
use std::sync::Arc;

/// A scene that is read once: whatever predicates and tables ask about it is determined at the first request, and
/// cached.
///
/// Validation, the plan, a render's tables and the preflight checks share one census.
/// It borrows the scene, which therefore cannot change meanwhile, and dereferences to its [`World`].
pub struct Census<'w> {
    scene: &'w World,
    /// Cached answers, by the type of the question.
    known: RefCell<HashMap<TypeId, Box<dyn Any>>>,
    extractions: RefCell<BTreeMap<&'static str, usize>>,
}

impl<'w> Census<'w> {
    /// The census of a scene; nothing is read yet.
    pub fn of(scene: &'w World) -> Self {
        Self { scene, known: RefCell::default(), extractions: RefCell::default() }
    }

    /// A table of the scene, extracted at the first request.
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

    /// The result of a function of the scene, which is called at the first request.
    ///
    /// The result is cached by the type of the function, so this must be a closure or a function item that captures
    /// nothing.
    pub fn once<A: Clone + 'static, F: Fn(&Census<'_>) -> A + 'static>(&self, find_out: F) -> A {
        const { assert!(size_of::<F>() == 0, "what a function captures is not part of its type") };
        let question = TypeId::of::<F>();
        let known = self.known.borrow().get(&question).and_then(|answer| answer.downcast_ref::<A>()).cloned();
        // The lock is not held during the call, which may make further requests.
        known.unwrap_or_else(|| {
            let answer = find_out(self);
            self.known.borrow_mut().insert(question, Box::new(answer.clone()));
            answer
        })
    }

    /// The enabled entities that pass a filter, in spawn order.
    pub fn entities<F: QueryFilter + 'static>(&self) -> Arc<[Entity]> {
        self.once(|census| entities::<F>(census).into())
    }

    /// The entities that pass a filter, including disabled ones.
    pub fn declared<F: QueryFilter + 'static>(&self) -> Arc<[Entity]> {
        self.once(|census| entities::<(F, Allow<Disabled>)>(census).into())
    }
}

/// The scene itself, for components that are read directly.
impl Deref for Census<'_> {
    type Target = World;
    fn deref(&self) -> &World {
        self.scene
    }
}

/// Enabled entities that pass the filter, in spawn order.
pub fn entities<F: QueryFilter>(scene: &World) -> Vec<Entity> {
    let found = scene.try_query_filtered::<Entity, F>().map(|mut query| query.iter(scene).collect());
    let mut entities: Vec<Entity> = found.unwrap_or_default();
    entities.sort_by_key(|entity| entity.index());
    entities
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Sphere;
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
