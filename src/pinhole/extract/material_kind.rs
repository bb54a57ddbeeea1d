//! Which entities are a material, of which kind, and which of them shapes are made of.

use super::check::kind_and_name;
use super::shape_kind::shape_entities;
use crate::plan::{Census, Evidence, united};
use crate::scene::{BlinnPhong, Disabled, Glass, Matte, Metal, Mirror, Phong, SceneError, UsesMaterial};
use bevy_ecs::prelude::*;
use std::collections::HashSet;
use std::sync::Arc;

/// The least α of a rough metal; below it, metal is a perfect mirror.
///
/// There its highlight falls to one half within 0.07° of its centre.
pub const SMOOTHEST_METAL: f64 = 1e-3;

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
    pub(super) const COUNT: usize = 6;

    /// Whether it reflects light in a continuous range of directions (not specular), so that light sampling can find
    /// light for it.
    pub const fn is_non_specular(self) -> bool {
        !matches!(self, Self::Mirror | Self::Glass)
    }
}

/// A component that is a material.
pub(super) struct Written {
    /// The component's name.
    component: &'static str,
    /// Its name in messages.
    pub(super) word: &'static str,
    pub(super) kind: fn(&Census<'_>, Entity) -> MaterialKind,
    entities: fn(&Census<'_>) -> Arc<[Entity]>,
    carries: fn(&Census<'_>, Entity) -> bool,
}

impl Written {
    const fn of<C: Component>(
        component: &'static str,
        word: &'static str,
        kind: fn(&Census<'_>, Entity) -> MaterialKind,
    ) -> Self {
        let carries = |scene: &Census<'_>, entity: Entity| scene.get::<C>(entity).is_some();
        Self { component, word, kind, entities: |scene| scene.entities::<With<C>>(), carries }
    }
}

/// The components that are materials; a new one is added with a line.
const WRITTEN: &[Written] = &[
    Written::of::<Matte>("Matte", "matte", |_, _| MaterialKind::Matte),
    Written::of::<Phong>("Phong", "phong", |_, _| MaterialKind::Phong),
    Written::of::<BlinnPhong>("BlinnPhong", "blinn_phong", |_, _| MaterialKind::BlinnPhong),
    Written::of::<Mirror>("Mirror", "mirror", |_, _| MaterialKind::Mirror),
    Written::of::<Glass>("Glass", "glass", |_, _| MaterialKind::Glass),
    Written::of::<Metal>("Metal", "metal", |scene, entity| {
        let smooth = scene.get::<Metal>(entity).is_some_and(|metal| metal.roughness < SMOOTHEST_METAL);
        if smooth { MaterialKind::Mirror } else { MaterialKind::Metal }
    }),
];

/// The enabled entities that carry a material, in spawn order, one for each row of the table.
pub fn material_entities(scene: &Census<'_>) -> Arc<[Entity]> {
    scene.once(|scene| united(&mut WRITTEN.iter().map(|written| (written.entities)(scene))).into())
}

/// The kind of an entity's material; none where it has none.
pub(super) fn material_kind(scene: &Census<'_>, entity: Entity) -> Option<MaterialKind> {
    let written = WRITTEN.iter().find(|written| (written.carries)(scene, entity));
    written.map(|written| (written.kind)(scene, entity))
}

/// The enabled entity that holds a shape's material: itself, or the one that it uses.
pub(super) fn used_material(scene: &Census<'_>, shape: Entity) -> Option<Entity> {
    let used = scene.get::<UsesMaterial>(shape).map(|used| used.0);
    let is_there = |entity: &Entity| is_material(scene, *entity) && scene.get::<Disabled>(*entity).is_none();
    [Some(shape), used].into_iter().flatten().find(is_there)
}

/// Whether an entity, enabled or not, carries a material.
pub(super) fn is_material(scene: &Census<'_>, entity: Entity) -> bool {
    WRITTEN.iter().any(|written| (written.carries)(scene, entity))
}

/// The components that are materials, in words: `Matte, Phong … or Metal`.
pub(super) fn materials_in_words() -> String {
    let names: Vec<&str> = WRITTEN.iter().map(|written| written.component).collect();
    let (last, others) = names.split_last().unwrap_or((&"", &[]));
    format!("{} or {last}", others.join(", "))
}

/// The one material component of an entity.
pub(super) fn one_material(scene: &Census<'_>, entity: Entity) -> Result<&'static Written, SceneError> {
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

/// The entities that hold the materials of shapes.
pub(super) fn in_use(scene: &Census<'_>) -> Arc<HashSet<Entity>> {
    scene.once(|scene| {
        let shapes = shape_entities(scene);
        let used = shapes.iter().filter_map(|&shape| scene.get::<UsesMaterial>(shape)).map(|used| used.0);
        Arc::new(used.chain(shapes.iter().copied()).collect())
    })
}

/// Evidence of a shape whose material is of one kind and passes a test; others of the kind do not count.
pub(super) fn in_use_of<C: Component>(scene: &Census<'_>, noun: &str, such: impl Fn(&C) -> bool) -> Evidence {
    let in_use = in_use(scene);
    Evidence::of_kind::<With<C>>(scene, noun, |entity| {
        in_use.contains(&entity) && scene.get::<C>(entity).is_some_and(&such)
    })
}

/// Evidence of a shape that carries this component, or uses a material that does.
pub fn material_kind_evidence<C: Component>(scene: &Census<'_>, noun: &str) -> Evidence {
    let in_use = in_use(scene);
    Evidence::among::<With<C>>(scene, noun, |entity| in_use.contains(&entity.id()))
}
