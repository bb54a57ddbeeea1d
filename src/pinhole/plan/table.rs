use super::Census;
use crate::scene::SceneError;
use bevy_ecs::prelude::*;
use std::ops::Deref;
use std::sync::Arc;

/// Flat arrays or numbers read off the scene once, for stages to read; the same in every render world.
pub trait Table: Sized + Send + Sync + 'static {
    /// The word that the plan uses.
    const NAME: &'static str;
    /// Reads the table off the scene, in spawn order, relative to the eye; other tables that it builds on come from the
    /// [census](Census::table), and whoever wants this one asks there too.
    fn extract(scene: &Census<'_>) -> Result<Self, SceneError>;
    /// Bytes that its arrays take.
    fn bytes(&self) -> usize;
}

/// A table as a resource of a render world; all worlds share one copy.
#[derive(Resource)]
pub struct Shared<T: Table>(Arc<T>);

impl<T: Table> Shared<T> {
    /// A table ready to be inserted into a world.
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

/// A table as the plan handles it, without its type.
#[derive(Clone, Copy)]
pub struct TableKind {
    /// The word that the plan uses.
    pub name: &'static str,
    /// Reads it off the scene.
    pub extract: fn(&Census<'_>) -> Result<ExtractedTable, SceneError>,
    /// Whether a render world holds it.
    pub present: fn(&World) -> bool,
}

/// A table read off the scene, ready for any number of render worlds.
pub struct ExtractedTable {
    /// The word that the plan uses.
    pub name: &'static str,
    /// Bytes that its arrays take.
    pub bytes: usize,
    /// Puts a share of it into a render world.
    pub insert: Box<dyn Fn(&mut World) + Send + Sync>,
}

impl TableKind {
    /// The registry entry of a table type.
    pub fn of<T: Table>() -> Self {
        Self {
            name: T::NAME,
            extract: |scene| {
                let table = scene.table::<T>()?;
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
