use super::check::{kind_and_name, reflectance};
use crate::plan::{Table, entities};
use crate::scene::{Matte, Refusal};
use bevy_ecs::prelude::*;

/// Matte colours in spawn order: the share of light sent on, linear Rec. 709.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MatteTable {
    /// Red, green, blue of each, from 0 to 1.
    pub colour: Vec<[f64; 3]>,
}

/// The entities that carry a matte colour, in spawn order; a row of the table is an entity here.
pub fn matte_entities(scene: &World) -> Vec<Entity> {
    entities::<With<Matte>>(scene)
}

impl Table for MatteTable {
    const NAME: &'static str = "matte colours";

    fn extract(scene: &World) -> Result<Self, Refusal> {
        let mut table = Self::default();
        for entity in matte_entities(scene) {
            let matte = scene.get::<Matte>(entity).copied().unwrap_or_default();
            let who = kind_and_name(scene, "matte", entity);
            table.colour.push(reflectance(&who, "colour", matte.colour)?.to_array());
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.colour.len() * size_of::<[f64; 3]>()
    }
}
