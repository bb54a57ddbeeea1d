use super::Census;
use crate::scene::SceneError;
use bevy_ecs::component::{ComponentId, Mutable, RequiredComponentsRegistrator, StorageType};
use bevy_ecs::prelude::*;
use bevy_ecs::resource::IsResource;
use std::any::TypeId;
use std::ops::Deref;
use std::sync::Arc;

/// Plain arrays or numbers extracted from the scene once, for stages to read; the same in every render world.
pub trait Table: Sized + Send + Sync + 'static {
    /// The name that the plan uses.
    const NAME: &'static str;
    /// Extracts the table from the scene, in spawn order, relative to the eye.
    ///
    /// To be called by [`Census::table`] only, from which it also takes the other tables that it needs.
    fn extract(scene: &Census<'_>) -> Result<Self, SceneError>;
    /// The memory of its arrays, in bytes.
    fn bytes(&self) -> usize;
}

/// A table as a resource of a render world; all worlds share one copy.
pub struct Shared<T: Table>(Arc<T>);

// What `#[derive(Resource)]` writes, and one line more: the plan learns of the table where bevy registers it.
impl<T: Table> Component for Shared<T> {
    const STORAGE_TYPE: StorageType = StorageType::SparseSet;
    type Mutability = Mutable;

    fn register_required_components(id: ComponentId, required: &mut RequiredComponentsRegistrator<'_, '_>) {
        TableKind::of::<T>().remember::<T>();
        required.register_required::<IsResource>(move || IsResource::new(id));
    }
}

impl<T: Table> Resource for Shared<T> {}

impl<T: Table> Shared<T> {
    /// Wraps a table that is ready to be inserted into a world.
    pub fn new(table: T) -> Self {
        Self(Arc::new(table))
    }
}

impl<T: Table> From<Arc<T>> for Shared<T> {
    fn from(table: Arc<T>) -> Self {
        Self(table)
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
    /// The table's type, which identifies it.
    pub id: TypeId,
    /// The name that the plan uses.
    pub name: &'static str,
    /// Extracts it from the scene.
    pub extract: fn(&Census<'_>) -> Result<ExtractedTable, SceneError>,
    /// Whether a render world has it.
    pub present: fn(&World) -> bool,
}

/// A table extracted from the scene, ready for any number of render worlds.
pub struct ExtractedTable {
    /// The table's type.
    pub id: TypeId,
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
            id: TypeId::of::<T>(),
            name: T::NAME,
            extract: |scene| {
                let table = scene.table::<T>()?;
                let bytes = table.bytes();
                let insert = Box::new(move |world: &mut World| world.insert_resource(Shared(Arc::clone(&table))));
                Ok(ExtractedTable { id: TypeId::of::<T>(), name: T::NAME, bytes, insert })
            },
            present: |world| world.contains_resource::<Shared<T>>(),
        }
    }

    /// Whether it is the table of this type.
    pub fn is<T: Table>(&self) -> bool {
        self.id == TypeId::of::<T>()
    }
}

impl PartialEq for TableKind {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

impl Eq for TableKind {}

impl std::fmt::Debug for TableKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "TableKind({})", self.name)
    }
}
