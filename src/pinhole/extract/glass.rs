use super::TriangleTable;
use super::accepted_shapes::shapes_with_inside;
use super::check::kind_and_name;
use super::closed_mesh::{OpenMesh, open_mesh};
use super::material::used_material;
use super::shape_kind::{moving_shapes, one_shape, shape_entities, shape_name};
use super::velocity::{moves_while_open, velocity_of};
use crate::material::{interior_of, material_entities};
use crate::plan::{Census, Table};
use crate::scene::{SceneError, called};
use bevy_ecs::prelude::*;
use glam::DVec3;
use std::collections::BTreeMap;

/// What fills the shapes whose surfaces transmit light, one row for each such material, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GlassTable {
    /// The index of refraction relative to a vacuum.
    pub ior: Vec<f64>,
    /// The absorption coefficient per scene unit: red, green, blue, at least 0.
    pub absorption: Vec<[f64; 3]>,
    /// Where two overlap, the one with the higher priority is present.
    pub priority: Vec<u32>,
}

impl Table for GlassTable {
    const NAME: &'static str = "glass";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let mut table = Self::default();
        for &entity in material_entities(scene).iter() {
            let Some(interior) = interior_of(scene, entity)? else { continue };
            table.ior.push(interior.ior);
            table.absorption.push(interior.absorption);
            table.priority.push(interior.priority);
        }
        check_closed(scene)?;
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.ior.len() * (size_of::<[f64; 4]>() + size_of::<u32>())
    }
}

/// What a sheet of glass without an interior can be made of.
const SHEETS: &str = "; a pane that is a single sheet is made of thin_glass";

/// Checks that no shape without an interior is made of glass.
fn check_closed(scene: &Census<'_>) -> Result<(), SceneError> {
    for &shape in shape_entities(scene).iter() {
        let listed = one_shape(scene, shape)?;
        let Some(material) = used_material(scene, shape).filter(|&own| matches!(interior_of(scene, own), Ok(Some(_))))
        else {
            continue;
        };
        // Asked last, since a mesh has to look at all of its edges.
        if (listed.has_inside)(scene, shape) {
            continue;
        }
        let value = format!("the glass {}", called(scene, material));
        let accepted = format!("glass needs a shape with an interior: {}{SHEETS}", shapes_with_inside(scene));
        return Err(SceneError::new(kind_and_name(scene, listed.word, shape), "material", value, accepted));
    }
    check_meshes(scene)
}

/// Checks that the triangles of each kind of glass close around an interior, and move together if they move.
fn check_meshes(scene: &Census<'_>) -> Result<(), SceneError> {
    let shapes = shape_entities(scene);
    let all = if moving_shapes(scene).is_empty() { None } else { Some(TriangleTable::that(scene, |_| true)?) };
    let still = scene.table::<TriangleTable>()?;
    let triangles = all.as_ref().unwrap_or(&still);
    let mut meshes: BTreeMap<Entity, Vec<usize>> = BTreeMap::new();
    for (row, &shape) in triangles.shape.iter().enumerate() {
        let material = shapes.get(shape as usize).and_then(|&shape| used_material(scene, shape));
        if let Some(material) = material.filter(|&own| matches!(interior_of(scene, own), Ok(Some(_)))) {
            meshes.entry(material).or_default().push(row);
        }
    }
    let moves = moves_while_open(scene);
    let velocity = |row: usize| {
        let entity = shapes[triangles.shape[row] as usize];
        if moves(entity) { velocity_of(scene, entity) } else { DVec3::ZERO }
    };
    for rows in meshes.values() {
        if let Some(&row) = rows.iter().find(|&&row| velocity(row) != velocity(rows[0])) {
            let accepted =
                "while the shutter is open all triangles of one glass must move alike, so that it stays closed";
            let who = shape_name(scene, triangles.shape[row] as usize);
            return Err(SceneError::new(who, "motion", "another than its neighbours'", accepted));
        }
    }
    let open = meshes.iter().filter_map(|(material, rows)| Some((open_mesh(triangles, rows)?, *material)));
    let Some((OpenMesh { row, turned }, material)) = open.min_by_key(|(open, _)| open.row) else { return Ok(()) };
    let why = if turned {
        "this triangle shows another side than its neighbour: swap two of its vertices".to_owned()
    } else {
        format!("this triangle has an edge that no other triangle of the same glass has{SHEETS}")
    };
    let value = format!("the glass {}", called(scene, material));
    let accepted = format!("glass needs a shape with an interior, and {why}");
    Err(SceneError::new(shape_name(scene, triangles.shape[row] as usize), "material", value, accepted))
}
