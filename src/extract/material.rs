use super::check::{kind_and_name, reflectance};
use crate::plan::{Table, entities};
use crate::scene::{Matte, Refusal};
use bevy_ecs::prelude::*;

/// The kinds of material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MaterialKind {
    /// It sends the light it gets equally in all directions.
    Matte,
}

/// What shapes are made of, in spawn order, whatever the kind; kinds with more numbers have a table of their own.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MaterialTable {
    /// The kind of each.
    pub kind: Vec<MaterialKind>,
    /// The share of light that each sends on equally in all directions: red, green, blue, from 0 to 1.
    pub colour: Vec<[f64; 3]>,
}

/// The entities that carry a material, in spawn order; a row of the table is an entity here.
pub fn material_entities(scene: &World) -> Vec<Entity> {
    entities::<With<Matte>>(scene)
}

impl Table for MaterialTable {
    const NAME: &'static str = "materials";

    fn extract(scene: &World) -> Result<Self, Refusal> {
        let mut table = Self::default();
        for entity in material_entities(scene) {
            let matte = scene.get::<Matte>(entity).copied().unwrap_or_default();
            let who = kind_and_name(scene, "matte", entity);
            table.kind.push(MaterialKind::Matte);
            table.colour.push(reflectance(&who, "colour", matte.colour)?.to_array());
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.kind.len() * (size_of::<MaterialKind>() + size_of::<[f64; 3]>())
    }
}
