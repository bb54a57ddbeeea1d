use super::check::kind_and_name;
use super::emissive::emissive_entities;
use super::material::{NO_ROW, is_material, material_entities, material_kind, materials_in_words};
use super::{
    CuboidTable, DiskTable, EllipsoidTable, MaterialKind, MovingTable, PlaneTable, RectangleTable, SphereTable,
    TriangleTable, moves_while_open, unevenly_scaled,
};
use crate::plan::{Table, TableKind, entities};
use crate::scene::{
    Cuboid, Disabled, Disk, Emissive, Plane, Rectangle, SceneError, Sphere, Triangle, UsesMaterial, called,
};
use bevy_ecs::prelude::*;

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
    const COUNT: usize = 8;

    /// The table of this kind.
    pub fn table(self) -> TableKind {
        match self {
            Self::Sphere => TableKind::of::<SphereTable>(),
            Self::Plane => TableKind::of::<PlaneTable>(),
            Self::Ellipsoid => TableKind::of::<EllipsoidTable>(),
            Self::Disk => TableKind::of::<DiskTable>(),
            Self::Rectangle => TableKind::of::<RectangleTable>(),
            Self::Cuboid => TableKind::of::<CuboidTable>(),
            Self::Triangle => TableKind::of::<TriangleTable>(),
            Self::Moving => TableKind::of::<MovingTable>(),
        }
    }
}

/// All shapes in spawn order; a shape's index here is the shape number in hits.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShapeTable {
    /// The table each shape is in.
    pub kind: Vec<ShapeKind>,
    /// Its row in that table.
    pub row: Vec<u32>,
    /// Its row in the material table; [`NO_ROW`] for a shape that reflects nothing.
    pub material: Vec<u32>,
    /// Whether its material is not specular, so that lights are sampled for it.
    pub non_specular: Vec<bool>,
    /// Its row in the table of emissive surfaces; [`NO_ROW`] for a shape that emits nothing.
    pub emissive: Vec<u32>,
    /// Its name in messages.
    pub name: Vec<String>,
}

/// A component that is a shape, and the table of its kind.
struct Written {
    /// The component's name.
    component: &'static str,
    /// Its name in messages.
    word: &'static str,
    entities: fn(&World) -> Vec<Entity>,
    carries: fn(&World, Entity) -> bool,
    kind: fn(&World, Entity) -> ShapeKind,
}

impl Written {
    const fn of<C: Component>(
        component: &'static str,
        word: &'static str,
        kind: fn(&World, Entity) -> ShapeKind,
    ) -> Self {
        let carries = |scene: &World, entity: Entity| scene.get::<C>(entity).is_some();
        Self { component, word, entities: entities::<With<C>>, carries, kind }
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

/// The enabled entities that are a shape, in spawn order.
pub fn shape_entities(scene: &World) -> Vec<Entity> {
    let mut shapes: Vec<Entity> = WRITTEN.iter().flat_map(|written| (written.entities)(scene)).collect();
    shapes.sort_by_key(|shape| shape.index());
    shapes.dedup();
    shapes
}

impl Table for ShapeTable {
    const NAME: &'static str = "shapes";

    fn extract(scene: &World) -> Result<Self, SceneError> {
        let (materials, emissive) = (material_entities(scene), emissive_entities(scene));
        let mut table = Self::default();
        let (mut rows_of_kind, moves) = ([0; ShapeKind::COUNT], moves_while_open(scene));
        for entity in shape_entities(scene) {
            let written = one_shape(scene, entity)?;
            let kind = if moves(entity) { ShapeKind::Moving } else { (written.kind)(scene, entity) };
            let rows = &mut rows_of_kind[kind as usize];
            table.row.push(*rows);
            *rows += 1;
            table.kind.push(kind);
            let name = kind_and_name(scene, written.word, entity);
            let material = material_of(scene, &name, entity)?;
            let kind = material.and_then(|material| material_kind(scene, material));
            table.non_specular.push(kind.is_some_and(MaterialKind::is_non_specular));
            table.material.push(row_in(&materials, material));
            table.emissive.push(row_in(&emissive, emissive_of(scene, entity)));
            table.name.push(name);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.kind.len() * (size_of::<ShapeKind>() + size_of::<bool>() + 12)
            + self.name.iter().map(String::len).sum::<usize>()
    }
}

/// Whether an entity, enabled or not, carries a shape.
pub(super) fn is_shape(scene: &World, entity: Entity) -> bool {
    WRITTEN.iter().any(|written| (written.carries)(scene, entity))
}

/// The one shape component of an entity.
fn one_shape(scene: &World, entity: Entity) -> Result<&'static Written, SceneError> {
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

/// The entity that holds a shape's material; none for a shape that emits light and does not reflect any.
fn material_of(scene: &World, who: &str, shape: Entity) -> Result<Option<Entity>, SceneError> {
    let used = scene.get::<UsesMaterial>(shape).map(|used| used.0);
    match (is_material(scene, shape), used) {
        (true, None) => Ok(Some(shape)),
        (false, Some(used)) if scene.get::<Disabled>(used).is_none() && is_material(scene, used) => Ok(Some(used)),
        (false, Some(used)) if scene.get::<Disabled>(used).is_none() && scene.get::<Emissive>(used).is_some() => {
            Ok(None)
        }
        (false, Some(used)) => {
            let value = format!("used from {}", called(scene, used));
            let accepted =
                format!("that entity must carry a {} or an Emissive and not be disabled", materials_in_words());
            Err(SceneError::new(who, "material", value, accepted))
        }
        (false, None) if scene.get::<Emissive>(shape).is_some() => Ok(None),
        (false, None) => {
            let accepted = format!("a shape must carry a {}, a UsesMaterial or an Emissive", materials_in_words());
            Err(SceneError::new(who, "material", "missing", accepted))
        }
        (true, Some(used)) => {
            let value = format!("given twice, its own and that of {}", called(scene, used));
            Err(SceneError::new(who, "material", value, "a shape may have one only"))
        }
    }
}

/// The entity that holds a shape's emission: itself, or else the one whose material it uses.
pub(super) fn emissive_of(scene: &World, shape: Entity) -> Option<Entity> {
    let used = scene.get::<UsesMaterial>(shape).map(|used| used.0);
    let emits = |entity: &Entity| scene.get::<Emissive>(*entity).is_some() && scene.get::<Disabled>(*entity).is_none();
    [Some(shape), used].into_iter().flatten().find(emits)
}

/// The row of an entity in a list in spawn order.
fn row_in(list: &[Entity], entity: Option<Entity>) -> u32 {
    let row = entity.and_then(|entity| list.binary_search_by_key(&entity.index(), |other| other.index()).ok());
    row.map_or(NO_ROW, |row| row as u32)
}
