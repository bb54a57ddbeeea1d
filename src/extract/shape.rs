use super::check::kind_and_name;
use super::matte::matte_entities;
use super::unevenly_scaled;
use crate::plan::{Table, entities};
use crate::scene::{Disabled, Matte, Plane, Refusal, Sphere, UsesMaterial, called};
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
}

/// All shapes in spawn order; a shape's number here is the one that hits carry.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShapeTable {
    /// The table each shape is in.
    pub kind: Vec<ShapeKind>,
    /// Its row in that table.
    pub row: Vec<u32>,
    /// Its row in the matte table.
    pub matte: Vec<u32>,
    /// How a person calls it.
    pub name: Vec<String>,
}

/// The enabled entities that are a shape, in spawn order.
pub fn shape_entities(scene: &World) -> Vec<Entity> {
    let mut shapes = entities::<With<Sphere>>(scene);
    shapes.extend(entities::<With<Plane>>(scene));
    shapes.sort_by_key(|shape| shape.index());
    shapes.dedup();
    shapes
}

impl Table for ShapeTable {
    const NAME: &'static str = "shapes";

    fn extract(scene: &World) -> Result<Self, Refusal> {
        let mattes = matte_entities(scene);
        let mut table = Self::default();
        let (mut spheres, mut planes, mut ellipsoids) = (0, 0, 0);
        for entity in shape_entities(scene) {
            let (kind, row, word) = match (scene.get::<Sphere>(entity), scene.get::<Plane>(entity)) {
                (Some(_), Some(_)) => {
                    let who = kind_and_name(scene, "shape", entity);
                    return Err(Refusal::new(
                        who,
                        "shape",
                        "Sphere and Plane at once",
                        "an entity may be one shape only",
                    ));
                }
                (Some(_), None) if unevenly_scaled(scene, entity) => (ShapeKind::Ellipsoid, &mut ellipsoids, "sphere"),
                (Some(_), None) => (ShapeKind::Sphere, &mut spheres, "sphere"),
                _ => (ShapeKind::Plane, &mut planes, "plane"),
            };
            table.kind.push(kind);
            table.row.push(*row);
            *row += 1;
            let material = material_of(scene, &kind_and_name(scene, word, entity), entity)?;
            let matte = mattes.iter().position(|&matte| matte == material).unwrap_or(0);
            table.matte.push(matte as u32);
            table.name.push(kind_and_name(scene, word, entity));
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.kind.len() * (size_of::<ShapeKind>() + 8) + self.name.iter().map(String::len).sum::<usize>()
    }
}

/// The entity that holds a shape's one material.
fn material_of(scene: &World, who: &str, shape: Entity) -> Result<Entity, Refusal> {
    let own = scene.get::<Matte>(shape).map(|_| shape);
    let used = scene.get::<UsesMaterial>(shape).map(|used| used.0);
    match (own, used) {
        (Some(own), None) => Ok(own),
        (None, Some(used)) if scene.get::<Matte>(used).is_some() && scene.get::<Disabled>(used).is_none() => Ok(used),
        (None, Some(used)) => {
            let value = format!("used from {}", called(scene, used));
            Err(Refusal::new(who, "material", value, "that entity must carry a Matte and not be disabled"))
        }
        (None, None) => Err(Refusal::new(who, "material", "missing", "a shape must carry a Matte or a UsesMaterial")),
        (Some(_), Some(used)) => {
            let value = format!("given twice, its own Matte and that of {}", called(scene, used));
            Err(Refusal::new(who, "material", value, "a shape may have one only"))
        }
    }
}
