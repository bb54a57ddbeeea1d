use crate::scene::SceneError;
use bevy_ecs::prelude::*;
use std::ops::Deref;
use std::sync::Arc;

/// Plain arrays or numbers extracted from the scene once, for stages to read; the same in every render world.
pub trait Table: Sized + Send + Sync + 'static {
    /// The name that the plan uses.
    const NAME: &'static str;
    /// Extracts the table from the scene, in spawn order, relative to the eye.
    fn extract(scene: &World) -> Result<Self, SceneError>;
    /// The memory of its arrays, in bytes.
    fn bytes(&self) -> usize;
}

/// A table as a resource of a render world; all worlds share one copy.
#[derive(Resource)]
pub struct Shared<T: Table>(Arc<T>);

impl<T: Table> Shared<T> {
    /// Wraps a table that is ready to be inserted into a world.
    pub fn new(table: T) -> Self {
        Self(Arc::new(table))
    }
}

impl<T: Table> Deref for Shared<T> {
    type Target = T;
    fn deref(&self) -> &T {
        &self.0
    }
}

/// A table without its type, as the plan handles it.
#[derive(Clone, Copy)]
pub struct TableKind {
    /// The name that the plan uses.
    pub name: &'static str,
    /// Extracts it from the scene.
    pub extract: fn(&World) -> Result<ExtractedTable, SceneError>,
    /// Whether a render world has it.
    pub present: fn(&World) -> bool,
}

/// A table extracted from the scene, ready for any number of render worlds.
pub struct ExtractedTable {
    /// The name that the plan uses.
    pub name: &'static str,
    /// The memory of its arrays, in bytes.
    pub bytes: usize,
    /// Inserts a reference to it into a render world.
    pub insert: Box<dyn Fn(&mut World) + Send + Sync>,
}

impl TableKind {
    /// The registry entry of a table type.
    pub fn of<T: Table>() -> Self {
        Self {
            name: T::NAME,
            extract: |scene| {
                let table = Arc::new(T::extract(scene)?);
                let bytes = table.bytes();
                let insert = Box::new(move |world: &mut World| world.insert_resource(Shared(Arc::clone(&table))));
                Ok(ExtractedTable { name: T::NAME, bytes, insert })
            },
            present: |world| world.contains_resource::<Shared<T>>(),
        }
    }
}

impl PartialEq for TableKind {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl std::fmt::Debug for TableKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "TableKind({})", self.name)
    }
}
