//! Which entities are a shape, and of which kind.

use super::check::kind_and_name;
use super::pose::unevenly_scaled;
use super::velocity::moves_while_open;
use crate::plan::{Census, united};
use crate::scene::{Cuboid, Disk, Plane, Rectangle, SceneError, Sphere, Triangle};
use bevy_ecs::prelude::*;
use std::sync::Arc;

/// The kinds of shape, in the order of their tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShapeKind {
    /// A row of the sphere table.
    Sphere,
    /// A row of the plane table.
    Plane,
    /// A row of the ellipsoid table.
    Ellipsoid,
    /// A row of the disk table.
    Disk,
    /// A row of the rectangle table.
    Rectangle,
    /// A row of the cuboid table.
    Cuboid,
    /// A row of the triangle table.
    Triangle,
    /// A row of the table of moving shapes.
    Moving,
}

impl ShapeKind {
    /// The number of kinds.
    pub(super) const COUNT: usize = 8;
}

/// A component that is a shape, and the table of its kind.
pub(super) struct Written {
    /// The component's name.
    component: &'static str,
    /// Its name in messages.
    pub(super) word: &'static str,
    entities: fn(&Census<'_>) -> Arc<[Entity]>,
    carries: fn(&Census<'_>, Entity) -> bool,
    pub(super) kind: fn(&Census<'_>, Entity) -> ShapeKind,
}

impl Written {
    const fn of<C: Component>(
        component: &'static str,
        word: &'static str,
        kind: fn(&Census<'_>, Entity) -> ShapeKind,
    ) -> Self {
        let carries = |scene: &Census<'_>, entity: Entity| scene.get::<C>(entity).is_some();
        Self { component, word, entities: |scene| scene.entities::<With<C>>(), carries, kind }
    }
}

/// The components that are shapes; a new one is added with a line.
const WRITTEN: &[Written] = &[
    Written::of::<Sphere>("Sphere", "sphere", |scene, entity| {
        if unevenly_scaled(scene, entity) { ShapeKind::Ellipsoid } else { ShapeKind::Sphere }
    }),
    Written::of::<Plane>("Plane", "plane", |_, _| ShapeKind::Plane),
    Written::of::<Disk>("Disk", "disk", |_, _| ShapeKind::Disk),
    Written::of::<Rectangle>("Rectangle", "rectangle", |_, _| ShapeKind::Rectangle),
    Written::of::<Cuboid>("Cuboid", "cuboid", |_, _| ShapeKind::Cuboid),
    Written::of::<Triangle>("Triangle", "triangle", |_, _| ShapeKind::Triangle),
];

/// The enabled entities that are a shape, in spawn order; the place of one is its number.
pub fn shape_entities(scene: &Census<'_>) -> Arc<[Entity]> {
    scene.once(|scene| united(&mut WRITTEN.iter().map(|written| (written.entities)(scene))).into())
}

/// The shapes that carry a component, with their numbers.
pub(super) fn numbered<C: Component>(scene: &Census<'_>) -> Vec<(usize, Entity)> {
    let shapes = shape_entities(scene);
    let number = |entity: Entity| shapes.binary_search_by_key(&entity.index(), |shape| shape.index()).ok();
    scene.entities::<With<C>>().iter().filter_map(|&entity| Some((number(entity)?, entity))).collect()
}

/// The shapes that move while the shutter is open, with their numbers.
pub(super) fn moving_shapes(scene: &Census<'_>) -> Arc<[(usize, Entity)]> {
    scene.once(|scene| {
        let moves = moves_while_open(scene);
        shape_entities(scene).iter().copied().enumerate().filter(|&(_, shape)| moves(shape)).collect()
    })
}

/// The name of a shape in messages, by its number: its kind and its entity's name.
pub fn shape_name(scene: &Census<'_>, shape: usize) -> String {
    let entity = shape_entities(scene).get(shape).copied();
    let written = entity.and_then(|entity| WRITTEN.iter().find(|written| (written.carries)(scene, entity)));
    entity.zip(written).map_or_else(String::new, |(entity, written)| kind_and_name(scene, written.word, entity))
}

/// The names of all shapes in messages, in the order of their numbers.
pub fn shape_names(scene: &Census<'_>) -> Vec<String> {
    (0..shape_entities(scene).len()).map(|shape| shape_name(scene, shape)).collect()
}

/// Whether an entity, enabled or not, carries a shape.
pub(super) fn is_shape(scene: &Census<'_>, entity: Entity) -> bool {
    WRITTEN.iter().any(|written| (written.carries)(scene, entity))
}

/// The one shape component of an entity.
pub(super) fn one_shape(scene: &Census<'_>, entity: Entity) -> Result<&'static Written, SceneError> {
    let present: Vec<&Written> = WRITTEN.iter().filter(|written| (written.carries)(scene, entity)).collect();
    match present[..] {
        [one] => Ok(one),
        _ => {
            let names: Vec<&str> = present.iter().map(|written| written.component).collect();
            let value = format!("{} at once", names.join(" and "));
            Err(SceneError::new(
                kind_and_name(scene, "shape", entity),
                "shape",
                value,
                "an entity may be one shape only",
            ))
        }
    }
}
