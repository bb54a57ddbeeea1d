use super::blinn_phong::blinn_phong_colour;
use super::check::{kind_and_name, reflectance};
use super::glass::glass_colour;
use super::metal::{metal_colour, metal_evidence, metal_kind};
use super::mirror::mirror_colour;
use super::phong::phong_colour;
use super::shape_entities;
use crate::plan::{ComponentKind, Evidence, Table, entities};
use crate::scene::{BlinnPhong, Disabled, Glass, Matte, Metal, Mirror, Phong, SceneError, UsesMaterial};
use bevy_ecs::prelude::*;
use std::collections::BTreeSet;

/// Stands for no row, in a column of row numbers.
pub const NO_ROW: u32 = u32::MAX;

/// The kinds of material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MaterialKind {
    /// Diffuse reflection, the same in all directions.
    Matte,
    /// A row of the table of Phong highlights.
    Phong,
    /// A row of the table of Blinn–Phong highlights.
    BlinnPhong,
    /// A row of the table of mirrors.
    Mirror,
    /// A row of the table of glass.
    Glass,
    /// A row of the table of metals.
    Metal,
}

impl MaterialKind {
    /// The number of kinds.
    const COUNT: usize = 6;

    /// Whether it reflects light in a continuous range of directions (not specular), so that light sampling can find
    /// light for it.
    pub const fn is_non_specular(self) -> bool {
        !matches!(self, Self::Mirror | Self::Glass)
    }
}

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

type Colour = fn(&World, Entity, &str) -> Result<[f64; 3], SceneError>;

/// A component that is a material.
struct Written {
    /// The component's name.
    component: &'static str,
    /// Its name in messages.
    word: &'static str,
    kind: fn(&World, Entity) -> MaterialKind,
    entities: fn(&World) -> Vec<Entity>,
    carries: fn(&World, Entity) -> bool,
    colour: Colour,
}

impl Written {
    const fn of<C: Component>(
        component: &'static str,
        word: &'static str,
        kind: fn(&World, Entity) -> MaterialKind,
        colour: Colour,
    ) -> Self {
        let carries = |scene: &World, entity: Entity| scene.get::<C>(entity).is_some();
        Self { component, word, kind, entities: entities::<With<C>>, carries, colour }
    }
}

/// The components that are materials; a new one is added with a line.
const WRITTEN: &[Written] = &[
    Written::of::<Matte>(
        "Matte",
        "matte",
        |_, _| MaterialKind::Matte,
        |scene, entity, who| {
            let matte = scene.get::<Matte>(entity).copied().unwrap_or_default();
            Ok(reflectance(who, "colour", matte.colour)?.to_array())
        },
    ),
    Written::of::<Phong>("Phong", "phong", |_, _| MaterialKind::Phong, phong_colour),
    Written::of::<BlinnPhong>("BlinnPhong", "blinn_phong", |_, _| MaterialKind::BlinnPhong, blinn_phong_colour),
    Written::of::<Mirror>("Mirror", "mirror", |_, _| MaterialKind::Mirror, mirror_colour),
    Written::of::<Glass>("Glass", "glass", |_, _| MaterialKind::Glass, glass_colour),
    Written::of::<Metal>("Metal", "metal", metal_kind, metal_colour),
];

/// The enabled entities that carry a material, in spawn order, one for each row of the table.
pub fn material_entities(scene: &World) -> Vec<Entity> {
    let mut materials: Vec<Entity> = WRITTEN.iter().flat_map(|written| (written.entities)(scene)).collect();
    materials.sort_by_key(|material| material.index());
    materials.dedup();
    materials
}

/// The kind of an entity's material; none where it has none.
pub(super) fn material_kind(scene: &World, entity: Entity) -> Option<MaterialKind> {
    let written = WRITTEN.iter().find(|written| (written.carries)(scene, entity));
    written.map(|written| (written.kind)(scene, entity))
}

/// The enabled entity that holds a shape's material: itself, or the one that it uses.
pub(super) fn used_material(scene: &World, shape: Entity) -> Option<Entity> {
    let used = scene.get::<UsesMaterial>(shape).map(|used| used.0);
    let is_there = |entity: &Entity| is_material(scene, *entity) && scene.get::<Disabled>(*entity).is_none();
    [Some(shape), used].into_iter().flatten().find(is_there)
}

/// Whether an entity, enabled or not, carries a material.
pub(super) fn is_material(scene: &World, entity: Entity) -> bool {
    WRITTEN.iter().any(|written| (written.carries)(scene, entity))
}

/// The components that are materials, in words: `Matte, Phong … or Metal`.
pub(super) fn materials_in_words() -> String {
    let names: Vec<&str> = WRITTEN.iter().map(|written| written.component).collect();
    let (last, others) = names.split_last().unwrap_or((&"", &[]));
    format!("{} or {last}", others.join(", "))
}

/// The one material component of an entity.
fn one_material(scene: &World, entity: Entity) -> Result<&'static Written, SceneError> {
    let present: Vec<&Written> = WRITTEN.iter().filter(|written| (written.carries)(scene, entity)).collect();
    match present[..] {
        [one] => Ok(one),
        _ => {
            let names: Vec<&str> = present.iter().map(|written| written.component).collect();
            let value = format!("{} at once", names.join(" and "));
            let who = kind_and_name(scene, "material", entity);
            Err(SceneError::new(who, "material", value, "an entity may be one material only"))
        }
    }
}

impl Table for MaterialTable {
    const NAME: &'static str = "materials";

    fn extract(scene: &World) -> Result<Self, SceneError> {
        let mut table = Self::default();
        let mut rows_of_kind = [0; MaterialKind::COUNT];
        for entity in material_entities(scene) {
            let written = one_material(scene, entity)?;
            let kind = (written.kind)(scene, entity);
            let rows = &mut rows_of_kind[kind as usize];
            table.row.push(*rows);
            *rows += 1;
            table.kind.push(kind);
            table.colour.push((written.colour)(scene, entity, &kind_and_name(scene, written.word, entity))?);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.kind.len() * (size_of::<MaterialKind>() + size_of::<u32>() + size_of::<[f64; 3]>())
    }
}

/// The entities that hold the materials of shapes.
fn in_use(scene: &World) -> BTreeSet<Entity> {
    let shapes = shape_entities(scene);
    let used = shapes.iter().filter_map(|&shape| scene.get::<UsesMaterial>(shape)).map(|used| used.0);
    used.chain(shapes.iter().copied()).collect()
}

/// Evidence of a shape whose material is not specular: any but mirrors and glass.
pub fn material_evidence(scene: &World) -> Evidence {
    let in_use = in_use(scene);
    const MATERIALS: [ComponentKind; 3] =
        [ComponentKind::of::<Matte>(), ComponentKind::of::<Phong>(), ComponentKind::of::<BlinnPhong>()];
    let matte = Evidence::among_any(scene, "material", &MATERIALS, |entity| in_use.contains(&entity.id()));
    let metal = metal_evidence(scene);
    if metal.needed { matte.or(metal) } else { matte }
}

/// Evidence of a shape with diffuse reflection, whatever else its material has.
pub fn matte_evidence(scene: &World) -> Evidence {
    let in_use = in_use(scene);
    const MATERIALS: [ComponentKind; 3] =
        [ComponentKind::of::<Matte>(), ComponentKind::of::<Phong>(), ComponentKind::of::<BlinnPhong>()];
    Evidence::among_any(scene, "matte surface", &MATERIALS, |entity| in_use.contains(&entity.id()))
}

/// Evidence of a shape whose material is of one kind and passes a test; others of the kind do not count.
pub(super) fn in_use_of<C: Component>(scene: &World, noun: &str, such: impl Fn(&C) -> bool) -> Evidence {
    let in_use = in_use(scene);
    Evidence::of_kind::<With<C>>(scene, noun, |entity| {
        in_use.contains(&entity) && scene.get::<C>(entity).is_some_and(&such)
    })
}

/// Evidence of a shape that carries this component, or uses a material that does.
pub fn material_kind_evidence<C: Component>(scene: &World, noun: &str) -> Evidence {
    let in_use = in_use(scene);
    Evidence::among::<With<C>>(scene, noun, |entity| in_use.contains(&entity.id()))
}
