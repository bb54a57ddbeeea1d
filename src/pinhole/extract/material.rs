use super::blinn_phong::blinn_phong_colour;
use super::check::{kind_and_name, reflectance};
use super::glass::glass_numbers;
use super::material_kind::{MaterialKind, in_use, material_entities, one_material};
use super::metal::{metal_evidence, metal_numbers};
use super::phong::phong_colour;
use crate::plan::{Census, ComponentKind, Evidence, Table};
use crate::scene::{BlinnPhong, Glass, Matte, Metal, Mirror, Phong, SceneError};
use bevy_ecs::prelude::*;

/// The materials of shapes of all kinds, in spawn order; kinds with further parameters have a table of their own.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MaterialTable {
    /// The kind of each.
    pub kind: Vec<MaterialKind>,
    /// Its row in the table of its kind.
    pub row: Vec<u32>,
    /// The diffuse albedo of each: red, green, blue, from 0 to 1.
    pub colour: Vec<[f64; 3]>,
}

impl Table for MaterialTable {
    const NAME: &'static str = "materials";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let mut table = Self::default();
        let mut rows_of_kind = [0; MaterialKind::COUNT];
        for &entity in material_entities(scene).iter() {
            let written = one_material(scene, entity)?;
            let kind = (written.kind)(scene, entity);
            let rows = &mut rows_of_kind[kind as usize];
            table.row.push(*rows);
            *rows += 1;
            table.kind.push(kind);
            table.colour.push(colour(scene, entity, &kind_and_name(scene, written.word, entity))?);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.kind.len() * (size_of::<MaterialKind>() + size_of::<u32>() + size_of::<[f64; 3]>())
    }
}

/// What a material sends on equally in all directions, with all of its numbers checked.
fn colour(scene: &Census<'_>, entity: Entity, who: &str) -> Result<[f64; 3], SceneError> {
    let own = scene.entity(entity);
    if let Some(matte) = own.get::<Matte>() {
        return Ok(reflectance(who, "colour", matte.colour)?.to_array());
    }
    if own.contains::<Phong>() {
        return phong_colour(scene, entity, who);
    }
    if own.contains::<BlinnPhong>() {
        return blinn_phong_colour(scene, entity, who);
    }
    if let Some(mirror) = own.get::<Mirror>() {
        reflectance(who, "colour", mirror.colour)?;
    }
    if own.contains::<Glass>() {
        glass_numbers(scene, entity)?;
    }
    if own.contains::<Metal>() {
        metal_numbers(scene, entity)?;
    }
    Ok([0.0; 3])
}

const MATTE: [ComponentKind; 3] =
    [ComponentKind::of::<Matte>(), ComponentKind::of::<Phong>(), ComponentKind::of::<BlinnPhong>()];

/// Evidence that a shape is there whose material spreads the light that falls on it: any but mirrors and glass.
pub fn material_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| {
        let used = in_use(scene);
        let matte = Evidence::among_any(scene, "material", &MATTE, |entity| used.contains(&entity.id()));
        let metal = metal_evidence(scene);
        if metal.needed { matte.or(metal) } else { matte }
    })
}

/// Evidence of a shape with diffuse reflection, whatever else its material has.
pub fn matte_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| {
        let used = in_use(scene);
        Evidence::among_any(scene, "matte surface", &MATTE, |entity| used.contains(&entity.id()))
    })
}
