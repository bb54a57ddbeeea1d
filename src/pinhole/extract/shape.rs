use super::check::kind_and_name;
use super::emissive::emissive_entities;
use super::non_opaque::is_non_opaque;
use super::shape_kind::{one_shape, shape_entities};
use super::velocity::moves_while_open;
use crate::material::{NO_ROW, components_in_words, material_entities, material_kind};
use crate::plan::{Census, Table};
use crate::scene::{SceneError, UsesMaterial, called};
use crate::shapes::ShapeKind;
use bevy_ecs::prelude::*;
use std::collections::HashMap;

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
}

impl Table for ShapeTable {
    const NAME: &'static str = "shapes";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (materials, emissive) = (material_entities(scene), emissive_entities(scene));
        let kinds: Vec<_> = materials.iter().map(|&material| material_kind(scene, material)).collect();
        let non_specular =
            |row: u32| kinds.get(row as usize).copied().flatten().is_some_and(|kind| !kind.is_specular());
        let mut table = Self::default();
        let (mut rows_of_kind, moves) = (HashMap::<ShapeKind, u32>::new(), moves_while_open(scene));
        let (is_non_opaque, mut last) = (is_non_opaque(scene), Vec::new());
        for &entity in shape_entities(scene).iter() {
            let listed = one_shape(scene, entity)?;
            let kind = if moves(entity) { ShapeKind::Moving } else { listed.kind };
            // Those that are not opaque are in the table of their kind after all others.
            if kind != ShapeKind::Moving && is_non_opaque(entity) {
                last.push(table.row.len());
                table.row.push(0);
            } else {
                let rows = rows_of_kind.entry(kind).or_default();
                table.row.push(*rows);
                *rows += 1;
            }
            table.kind.push(kind);
            let used = scene.get::<UsesMaterial>(entity).map(|used| used.0);
            let [own, of_used] = [Some(entity), used].map(|entity| row_in(&materials, entity));
            let [emits, used_emits] = [Some(entity), used].map(|entity| row_in(&emissive, entity));
            let material = if own == NO_ROW { of_used } else { own };
            // A shape that emits light need not reflect any, but a material that it uses must exist.
            let is_missing = material.min(if used.is_some() { used_emits } else { emits }) == NO_ROW;
            if is_missing || (own != NO_ROW && used.is_some()) {
                return Err(wrong_material(scene, &kind_and_name(scene, listed.word, entity), own != NO_ROW, used));
            }
            table.non_specular.push(non_specular(material));
            table.material.push(material);
            table.emissive.push(if emits == NO_ROW { used_emits } else { emits });
        }
        for shape in last {
            let rows = rows_of_kind.entry(table.kind[shape]).or_default();
            table.row[shape] = *rows;
            *rows += 1;
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.kind.len() * (size_of::<ShapeKind>() + size_of::<bool>() + 12)
    }
}

/// The error of a shape that has no material, or two.
fn wrong_material(scene: &Census<'_>, who: &str, has_own: bool, used: Option<Entity>) -> SceneError {
    match (has_own, used) {
        (true, Some(used)) => {
            let value = format!("given twice, its own and that of {}", called(scene, used));
            SceneError::new(who, "material", value, "a shape may have one only")
        }
        (_, Some(used)) => {
            let value = format!("used from {}", called(scene, used));
            let accepted = format!(
                "that entity must carry a {} or an Emissive and not be disabled",
                components_in_words(scene, "", |_| true)
            );
            SceneError::new(who, "material", value, accepted)
        }
        (_, None) => {
            let accepted = format!(
                "a shape must carry a {}, a UsesMaterial or an Emissive",
                components_in_words(scene, "", |_| true)
            );
            SceneError::new(who, "material", "missing", accepted)
        }
    }
}

/// The row of an entity in a list in spawn order.
fn row_in(list: &[Entity], entity: Option<Entity>) -> u32 {
    let row = |entity: Entity| list.binary_search_by_key(&entity.index(), |other| other.index()).ok();
    let row = entity.and_then(|entity| row(entity).filter(|&row| list[row] == entity));
    row.map_or(NO_ROW, |row| row as u32)
}
